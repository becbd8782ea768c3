// The fields of every request; rows of the table (request_table.cpp) say whose they are.
#pragma once

#include <array>

#include "host/api/server/request_table.hpp"

namespace liana::api::request_fields {

constexpr Figure kReach = Figure::kReach;

constexpr RequestField number(const char* name, Bound low, Bound high, const char* doc) {
  return {name, FieldType::kNumber, doc, low, high};
}
constexpr RequestField integer(const char* name, Bound low, Bound high, const char* doc) {
  return {name, FieldType::kInteger, doc, low, high};
}
constexpr RequestField flag(const char* name, const char* doc) { return {name, FieldType::kFlag, doc}; }
constexpr RequestField text(const char* name, double most_bytes, const char* doc) {
  return {name, FieldType::kText, doc, 1.0, most_bytes};
}
constexpr RequestField word(const char* name, Words words, const char* doc) {
  return {name, FieldType::kWord, doc, {}, {}, words};
}
constexpr RequestField point(const char* name, const char* doc) { return {name, FieldType::kPoint, doc, {}, kReach}; }
constexpr RequestField pose(const char* name, Bound within_m, const char* doc) {
  return {name, FieldType::kPose, doc, {}, within_m};
}
constexpr RequestField object(const char* name, std::span<const RequestField> fields, const char* doc) {
  return {name, FieldType::kObject, doc, {}, {}, {}, fields};
}

constexpr std::array kCommands{"enable", "disable", "clear", "home", "recover"};
constexpr std::array kMissionCommands{"pause", "resume", "step", "confirm", "abort"};
constexpr std::array kFrames{"base", "tip", "camera"};
constexpr std::array kFeedbacks{"aligned", "claim", "abstract", "off"};

constexpr std::array kHello{
    text("name", 64, "what lianad calls the client: as owner, in events, as who stopped the arm"),
    word("role", kRoleNames, "what the client is, and with it what it may ask for"),
    flag("lockstep", "virtual time waits for this client's `done`").otherwise(0.0),
    text("subscribe", 32, "topics that it wants to hear: state, camera, tick, event, tool").optional().list(8),
    integer("events_from", 1.0, kBiggestWhole, "sequence of the first event that it wants; left out: from now on")
        .optional(),
};
constexpr std::array kDone{integer("tick", 0.0, kBiggestWhole, "of the state that is answered")};

constexpr std::array kAcquire{
    text("from", 64,
         "owner that a client takes motion from: after an emergency stop, or 5 s without a sign of life of it")
        .optional()};
constexpr std::array kStateCommand{
    word("command", kCommands,
         "what the arm should do; recover: clear, and go on without the cable of fault 5006: only retract moves then"),
    integer("whole", 1.0, 64.0, "with clear: this cable of fault 5006 was looked at, and is whole").optional()};

// What a setpoint tells of itself.
constexpr RequestField kSequence =
    integer("sequence", 1.0, kBiggestWhole,
            "grows from setpoint to setpoint of one owner: repeated and overtaken ones are refused")
        .optional();
constexpr RequestField kTime =
    number("time_s", -1e12, 1e12,
           "the client's clock when it made the setpoint; never goes back (in virtual time: arm time)")
        .optional();
constexpr RequestField kTtl =
    number("ttl_s", 0.05, 10.0,
           "time to live: with `time_s`, a setpoint that comes so much later than the quickest is refused")
        .optional();
constexpr RequestField kStreamTtl =
    number(
        "ttl_s", 0.05, 10.0,
        "time to live: when no other follows in it the arm holds; with `time_s`, a setpoint that comes so much later "
        "than the quickest is refused")
        .optional();

constexpr std::array kAxes{"x", "y", "z"};

constexpr RequestField kSwayTolerance =
    number("sway_tolerance", 0.0, 0.2, "share by which `sway_s` may differ from the true period; over 0.1 takes longer")
        .otherwise(0.1);

// Which of what the camera sees: names that both sides use.
constexpr double kTargetBytes = 31;
constexpr std::array kServoTarget{
    text("target", kTargetBytes, "which of what the camera sees: its `target_name`, or `slit` or `rod`"),
    pose("offset", kReach, "where the tip should be, or `point`, in the target's frame"),
    pose("point", kReach, "what is led there, in the tip's frame: of what the arm holds; the tip itself when left out")
        .optional(),
    word("axis", kAxes, "of the target: the way in, along which `speed_m_s` counts; x when left out").optional(),
    number("tolerance_m", 1e-4, 0.1, "xi: so near along each of the target's axes").otherwise(0.0006),
    number("tolerance_deg", 0.01, 10.0, "xi: so near about each of the target's axes").otherwise(0.4),
    number("dwell_s", 0.0, 60.0, "so long within the tolerances, then it ends by itself").otherwise(1.0),
    number("timeout_s", 1.0, 600.0, "not there after this time it ends").otherwise(120.0),
    number("lost_s", 0.2, 10.0, "without a usable image for so long the target is lost").otherwise(1.0),
    number("tau_s", 0.05, 20.0, "time constant of the low-pass on what the camera sees").otherwise(4.0),
    number("sway_s", 0.0, 120.0,
           "period, roughly, with which the arm's base sways: the servo tells the sway from the target's place, and"
           " calms it; 0: the base stands still")
        .otherwise(0.0),
    number("quicker_sway_s", 0.0, 60.0, "period of a second sway; 0: there is none").otherwise(0.0),
    kSwayTolerance,
    number("calming", 0.0, 2.0,
           "way of the tip against the slow sway, as a share of the sway: less for an arm that is heavy beside its"
           " base, 0: the sway is left as it is")
        .otherwise(1.0),
    number("gain_1_s", 0.05, 1.0, "k: speed for a way to go").otherwise(0.45),
    number("speed_m_s", 1e-4, 1.0, "fastest along the way in; the robot's own limit holds besides").otherwise(0.028),
    number("lateral_speed_m_s", 1e-4, 1.0, "fastest across it; the robot's own limit holds besides").otherwise(0.008),
    number("rate_deg_s", 0.01, 30.0, "fastest turn; the robot's own limit holds besides").otherwise(0.5),
    number("accel_m_s2", 1e-4, 1.0, "acceleration of the goal that is led").otherwise(0.005),
    number("accel_deg_s2", 0.01, 30.0, "the same of its turn").otherwise(0.25),
};

constexpr std::array kHeld{
    integer("theta", 1.0, Figure::kAngles, "number of the angle, 1 at the base"),
    RequestField{"target_deg", FieldType::kAngle, "angle at which it is held"},
};
constexpr RequestField kMoveSway =
    number("sway_s", 0.0, 120.0,
           "period with which the arm's base sways: the move takes longer and leaves it still; 0: as quickly as the "
           "limits let it")
        .otherwise(0.0);
constexpr RequestField kMoveQuickerSway =
    number("quicker_sway_s", 0.0, 60.0, "period of a second sway; 0: there is none").otherwise(0.0);

constexpr std::array kMoveJp{
    RequestField{"goal_deg", FieldType::kAngles, "angle that each joint or theta goes to"},
    number("rate_deg_s", 0.01, Figure::kAngleRate, "the most that any angle may turn at").otherwise(Figure::kAngleRate),
    kMoveSway,
    kMoveQuickerSway,
    kSwayTolerance,
    kSequence,
    kTime,
    kTtl,
};
constexpr std::array kMovePath{
    RequestField{"points_deg", FieldType::kAngles, "points to go through; the first at most 1 deg from the command"}
        .list(500),
    number("rate_deg_s", 0.01, Figure::kAngleRate, "the most that any angle may turn at").otherwise(Figure::kAngleRate),
    number("margin_m", 0.001, 0.5, "clearance that the straight pieces between points have to have").otherwise(0.001),
    kSequence,
    kTime,
    kTtl,
};
constexpr std::array kMoveCp{
    pose("goal", kReach, "pose that the tip goes to, in the base frame"),
    object("hold", kHeld, "as `held` of `hold_theta`, from the start of the line")
        .optional()
        .list(16)
        .only_for(kCableArm),
    kMoveSway,
    kMoveQuickerSway,
    kSwayTolerance,
    kSequence,
    kTime,
    kTtl,
};
constexpr std::array kServoCp{
    pose("goal", kReach, "pose that the tip should have next, in the base frame"),
    kSequence,
    kTime,
    kStreamTtl,
};
constexpr std::array kHoldTheta{
    object("held", kHeld, "all that are held from now on; an empty list releases them").list(16)};

constexpr std::array kNode{
    integer("node", 1.0, Figure::kNodes, "which, counted from the base; the tip has its own goal"),
    point("position_m", "where it should be, in the base frame"),
    number("weight", 0.0, 1000.0, "1 for the arm's middle node and 0.25 for others when left out").optional(),
    number("threshold_m", 0.0, kReach, "nearer than this nothing is done").otherwise(0.01),
};
constexpr std::array kClear{
    point("center_m", "what to keep away from, in the base frame"),
    number("distance_m", 0.0, kReach, "how far away from it the axis should stay"),
    number("weight", 0.0, 1000.0, "of this wish against the others").otherwise(1.0),
};
constexpr std::array kShape{
    object("nodes", kNode, "where nodes should be; an empty list clears them").list(4),
    object("keep_clear", kClear, "points that the arm's axis is pushed away from as far as the tip allows")
        .optional()
        .list(4),
    flag("search", "the best of all shapes is looked for first (arm at rest)").otherwise(0.0),
};
constexpr std::array kDither{
    number("share", 0.01, 0.3, "of every planned tension, up and down").otherwise(0.3),
    number("duration_s", 1.0, 20.0, "in which the share decays evenly to nothing").otherwise(4.0),
};
constexpr std::array kUseDevice{
    text("device", 31, "who steers: `vr`, `hand`, `pointer`, or a connected device by its name; `none`: nobody"),
    number("scale", 0.01, 100.0, "way of the tip for a way of the hand").otherwise(1.0),
    number("rotation_scale", 0.0, 10.0, "turn of the tip for a turn of the hand").otherwise(1.0),
    integer("node", 0.0, Figure::kNodes, "node that the left hand of `vr` moves; 0: none").otherwise(0.0),
    number("speed_m_s", 1e-4, Figure::kTipSpeed, "fastest that the tip follows").otherwise(Figure::kTipSpeed),
    flag("anywhere", "`vr` steers inside the slit, too; else it is refused there, and let go at the mouth")
        .otherwise(0.0),
    word("frame", kFrames,
         "axes of the hand (not of `vr`'s left one): the base's (else), the tip's on engaging, the tip camera's, which "
         "turn")
        .optional(),
    text("fixtures", 40, "names of the scene's fixtures that guide the hand and are felt; left out: all of them")
        .optional()
        .list(16),
    word("feedback", kFeedbacks, "law by which the hand feels the arm; `aligned` when left out").optional(),
};
constexpr std::array kInsertLaws{"force", "impedance"};
constexpr std::array kInsertGainFields{
    number("mass_kg", 1e-6, 1e6, "M_d along the axes").optional(),
    number("inertia_kgm2", 1e-6, 1e6, "M_d about the axes").optional(),
    number("axial_damping_Ns_per_m", 1e-6, 1e6, "K_D along the axis of the insertion").optional(),
    number("lateral_damping_Ns_per_m", 1e-6, 1e6, "K_D across it").optional(),
    number("turn_damping_Nms_per_rad", 1e-6, 1e6, "K_D of turning").optional(),
    number("force_gain", 1e-6, 1e6, "K_P C_F: of what is missing of the set force").optional(),
    number("stiffness_N_per_m", 1e-6, 1e6, "K_P of impedance").optional(),
    number("turn_stiffness_Nm_per_rad", 1e-6, 1e6, "K_P of impedance in turning").optional(),
    number("approach_m_s", 1e-6, 1e6, "impedance: of the point that it pulls to").optional(),
    number("unload_damping_Ns_per_m", 1e-6, 1e6, "K_D along the axis from capture on").optional(),
};
constexpr std::array kInsert{
    point("axis", "way in, in the frame of the tip, of any length; left out: the tip's z").optional(),
    number("force_N", 0.0, 1000.0, "set force along the axis; the other five are set to nothing").otherwise(30.0),
    number("travel_m", 0.001, 1.0, "the most along the axis, from where it begins").otherwise(0.06),
    number("lateral_m", 0.001, 1.0, "the most across it").otherwise(0.02),
    number("turn_deg", 0.1, 45.0, "the most that the tip turns").otherwise(3.0),
    word("law", kInsertLaws, "`force` when left out").optional(),
    number("depth_m", 0.0, 1.0, "`impedance`: where the stop is expected, along the axis").otherwise(0.0222),
    flag("tare", "what the wrist sensor says in the first 0.1 s is taken for nothing").otherwise(1.0),
    object("gains", kInsertGainFields, "other gains than the robot's, within its ranges").optional(),
};
constexpr std::array kPayload{
    number("mass_kg", 0.0, 1e5, "0: nothing"),
    point("center_m", "centre of mass, in the frame of the tip; left out: the tip's origin").optional(),
    number("inertia_kgm2", -1e6, 1e6,
           "xx, yy, zz, xy, xz, yz about the centre of mass, along the axes of the tip's frame; all six. "
           "Left out of mass 0, and of cable arms, which take a payload as a point mass")
        .optional()
        .list(6),
};
constexpr std::array kAdapterCommands{"lock", "release"};
constexpr std::array kAdapter{word("command", kAdapterCommands, "what the adapter should do")};
constexpr std::array kMissionControl{word("command", kMissionCommands, "what the mission should do")};
constexpr std::array kRetract{
    integer("until_tick", 0.0, kBiggestWhole, "not farther back than the arm was then").otherwise(0.0)};
constexpr std::array kArchiveAlarm{
    text("text", 256, "what is lost or waits, and why"),
    integer("count", 0.0, kBiggestWhole, "how many records, ticks or rows are lost so far by it"),
};
constexpr std::array kTool{text("command", 64, "what the tool should do")};
constexpr std::array kStop{text("reason", 200, "why, shown by `state`: any JSON value, cut to 200 bytes").optional()};
constexpr std::array kTiming{flag("reset", "all counts begin anew after this answer").otherwise(0.0)};

constexpr std::array kStep{
    integer("index", 0.0, 1000.0, "number of the step"),
    text("name", 120, "what the step is called"),
    text("device", 16, "who steers"),
    text("task", 40, "what the operator should do").optional(),
    integer("entry", 1.0, kBiggestWhole, "how many steps of the mission have begun, this one included").optional(),
    text("waits", 120, "what the step waits for people for").optional(),
};
constexpr std::array kAnnounce{
    object("step", kStep, "the step that begins; null or left out: the mission has ended").or_null(),
    text("after", 120, "the condition that ended the step before").optional(),
};
constexpr std::array kOperatorSays{
    text("what", 40, "what the operator would say aloud"),
    integer("step", 0.0, 1000.0, "index of the step it is about").optional(),
    number("time_s", 0.0, 1e9, "arm time at which it is said").optional(),
};

constexpr std::array kToolPhases{"acting", "done", "failed"};
constexpr std::array kToolReport{
    integer("number", 1.0, kBiggestWhole, "of the command, as the tool was told"),
    word("phase", kToolPhases, "it acts, it has done it, it has failed"),
    text("reason", 120, "why it has failed").optional(),
    number("time_s", 0.0, 1e9, "arm time at which it is so"),
};
constexpr std::array kCamera{
    number("capture_time_s", 0.0, 1e9, "arm time of the picture"),
    pose("slit", 1000.0, "the slit's frame in the tip frame; null: not seen").or_null(),
    pose("rod", 1000.0, "the rod's frame in the tip frame; null: not seen").or_null(),
    pose("target", 1000.0, "the frame of what `servo_target` goes to, in the tip frame; null: not seen").or_null(),
    text("target_name", kTargetBytes, "what that is, and so which lens looks; `target` when left out").optional(),
};

}  // namespace liana::api::request_fields
