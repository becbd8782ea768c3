// What every program of the bench works on, so that ours and the peers see the same: seeded, and the same on every
// machine.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "firmware_like/cable/motion/servo_ik.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::bench {

using namespace cable;

constexpr double kSolved = 1e-6;     // m and rad: when an inverse problem counts as solved
constexpr double kAgreement = 1e-9;  // m and rad, ours against a peer
constexpr double kNearMove_m = 0.01;
constexpr std::size_t kCalls = 64;      // counted for each operation
constexpr std::size_t kSlowCalls = 16;  // the same where one call takes millions of instructions
constexpr std::size_t kTargets = 1000;  // random goals for success rates

// Random poses, every theta within +-15 deg.
inline std::vector<cable::ThetaVector> random_poses(const cable::RobotParams& robot, std::size_t count,
                                                    std::uint64_t seed = 1) {
  zhu2022::Random random(seed);
  std::vector<cable::ThetaVector> poses;
  for (std::size_t i = 0; i < count; ++i) poses.push_back(random.theta(robot, 15.0));
  return poses;
}

// A tip pose to solve for and the angles to start from.
struct IkProblem {
  Pose tip_in_base{};
  cable::ThetaVector from_rad{};
};

// Targets 10 mm away in random directions, attitude unchanged.
inline std::vector<IkProblem> near_problems(const cable::RobotParams& robot, std::size_t count) {
  zhu2022::Random random(2);
  std::vector<IkProblem> problems;
  while (problems.size() < count) {
    const Vec3 way = random.vector(1.0);
    if (norm(way) > 1.0 || norm(way) < 0.1) continue;
    IkProblem problem;
    problem.from_rad = zhu2022::radians(zhu2022::kPrepare_deg);
    problem.tip_in_base = forward_kinematics(robot, problem.from_rad).tip_in_base;
    problem.tip_in_base.position_m = add(problem.tip_in_base.position_m, scale(way, kNearMove_m / norm(way)));
    problems.push_back(problem);
  }
  return problems;
}

// Tips of random poses, from the straight arm.
inline std::vector<IkProblem> random_problems(const cable::RobotParams& robot, std::size_t count) {
  std::vector<IkProblem> problems;
  for (const cable::ThetaVector& theta : random_poses(robot, count, 3))
    problems.push_back({forward_kinematics(robot, theta).tip_in_base, {}});
  return problems;
}

// Throws std::runtime_error unless `difference` is within `allowed`; NaN is not.
inline void require_agreement(const std::string& what, double difference, double allowed = kAgreement) {
  if (difference <= allowed) return;
  throw std::runtime_error("bench: " + what + " differs by " + std::to_string(difference) + ", allowed is " +
                           std::to_string(allowed));
}

// Size of the tip error [m and rad, together].
inline double tip_difference(const Pose& a, const Pose& b) { return zhu2022::length(pose_error(a, b)); }

// Largest difference of any entry.
inline double jacobian_difference(const cable::Jacobian& a, const cable::Jacobian& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < cable::kMaxTheta; ++k) {
    largest = std::max({largest, zhu2022::largest_difference(a.linear[k], b.linear[k]),
                        zhu2022::largest_difference(a.angular[k], b.angular[k])});
  }
  return largest;
}

}  // namespace liana::bench
