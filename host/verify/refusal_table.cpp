#include "host/verify/refusal_table.hpp"

#include <algorithm>
#include <array>

namespace liana::verify {

namespace {

constexpr std::array kRows{
    RefusalRow{Refusal::kTwinFault, "twin_fault", "clear what the fault names, then command again"},
    RefusalRow{Refusal::kGate, "gate", "command a smaller step"},
    RefusalRow{Refusal::kTension, "tension_plan",
               "keep away from this pose: its cables cannot be planned within limits"},
    RefusalRow{Refusal::kCableSpeed, "cable_speed", "command the same way more slowly"},
    RefusalRow{Refusal::kNotAccepted, "not_accepted", "enable the arm, and command from where it is"},
    RefusalRow{Refusal::kTooSlow, "too_slow", "take load off the machine; see liana latency"},
    RefusalRow{Refusal::kJointTravel, "joint_travel", "command the same way more slowly"},
    RefusalRow{Refusal::kTickTime, "tick_time", "use a longer control period or a faster machine (buses: machine)"},
    RefusalRow{Refusal::kModel, "model",
               "look at what the margin names; measure friction again (liana calibrate --friction)"},
    RefusalRow{Refusal::kJointAngle, "joint_angle", "command angles within the limits of the robot table"},
    RefusalRow{Refusal::kJointRate, "joint_rate", "give the motion more time"},
    RefusalRow{Refusal::kTipSpeed, "tip_speed", "give the motion more time"},
    RefusalRow{Refusal::kNoRest, "no_rest", "command a slower motion, which stops sooner"},
    RefusalRow{Refusal::kNotFinite, "not_finite", "command finite numbers"},
    RefusalRow{Refusal::kUnreachable, "unreachable", "command a tip pose within reach, or release held angles"},
    RefusalRow{Refusal::kPath, "path", "ask for a way that keeps clear, e.g. by liana plan"},
    RefusalRow{Refusal::kSceneContact, "scene_contact", "retract, or command a way that keeps clear of the body named"},
    RefusalRow{Refusal::kSelfContact, "self_contact", "retract, or command angles that bend the arm less"},
    RefusalRow{Refusal::kNodeSpeed, "node_speed", "give the motion more time"},
    RefusalRow{Refusal::kSwingTension, "swing_tension", "command a slower, smoother motion"},
    RefusalRow{Refusal::kNoVerdict, "no_verdict", "take load off the machine; see liana latency"},
};

}  // namespace

std::span<const RefusalRow> refusal_table() { return kRows; }

const RefusalRow& row_of(Refusal code) { return *std::ranges::find(kRows, code, &RefusalRow::code); }

}  // namespace liana::verify
