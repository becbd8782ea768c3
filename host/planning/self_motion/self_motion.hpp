// The self-motion of a serial arm with one joint more than a pose needs: all configurations that a continuous motion
// reaches while the tip stays, and how far the tip gives way in each (requirements B10 to B13).
#pragma once

#include <vector>

#include "firmware_like/math/pose.hpp"
#include "firmware_like/serial/robot_params.hpp"

namespace liana::self_motion {

constexpr double kStep_rad = 0.005;       // of all joints together, from one configuration to the next
constexpr std::size_t kMaxSteps = 20000;  // no self-motion of an arm within the capacity is longer than 100 rad
constexpr double kMaxTipDrift_m = 1e-9;   // what "the tip stays" means

// One configuration of the self-motion.
struct Configuration {
  serial::JointVector joint_rad{};    // not wrapped: it goes on from the one before
  double arm_angle_rad = 0.0;         // of the elbow about the line from shoulder to wrist, since the start
  double tip_drift_m = 0.0;           // from where the tip was at the start
  double tip_turn_rad = 0.0;          // largest component of its turn since then
  Vec3 deflection_m_per_N{};          // C e_z: where the tip goes under 1 N along its z axis, in the tip frame
  double least_singular_value = 0.0;  // of the 6x7 Jacobian, lengths in metres
  bool within_ranges = false;         // each angle, or the same by whole turns, is within its joint's range
};

struct SelfMotion {
  std::vector<Configuration> way;  // from the start on
  bool closed = false;             // it came back to the start, but for whole turns
};

// Follows the null space of the Jacobian from `start_rad` until it is back, or kMaxSteps are done, or the arm is
// singular. C = J Kq^-1 J^T (rows of the tip's position) with the joints' stiffness [N m/rad], all > 0. `table` has 7
// joints. The elbow is the origin of the middle frame, shoulder and wrist those of the first and last but one, which
// stand still with base and tip. Cost: about 15 us a step.
SelfMotion self_motion(const serial::RobotParams& table, const serial::JointVector& stiffness_Nm_rad,
                       const serial::JointVector& start_rad);

}  // namespace liana::self_motion
