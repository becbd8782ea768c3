#include "host/control/verification/refusal_table.hpp"

#include <algorithm>
#include <array>

#include "firmware_like/math/enumerators.hpp"

namespace liana::verification {

namespace {

using enum Refusal;

constexpr RefusalAction kHold = RefusalAction::kHold;
constexpr RefusalAction kStop = RefusalAction::kStop;

// A new code without a row does not compile.
constexpr std::array<RefusalRow, count_enumerators<Refusal, 100>()> kRows{{
    {},
    {kTwinFault, "twin_fault", "The controller would latch a fault.", "", kHold,
     "Retract, which needs no clear where the fault allows it; else remove what the fault names, then clear."},
    {kGate, "gate", "The gate would refuse an output to a drive.", "", kHold,
     "Ask for the same way with a lower rate_deg_s, or with move_cp in place of servo_cp."},
    {kTension, "tension_plan", "The tension plan would leave its limits.", "N", kHold,
     "Retract, or ask for another pose, or let it carry less: here cables cannot be planned within limits."},
    {kCableSpeed, "cable_speed", "A cable would move too fast.", "m per tick", kHold,
     "Ask for the same way more slowly: a lower rate_deg_s or speed_m_s, or move_cp in place of servo_cp."},
    {kNotAccepted, "not_accepted", "The controller would not take the command.", "", kHold,
     "Clear what is latched, enable the arm, and command from where it stands; retract needs no clear."},
    {kTooSlow, "too_slow", "The verdict came after the command interval had begun.", "us", kHold,
     "Ask again, from rest; if it comes back, take load off the machine (liana doctor, liana latency)."},
    {kJointTravel, "joint_travel", "A joint would be told to go further in a tick than its rate allows.",
     "deg per tick", kHold, "Ask for the same way with a lower rate_deg_s."},
    {kTickTime, "tick_time", "The predicted ticks would take longer than the machine has for them.", "us", kHold,
     "Ask for a motion without held angles and nodes; else a bus table with a longer period or a faster machine."},
    {kModel, "model", "The arm is not where the model has it: no prediction holds.", "deg, N", kHold,
     "Retract, or ask for a pose that bends the arm less; look at the cable or joint named, and measure friction again "
     "(liana calibrate --friction)."},
    {kJointAngle, "joint_angle", "A joint angle would pass its limit.", "deg", kHold,
     "Retract, or ask for angles within the limits of the robot table."},
    {kJointRate, "joint_rate", "A joint would turn too fast.", "deg/s", kHold,
     "Give the motion more time: a lower rate_deg_s, or move_cp in place of servo_cp."},
    {kTipSpeed, "tip_speed", "The tip would move or turn too fast.", "m/s, rad/s", kHold,
     "Wait until the arm is at rest, then ask with a lower rate_deg_s or speed_m_s; a stream with smaller steps, or "
     "move_cp in its place."},
    {kNoRest, "no_rest", "The stop after the command would take too long.", "", kHold,
     "Ask for the same way more slowly: it stops sooner."},
    {kNotFinite, "not_finite", "A predicted number is not finite.", "", kHold,
     "Retract, and ask for another way: this one leads where the arm cannot be computed."},
    {kUnreachable, "unreachable", "The arm cannot take the tip there.", "m, rad", kHold,
     "Ask for a tip pose within reach; where angles are held (cable arms), release them first: hold_theta with an "
     "empty "
     "list."},
    {kPath, "path", "The whole of a path or of a joint move was looked at, and it is not begun.", "", kHold,
     "Ask for a way that keeps clear, such as liana plan finds, from where the arm stands."},
    {kSceneContact, "scene_contact", "The arm could touch the scene, on the way or while it stops.", "m", kHold,
     "Retract, or ask for a way that leaves the body named more room."},
    {kSelfContact, "self_contact", "The arm would touch itself.", "m", kStop,
     "Retract, or ask for angles that bend the arm less; after an emergency stop clear and enable first."},
    {kNodeSpeed, "node_speed", "The arm's body would move too fast.", "m/s", kHold,
     "Give the motion more time: a lower rate_deg_s, or move_cp in place of servo_cp."},
    {kSwingTension, "sway_tension", "With what inertia adds, a cable would go slack or be overloaded.", "N", kHold,
     "Ask for the same way from rest, with a lower rate_deg_s or speed_m_s; if it comes back, retract, or ask for a "
     "pose that bends the arm less."},
    {kNoVerdict, "no_verdict", "The simulation had no verdict in time.", "us", kHold,
     "Ask again, from rest; if it comes back, take load off the machine (liana doctor, liana latency)."},
    {kFixture, "fixture", "The tip would pass a virtual wall of the scene.", "", kHold,
     "Lead the tip back between the walls of the fixture named, or ask for a way that keeps between them."},
    {kPushTube, "insert_tube",
     "A push would leave its tube: too far along its axis or beside it, or with too much force.", "m, N", kHold,
     "Back off along the axis, stand better aligned before it, and push again."},
}};

constexpr bool is_complete() {
  for (std::size_t i = 1; i < kRows.size(); ++i) {
    const RefusalRow& row = kRows[i];
    if (row.code <= kRows[i - 1].code) return false;
    if (row.name[0] == '\0' || row.says[0] == '\0' || row.remedy[0] == '\0') return false;
  }
  return true;
}
static_assert(is_complete(), "refusal table: every code once, ascending, with name, sentence and remedy");

}  // namespace

std::span<const RefusalRow> refusal_table() { return std::span(kRows).subspan(1); }

const RefusalRow& row_of(Refusal code) {
  const auto* row = std::lower_bound(kRows.begin(), kRows.end(), code,
                                     [](const RefusalRow& each, Refusal wanted) { return each.code < wanted; });
  return row != kRows.end() && row->code == code ? *row : kRows.front();
}

bool is_of_swing(Refusal code) {
  return code == kSwingTension || code == kTipSpeed || code == kNodeSpeed || code == kJointRate;
}

bool may_pass_slower(Refusal code) { return is_of_swing(code) || code == kNoRest; }

bool is_of_motion(Refusal code) {
  using enum Refusal;
  constexpr std::array kOthers = {kNone, kNotAccepted, kTooSlow, kTickTime, kModel, kPath, kNoVerdict};
  return std::find(kOthers.begin(), kOthers.end(), code) == kOthers.end();
}

const char* refusal_action_name(RefusalAction action) { return action == kStop ? "stop" : "hold"; }

std::string markdown_of(std::span<const RefusalRow> rows) {
  std::string text =
      "| code | name | what it says | margin in | action | what to do |\n"
      "|---|---|---|---|---|---|\n";
  for (const RefusalRow& row : rows) {
    text += "| " + std::to_string(static_cast<int>(row.code)) + " | " + row.name + " | " + row.says + " | " + row.unit +
            " | " + refusal_action_name(row.action) + " | " + row.remedy + " |\n";
  }
  return text;
}

}  // namespace liana::verification
