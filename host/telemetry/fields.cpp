#include "host/telemetry/fields.hpp"

namespace liana::telemetry {

const std::array<Field, 36> kFields{{
    {"measured_js_deg", "deg", Shape::kJoints},
    {"setpoint_js_deg", "deg", Shape::kJoints},
    {"verdict.twin_js_deg", "deg", Shape::kJoints},
    {"measured_cp", "m, 1", Shape::kPose},
    {"setpoint_cp", "m, 1", Shape::kPose},
    {"goal_cp", "m, 1", Shape::kPose},
    {"node_m", "m", Shape::kFound},
    {"tension_N", "N", Shape::kFound},
    {"torque_Nm", "Nm", Shape::kFound},
    {"drives.position_m", "m", Shape::kEach},
    {"drives.position_deg", "deg", Shape::kEach},
    {"buses.measured_load", "1", Shape::kEach},
    {"buses.frames", "1", Shape::kEach},
    {"buses.errors", "1", Shape::kEach},
    {"clearance.distance_m", "m", Shape::kOne},
    {"clearance.bound_m", "m", Shape::kOne},
    {"clearance.link", "1", Shape::kOne},
    {"clearance.where_m", "m", Shape::kThree},
    {"clearance.picture_age_s", "s", Shape::kOne},
    {"clearance.shift_m", "m", Shape::kThree},
    {"clearance.turn_deg", "deg", Shape::kThree},
    {"ik.residual_m", "m", Shape::kThree},
    {"ik.residual_rad", "rad", Shape::kThree},
    {"shape.missing_m", "m", Shape::kOne},
    {"friction.mu", "1", Shape::kOne},
    {"friction.sd", "1", Shape::kOne},
    {"contact.torque_Nm", "Nm", Shape::kOne},
    {"contact.tip_push_N", "N", Shape::kThree},
    {"verdict.sequence", "1", Shape::kOne},
    {"verdict.code", "1", Shape::kOne},
    {"verdict.share", "1", Shape::kOne},
    {"device_samples", "1", Shape::kOne},
    {"overruns", "1", Shape::kOne},
    {"refusals", "1", Shape::kOne},
    {"path.share", "1", Shape::kOne},
    {"retract.points_left", "1", Shape::kOne},
}};

}  // namespace liana::telemetry
