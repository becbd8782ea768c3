// The small arm (docs/reference/formats.md, robot micro) as the core's table, and the random joints that its tests
// share.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

#include "firmware_like/math/trig.hpp"
#include "firmware_like/serial/kinematics.hpp"

namespace liana::serial::micro {

constexpr std::size_t kJoints = 7;
constexpr double kRange_deg = 270.0;

using Degrees = std::array<double, kJoints>;
constexpr Degrees kBent_deg{-77, -117, -97, 139, 125, 107, 46};  // where the payload study works

constexpr std::array<DhRow, kJoints> kDhRows{{
    {90.0 * kDegree, 0.0, 0.28, 0.0},
    {90.0 * kDegree, 0.0, 0.22, 0.0},
    {0.0, 2.10, 0.20, 0.0},
    {0.0, 2.10, 0.0, 0.0},
    {90.0 * kDegree, 0.0, 0.20, 0.0},
    {-90.0 * kDegree, 0.0, 0.22, 0.0},
    {0.0, 0.0, 0.28, 0.0},
}};

// The arm at 250 Hz with T_c = 20 ms.
inline RobotParams table() {
  RobotParams robot;
  robot.joint_count = static_cast<std::int32_t>(kJoints);
  for (std::size_t i = 0; i < kJoints; ++i) {
    robot.joint[i] = {kDhRows[i], -kRange_deg * kDegree, kRange_deg * kDegree, 4.0 * kDegree, 4.0 * kDegree};
    robot.drive[i] = {2.0 * kPi / 1048576.0, i % 2 == 0 ? 1 : -1, 1000000, 0.15};
  }
  robot.tip = {0.10, 0.10, 0.4, 3.0 * kDegree, 3.0 * kDegree, 12.0 * kDegree};
  robot.servo_time_constant_s = 0.03;
  robot.tick_s = 0.004;
  robot.interval_ticks = 5;
  return robot;
}

// Another arm within the capacity: six joints, offsets, other twists and uneven ranges.
inline RobotParams six_joint_table() {
  RobotParams robot = table();
  robot.joint_count = 6;
  for (std::size_t i = 0; i < 6; ++i) robot.joint[i].dh.offset_rad = (10.0 * static_cast<double>(i) - 20.0) * kDegree;
  robot.joint[1].dh = {75.0 * kDegree, 0.1, -0.2, 0.3};
  robot.joint[2].low_rad = -40.0 * kDegree;
  robot.joint[4].high_rad = 60.0 * kDegree;
  return robot;
}

inline JointVector radians(const Degrees& joint_deg) {
  JointVector joint{};
  for (std::size_t i = 0; i < kJoints; ++i) joint[i] = joint_deg[i] * kDegree;
  return joint;
}

// Repeatable random numbers; the same on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  // Evenly spread in [low, high).
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) / 9007199254740992.0;
  }

 private:
  std::mt19937_64 engine_;
};

// Joints anywhere in `share` of their ranges.
inline JointVector random_joints(const RobotParams& robot, Random& random, double share = 1.0) {
  JointVector joint{};
  for (std::size_t i = 0; i < robot.joints(); ++i) {
    const double middle = 0.5 * (robot.joint[i].low_rad + robot.joint[i].high_rad);
    joint[i] = middle + share * random.uniform(robot.joint[i].low_rad - middle, robot.joint[i].high_rad - middle);
  }
  return joint;
}

// Every joint turned by up to `max_rad`, inside its range.
inline JointVector near(const RobotParams& robot, const JointVector& joint_rad, Random& random, double max_rad) {
  JointVector joint = joint_rad;
  for (std::size_t i = 0; i < robot.joints(); ++i) {
    joint[i] =
        std::clamp(joint[i] + random.uniform(-max_rad, max_rad), robot.joint[i].low_rad, robot.joint[i].high_rad);
  }
  return joint;
}

inline bool within_ranges(const RobotParams& robot, const JointVector& joint_rad) {
  for (std::size_t i = 0; i < robot.joints(); ++i) {
    if (!(joint_rad[i] >= robot.joint[i].low_rad && joint_rad[i] <= robot.joint[i].high_rad)) return false;
  }
  return true;
}

inline double largest_difference(const JointVector& a, const JointVector& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::fabs(a[i] - b[i]));
  return largest;
}

// det(J J^T), the square of the volume that the joints' columns span: how far from a singular pose.
inline double determinant(const RobotParams& robot, const Jacobian& J) {
  std::array<std::array<double, 6>, 6> A{};
  for (std::size_t i = 0; i < robot.joints(); ++i) {
    const std::array<double, 6> c{J.linear[i][0],  J.linear[i][1],  J.linear[i][2],
                                  J.angular[i][0], J.angular[i][1], J.angular[i][2]};
    for (std::size_t r = 0; r < 6; ++r) {
      for (std::size_t k = 0; k < 6; ++k) A[r][k] += c[r] * c[k];
    }
  }
  double det = 1.0;  // Gaussian elimination of a positive matrix needs no pivots
  for (std::size_t k = 0; k < 6; ++k) {
    det *= A[k][k];
    for (std::size_t r = k + 1; r < 6; ++r) {
      const double f = A[r][k] / A[k][k];
      for (std::size_t c = k; c < 6; ++c) A[r][c] -= f * A[k][c];
    }
  }
  return det;
}

}  // namespace liana::serial::micro
