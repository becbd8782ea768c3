// Goal IK of a serial arm: joint angles for a tip pose from anywhere, with restarts in a fixed order. Outside the tick.
//
// Attempt 0 starts where the arm is, each later one at the best of kSerialGoalSeeds pseudo-random poses of a fixed
// sequence: same input, same result. Of the first kSerialGoalChoices solutions the one that the arm reaches soonest is
// taken, whole turns of joints included.
#pragma once

#include <cstdint>

#include "firmware_like/serial/kinematics.hpp"

namespace liana::inverse_kinematics {

constexpr std::int32_t kSerialGoalAttempts = 100;
constexpr std::int32_t kSerialGoalIterations = 60;  // per attempt, at most
constexpr std::int32_t kSerialGoalSeeds = 32;       // poses that an attempt chooses from
constexpr std::int32_t kSerialGoalChoices = 8;      // solutions among which the nearest is taken

struct SerialGoal {
  Pose tip_in_base{};
  serial::JointVector from_rad{};  // where the arm is
};

struct SerialGoalResult {
  serial::JointVector joint_rad{};  // inside the ranges; the best found when not converged
  bool converged = false;           // position and attitude within serial::kIkConvergedError
  std::int32_t iterations = 0;      // over all attempts
  double position_error_m = 0.0;
  double attitude_error_rad = 0.0;
  double move_s = 0.0;  // how long the joint that needs longest turns at its full rate, from `from`
};

// Cost: at most kSerialGoalAttempts * kSerialGoalIterations steps, about 20 ms when there is no solution.
SerialGoalResult solve_goal(const serial::RobotParams& table, const SerialGoal& goal) noexcept;

}  // namespace liana::inverse_kinematics
