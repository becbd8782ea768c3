#include "host/api/server/request_table.hpp"

#include <algorithm>

#include "host/api/server/request_fields.hpp"
#include "host/base/options/retired.hpp"

namespace liana::api {

namespace {

using namespace request_fields;

constexpr Roles kMovers = only(Role::kMission) | only(Role::kClient);

constexpr std::array kTable{
    RequestRow{
        .op = "hello", .doc = "Says who the client is; the first request of every connection.", .fields = kHello},
    RequestRow{.op = "done", .doc = "Ends a lockstep client's interval, after its other messages.", .fields = kDone},
    RequestRow{.op = "acquire",
               .doc = "Own motion; one client at a time, and the death of the owner is a hold.",
               .fields = kAcquire,
               .roles = kMovers,
               .in_missions = true,
               .motion = Motion::kReplaces},
    RequestRow{.op = "release",
               .doc = "Give motion back; the arm holds.",
               .owner_only = true,
               .in_missions = true,
               .motion = Motion::kReplaces},
    RequestRow{.op = "state_command",
               .doc = "CRTK operating state.",
               .fields = kStateCommand,
               .owner_only = true,
               .in_missions = true},
    RequestRow{.op = "move_jp",
               .doc = "Joint goal, all angles together from rest to rest.",
               .fields = kMoveJp,
               .owner_only = true,
               .in_missions = true,
               .motion = Motion::kReplaces},
    RequestRow{.op = "move_path",
               .doc = "From rest through points on one time law, without a stop; looked at as a whole first.",
               .fields = kMovePath,
               .owner_only = true,
               .in_missions = true,
               .motion = Motion::kReplaces},
    RequestRow{.op = "move_cp",
               .doc = "Tip goal along a straight line at the tip limits.",
               .fields = kMoveCp,
               .owner_only = true,
               .in_missions = true,
               .motion = Motion::kReplaces},
    RequestRow{.op = "servo_cp",
               .doc = "One of a stream of tip goals, at any rate; the newest of a command interval counts.",
               .fields = kServoCp,
               .owner_only = true,
               .in_missions = true,
               .motion = Motion::kStreams},
    RequestRow{.op = "servo_target",
               .doc =
                   "The tip goes to a place beside a target that the tip camera sees, stays there for the dwell, and "
                   "the servo ends by itself.",
               .fields = kServoTarget,
               .owner_only = true,
               .in_missions = true,
               .motion = Motion::kReplaces},
    RequestRow{.op = "hold_theta",
               .doc = "Held variables go to their targets at a bounded rate while the tip stays or follows.",
               .fields = kHoldTheta,
               .owner_only = true,
               .arms = kCableArm,
               .in_missions = true},
    RequestRow{.op = "shape",
               .doc = "Null-space targets of nodes, and points that the arm keeps away from.",
               .fields = kShape,
               .owner_only = true,
               .arms = kCableArm,
               .in_missions = true},
    RequestRow{.op = "dither",
               .doc = "All tensions of an arm at rest go slowly up and down, which frees what friction holds.",
               .fields = kDither,
               .owner_only = true,
               .arms = kCableArm,
               .in_missions = true},
    RequestRow{.op = "use_device",
               .doc = "Who steers, and how hand motion maps to the tip.",
               .fields = kUseDevice,
               .owner_only = true,
               .arms = kCableArm,
               .in_missions = true,
               .motion = Motion::kReplaces},
    RequestRow{.op = "insert",
               .doc =
                   "Moves along an axis of the tip under force control, from rest, until something else is asked for; "
                   "how it goes is `insert` of the state.",
               .fields = kInsert,
               .owner_only = true,
               .arms = kSerialArm,
               .in_missions = true,
               .motion = Motion::kReplaces},
    RequestRow{.op = "comply",
               .doc = "From rest, joints give way to what pushes them with more than 20 N m, until something else is "
                      "asked for.",
               .owner_only = true,
               .arms = kSerialArm,
               .in_missions = true,
               .motion = Motion::kReplaces},
    RequestRow{.op = "payload",
               .doc = "What the arm carries beside its tool from now on, until another is told. Drives that follow "
                      "torques get what moving it takes; a cable arm, at rest, holds its weight by its tensions.",
               .fields = kPayload,
               .owner_only = true,
               .in_missions = true},
    RequestRow{.op = "adapter",
               .doc = "Tells the adapter to lock or to release the payload; how it goes is `adapter` of the state.",
               .fields = kAdapter,
               .owner_only = true,
               .arms = kSerialArm,
               .in_missions = true},
    RequestRow{.op = "retract",
               .doc = "Stop, then back along the verified path, a little slower than the way in.",
               .fields = kRetract,
               .owner_only = true,
               .in_missions = true,
               .motion = Motion::kReplaces},
    RequestRow{.op = "hold",
               .doc = "Stop along the path and stay enabled.",
               .owner_only = true,
               .in_missions = true,
               .motion = Motion::kReplaces},
    RequestRow{.op = "tool",
               .doc = "A command to the tool at the tip; how it goes is `tool` of the state.",
               .fields = kTool,
               .owner_only = true,
               .in_missions = true},
    RequestRow{.op = "stop",
               .doc = "Stop, brakes, disable; never refused.",
               .fields = kStop,
               .in_missions = true,
               .motion = Motion::kReplaces,
               .never_refused = true},
    RequestRow{.op = "shutdown", .doc = "Ends lianad after a stop.", .roles = only(Role::kClient)},
    RequestRow{.op = "timing", .doc = "Times of the real-time thread (real time only).", .fields = kTiming},
    RequestRow{.op = "devices",
               .doc = "What devices are connected, what they can, and their newest samples.",
               .arms = kCableArm},
    RequestRow{.op = "announce",
               .doc = "Tells the operator which step runs.",
               .fields = kAnnounce,
               .roles = only(Role::kMission),
               .in_missions = true},
    RequestRow{.op = "mission_control",
               .doc = "Tells the mission that runs to pause, go on, do one step, or that a step is confirmed.",
               .fields = kMissionControl,
               .roles = only(Role::kClient) | only(Role::kOperator)},
    RequestRow{.op = "operator_says",
               .doc = "What the operator tells the mission.",
               .fields = kOperatorSays,
               .roles = only(Role::kOperator)},
    RequestRow{.op = "archive_alarm",
               .doc = "The flight recorder loses something, as on a full disk; becomes an event.",
               .fields = kArchiveAlarm,
               .roles = only(Role::kArchive)},
    RequestRow{.op = "tool_report",
               .doc = "What the tool says of the command it was given.",
               .fields = kToolReport,
               .roles = only(Role::kTool)},
    RequestRow{.op = "camera", .doc = "What the tip camera has seen.", .fields = kCamera, .roles = only(Role::kCamera)},
};

constexpr std::array<options::RetiredName, 2> kRetiredOps{{
    {"push", "insert"},
    {"follow", "comply"},
}};

constexpr std::array<options::RetiredName, 5> kRetiredFields{{
    {"swing_s", "sway_s"},
    {"quicker_swing_s", "quicker_sway_s"},
    {"swing_off", "sway_tolerance"},
    {"aside_m", "lateral_m"},
    {"centre_m", "center_m"},
}};

}  // namespace

std::span<const RequestRow> request_table() { return kTable; }

std::string_view present_op(std::string_view op) { return options::present_name(op, kRetiredOps); }

std::string_view present_field(std::string_view field) { return options::present_name(field, kRetiredFields); }

const RequestRow* find_request(std::string_view op) {
  const auto found = std::find_if(kTable.begin(), kTable.end(), [op](const RequestRow& row) { return row.op == op; });
  return found != kTable.end() ? &*found : nullptr;
}

}  // namespace liana::api
