// Our operations beside our own straightforward versions of them, then whole ticks. Needs nothing but the core.
#include <cstdio>
#include <exception>

#include "host/model/inverse_kinematics/goal_ik.hpp"
#include "tests/benchmarks/own_80.hpp"
#include "tests/benchmarks/problems.hpp"
#include "tests/benchmarks/textbook_cables.hpp"
#include "tests/benchmarks/ticks.hpp"

namespace liana::bench {

using namespace cable;
namespace {

constexpr std::int32_t kIterations = 50;  // for near goals, at most

struct Bench {
  Meter meter;
  cable::RobotParams robot = zhu2022::table();
  HingeChain chain = hinge_chain(robot);
};

void forward(Bench& bench) {
  const cable::RobotParams& robot = bench.robot;
  const auto poses = random_poses(robot, kCalls);
  for (const cable::ThetaVector& theta : poses) {
    const cable::ArmKinematics ours = forward_kinematics(robot, theta),
                               own_80 = hinge_kinematics_summed(robot, bench.chain, theta);
    require_agreement("pose of the 80 hinges", tip_difference(ours.tip_in_base, own_80.tip_in_base));
    require_agreement("Jacobian of the 80 hinges", jacobian_difference(ours.tip_jacobian, own_80.tip_jacobian));
  }
  bench.meter.each("fk_jacobian", "ours", kCalls,
                   [&](std::size_t i) { return forward_kinematics(robot, poses[i]).tip_in_base.position_m[0]; });
  bench.meter.each("fk_jacobian", "own_80", kCalls, [&](std::size_t i) {
    return hinge_kinematics_summed(robot, bench.chain, poses[i]).tip_in_base.position_m[0];
  });
}

void cables(Bench& bench) {
  const cable::RobotParams& robot = bench.robot;
  const cable::CableLayout layout = cable_layout(robot);
  const auto poses = random_poses(robot, kCalls);
  for (const cable::ThetaVector& theta : poses) {
    const cable::CableGeometry ours = cable_geometry(robot, layout, arm_trig(robot, theta)),
                               textbook = textbook_cables(robot, layout, theta);
    require_agreement("cable length of the textbook", zhu2022::largest_difference(ours.length_m, textbook.length_m));
    for (std::size_t c = 0; c < cable::kMaxCables; ++c) {
      require_agreement("cable Jacobian of the textbook",
                        zhu2022::largest_difference(ours.jacobian_m_rad[c], textbook.jacobian_m_rad[c]));
    }
  }
  bench.meter.each("cable_jacobian", "ours", kCalls,
                   [&](std::size_t i) { return cable_geometry(robot, layout, arm_trig(robot, poses[i])).length_m[0]; });
  bench.meter.each("cable_jacobian", "textbook", kCalls,
                   [&](std::size_t i) { return textbook_cables(robot, layout, poses[i]).length_m[0]; });
}

// What a tick does, until the tip is there. Returns how often.
std::int32_t solve_near(const cable::RobotParams& robot, const IkProblem& problem, cable::ThetaVector& theta) {
  theta = problem.from_rad;
  for (std::int32_t i = 1; i <= kIterations; ++i) {
    servo_ik(robot, {problem.tip_in_base, 0}, forward_kinematics(robot, theta), theta);
    if (tip_difference(problem.tip_in_base, tip_pose(robot, arm_trig(robot, theta))) < kSolved) return i;
  }
  return kIterations;
}

std::int32_t solve_near(const HingeChain& chain, const IkProblem& problem, HingeVector& angle) {
  angle = hinge_angles(chain, problem.from_rad);
  for (std::int32_t i = 0; i < kIterations; ++i) {
    const HingeKinematics arm = hinge_kinematics(chain, angle);
    const auto error = pose_error(problem.tip_in_base, arm.tip_in_base);
    if (zhu2022::length(error) < kSolved) return i;
    hinge_ik_step(arm, error, cable::kDamping, angle);
  }
  return kIterations;
}

void near(Bench& bench) {
  const cable::RobotParams& robot = bench.robot;
  const auto problems = near_problems(robot, kCalls);
  cable::ThetaVector theta{};
  HingeVector angle{};
  std::int32_t steps = 0, hinge_steps = 0;
  for (const IkProblem& problem : problems) {
    steps += solve_near(robot, problem, theta);
    hinge_steps += solve_near(bench.chain, problem, angle);
    require_agreement("the near goal of ours",
                      tip_difference(problem.tip_in_base, forward_kinematics(robot, theta).tip_in_base), kSolved);
    require_agreement("the near goal of the 80 hinges",
                      tip_difference(problem.tip_in_base, hinge_kinematics(bench.chain, angle).tip_in_base), kSolved);
  }
  const double calls = static_cast<double>(kCalls);
  bench.meter.note("ik_near", "ours",
                   std::to_string(steps / calls).substr(0, 4) + " calls of servo_ik from fresh kinematics");
  bench.meter.note("ik_near", "own_80",
                   std::to_string(hinge_steps / calls).substr(0, 4) + " steps; 80 free hinges, no limits");
  bench.meter.each("ik_near", "ours", kCalls,
                   [&](std::size_t i) { return static_cast<double>(solve_near(robot, problems[i], theta)); });
  bench.meter.each("ik_near", "own_80", kCalls,
                   [&](std::size_t i) { return static_cast<double>(solve_near(bench.chain, problems[i], angle)); });
  bench.meter.each("ik_step", "ours", kCalls, [&](std::size_t i) {
    theta = problems[i].from_rad;
    return ik_step(robot, {problems[i].tip_in_base, 0}, cable::kDamping, theta).position_error_m;
  });
  const HingeVector from = hinge_angles(bench.chain, problems[0].from_rad);
  bench.meter.each("ik_step", "own_80", kCalls, [&](std::size_t i) {
    angle = from;
    const HingeKinematics arm = hinge_kinematics(bench.chain, angle);
    hinge_ik_step(arm, pose_error(problems[i].tip_in_base, arm.tip_in_base), cable::kDamping, angle);
    return angle[0];
  });
}

void random_goals(Bench& bench) {
  const auto problems = random_problems(bench.robot, kTargets);
  const auto solve = [&](std::size_t i) {
    return inverse_kinematics::solve_goal(bench.robot, {problems[i].tip_in_base, {}, 0, {}, {}});
  };
  if (!RUNNING_ON_VALGRIND) {
    std::size_t solved = 0;
    for (std::size_t i = 0; i < kTargets; ++i) {
      if (solve(i).converged) ++solved;
    }
    bench.meter.note("ik_random", "ours",
                     std::to_string(solved) + " of " + std::to_string(kTargets) + " solved, all within the limits");
  }
  for (std::size_t i = 0; i < kCalls; ++i)
    bench.meter.once("ik_random", "ours", [&] { return solve(i).position_error_m; });
}

}  // namespace
}  // namespace liana::bench

int main() try {
  liana::bench::Bench bench;
  liana::bench::forward(bench);
  liana::bench::cables(bench);
  liana::bench::near(bench);
  liana::bench::random_goals(bench);
  liana::bench::measure_ticks(bench.meter);
  bench.meter.print();
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
