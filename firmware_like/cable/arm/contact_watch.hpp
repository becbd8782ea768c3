// Something that touches the body: torque along the arm that neither cables nor friction nor a push at the tip explain.
//
// What friction_watch.hpp leaves unexplained about each angle is first freed from the push at the tip that fits it best
// (the tip is meant to press), then held against what friction, swing and torque gains can feign there. Measured
// sensitivity: docs/friction.md.
#pragma once

#include <cstdint>

#include "firmware_like/cable/arm/friction_watch.hpp"

namespace liana::cable {

constexpr std::uint8_t kContactSweeps = 2;      // of all angles in a row: 0.64 s
constexpr double kContactTip_N = 3.0;           // a push at the tip is explained up to this
constexpr double kContactTorque_Nm = 2.5;       // hidden at every angle: torque gains
constexpr double kContactSwing_rad_s2 = 0.003;  // hidden: the body beyond an angle swings with so much, unmeasured
constexpr double kContactFriction = 0.6;        // hidden: share of what friction can do

constexpr double kContactInertia = 0.2;  // hidden: share of the most that commanded acceleration can ask for
constexpr double kContactCalm_s = 2.0;   // swing after an acceleration is forgotten in

// Limits derived once from the robot table.
struct ContactWatchLimits {
  SegmentVector hidden_Nm{};  // at a segment's angles, at rest and without friction
  SegmentVector inertia{};    // modules times the root of the inertia beyond, kg^0.5 m: the product of two segments' is
                              // the most that one's acceleration asks of the other
};
ContactWatchLimits make_contact_watch_limits(const RobotTable& table) noexcept;

struct ContactWatchState {
  std::uint8_t sweeps = 0;    // in a row that felt something, up to kContactSweeps
  std::int32_t segment = -1;  // 0-based, the last one that felt it; -1: none
  double torque_Nm = 0.0;     // largest about any angle that nothing explains
  Vec3 tip_push_N{};          // explains the rest, base frame
  ThetaVector rate_rad_s{};   // commanded, when the last round ended
  double stir = 0.0;          // acceleration of all segments, each times its `inertia`; fades
};

// One look at all angles, after the friction watch has gone round. `kinematics` and `rate_rad_s` as commanded.
void watch_contact(const RobotTable& table, const ContactWatchLimits& limits, const ArmKinematics& kinematics,
                   const ThetaVector& rate_rad_s, const FrictionWatchState& friction,
                   ContactWatchState& state) noexcept;

// True while something has touched the body for kContactSweeps.
inline bool is_in_contact(const ContactWatchState& state) noexcept { return state.sweeps >= kContactSweeps; }

}  // namespace liana::cable
