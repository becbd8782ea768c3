// Pieces of the state message that the desks of all kinds of arm use.
#pragma once

#include "firmware_like/math/pose.hpp"
#include "firmware_like/math/trig.hpp"
#include "host/base/json/json.hpp"
#include "host/control/arbiter/retract_events.hpp"

namespace liana::server {

constexpr double in_degrees(double rad) { return rad / kDegree; }

// [x, y, z, qw, qx, qy, qz].
inline Json pose_json(const Pose& p) {
  return {p.position_m[0], p.position_m[1], p.position_m[2], p.quaternion[0],
          p.quaternion[1], p.quaternion[2], p.quaternion[3]};
}

// What the arm carries, as it was told last.
inline Json payload_json(double mass_kg, const Vec3& center_m) {
  return {{"mass_kg", mass_kg}, {"center_m", center_m}};
}

// The retract under way, or how the last one went.
inline void add_retract(Json& state, const arbiter::RetractState& retract) {
  state["retracted"] = retract.phase == arbiter::RetractPhase::kDone;
  state["retract"] = {{"phase", arbiter::retract_phase_name(retract.phase)},
                      {"points_left", retract.points_left},
                      {"points", retract.points},
                      {"reason", retract.reason}};
}

// Commanded tip and servo IK, which the reports of all arms show by the same names.
template <class Outputs>
void add_tip(Json& state, const Outputs& o) {
  state["setpoint_cp"] = pose_json(o.tip_command);
  state["goal_cp"] = pose_json(o.tip_goal);
  state["ik"] = {{"outcome", ik_outcome_name(o.ik_outcome)},
                 {"residual_m", {o.ik_residual[0], o.ik_residual[1], o.ik_residual[2]}},
                 {"residual_rad", {o.ik_residual[3], o.ik_residual[4], o.ik_residual[5]}}};
}

}  // namespace liana::server
