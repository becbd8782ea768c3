#include "host/model/inverse_kinematics/serial_goal_ik.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "firmware_like/math/trig.hpp"
#include "firmware_like/serial/servo_ik.hpp"

namespace liana::inverse_kinematics {
namespace {

using serial::JointParams;
using serial::JointVector;
using serial::RobotParams;

constexpr double kNear = 1e-3;  // m and rad: from here an attempt goes on while each step brings it nearer

JointVector random_pose(const RobotParams& table, std::mt19937_64& random) {
  JointVector joint{};
  for (std::size_t i = 0; i < table.joints(); ++i) {
    const double share = static_cast<double>(random() >> 11) / 9007199254740992.0;  // the same on every machine
    joint[i] = table.joint[i].low_rad + share * (table.joint[i].high_rad - table.joint[i].low_rad);
  }
  return joint;
}

double distance2(const Pose& a, const Pose& b) {
  const Vec3 way = subtract(a.position_m, b.position_m),
             turn = rotation_vector(multiply(a.quaternion, conjugate(b.quaternion)));
  return dot(way, way) + dot(turn, turn);
}

// The random pose whose tip is nearest to the goal.
JointVector next_start(const RobotParams& table, const SerialGoal& goal, std::mt19937_64& random) {
  JointVector best{};
  double least = 1e300;
  for (std::int32_t i = 0; i < kSerialGoalSeeds; ++i) {
    const JointVector joint = random_pose(table, random);
    const double distance = distance2(goal.tip_in_base, forward_kinematics(table, joint).tip_in_base);
    if (!(distance < least)) continue;
    least = distance;
    best = joint;
  }
  return best;
}

JointVector inside_ranges(const RobotParams& table, JointVector joint_rad) {
  for (std::size_t i = 0; i < table.joints(); ++i)
    joint_rad[i] = std::clamp(joint_rad[i], table.joint[i].low_rad, table.joint[i].high_rad);
  return joint_rad;
}

// One attempt; counts its iterations.
void approach(const RobotParams& table, const SerialGoal& goal, JointVector& joint_rad, std::int32_t& iterations) {
  double before = 1e300;
  for (std::int32_t i = 0; i < kSerialGoalIterations; ++i, ++iterations) {
    const double error = far_step(table, goal.tip_in_base, joint_rad);
    if (error < 1e-9 || (error < kNear && error >= before)) return;
    before = error;
  }
}

// The same pose of the arm with whole turns added, as near to `from` as the range allows.
double nearest_turn(const JointParams& joint, double angle_rad, double from_rad) {
  double best = angle_rad;
  for (const double turned : {angle_rad - 2.0 * kPi, angle_rad + 2.0 * kPi}) {
    if (turned >= joint.low_rad && turned <= joint.high_rad &&
        std::fabs(turned - from_rad) < std::fabs(best - from_rad))
      best = turned;
  }
  return best;
}

double move_s(const RobotParams& table, const JointVector& from_rad, const JointVector& to_rad) {
  double longest = 0.0;
  for (std::size_t i = 0; i < table.joints(); ++i) {
    longest = std::max(longest, std::fabs(to_rad[i] - from_rad[i]) / table.joint[i].rate_rad_s);
  }
  return longest;
}

SerialGoalResult result_at(const RobotParams& table, const SerialGoal& goal, JointVector joint_rad) {
  for (std::size_t i = 0; i < table.joints(); ++i)
    joint_rad[i] = nearest_turn(table.joint[i], joint_rad[i], goal.from_rad[i]);
  const serial::IkResult report = report_ik(table, goal.tip_in_base, forward_kinematics(table, joint_rad).tip_in_base);
  return {joint_rad,
          report.outcome == IkOutcome::kConverged,
          0,
          report.position_error_m,
          report.attitude_error_rad,
          move_s(table, goal.from_rad, joint_rad)};
}

bool is_better(const SerialGoalResult& a, const SerialGoalResult& b) {
  if (a.converged != b.converged) return a.converged;
  if (a.converged) return a.move_s < b.move_s;
  return std::hypot(a.position_error_m, a.attitude_error_rad) < std::hypot(b.position_error_m, b.attitude_error_rad);
}

}  // namespace

SerialGoalResult solve_goal(const RobotParams& table, const SerialGoal& goal) noexcept {
  SerialGoalResult best;
  std::mt19937_64 random(1);
  std::int32_t iterations = 0, found = 0;
  for (std::int32_t attempt = 0; attempt < kSerialGoalAttempts && found < kSerialGoalChoices; ++attempt) {
    JointVector joint = attempt == 0 ? inside_ranges(table, goal.from_rad) : next_start(table, goal, random);
    approach(table, goal, joint, iterations);
    const SerialGoalResult result = result_at(table, goal, joint);
    if (result.converged) ++found;
    if (attempt == 0 || is_better(result, best)) best = result;
  }
  best.iterations = iterations;
  return best;
}

}  // namespace liana::inverse_kinematics
