// Random reachable goals from the zero pose: how many the goal IK finds, with what effort. `--count` goals for each
// kind.
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "host/model/inverse_kinematics/goal_ik.hpp"
#include "tests/firmware_like/zhu2022.hpp"
#include "tests/numbers/options.hpp"

namespace liana::numbers {

using namespace cable;
namespace {

struct Kind {
  const char* held;
  std::uint32_t held_mask;
  double range_deg;
};
constexpr Kind kKinds[] = {{"free", 0, 15.0}, {"X5", 1u << 8, 15.0}, {"X4 and X5", (1u << 6) | (1u << 8), 15.0},
                           {"free", 0, 19.0}, {"X5", 1u << 8, 19.0}, {"X4 and X5", (1u << 6) | (1u << 8), 19.0}};

struct Outcome {
  std::int32_t converged = 0;
  std::int32_t wrong = 0;  // claimed, but beyond 1e-6, a limit, or a held value
  std::vector<std::int32_t> iterations;
};

bool is_right(const cable::RobotParams& robot, const inverse_kinematics::GoalIkProblem& problem,
              const cable::ThetaVector& theta) {
  const auto e = pose_error(problem.tip_in_base, forward_kinematics(robot, theta).tip_in_base);
  bool right = norm({e[0], e[1], e[2]}) <= 1e-6 && norm({e[3], e[4], e[5]}) <= 1e-6;
  for (std::size_t k = 0; k < zhu2022::kThetas; ++k) {
    right = right && std::fabs(theta[k]) <= robot.segment[k / 2].theta_limit_rad;
    right = right && (((problem.held_mask >> k) & 1u) == 0 || theta[k] == problem.held_rad[k]);
  }
  return right;
}

Outcome measure(const cable::RobotParams& robot, const Kind& kind, std::int32_t count, std::uint64_t seed) {
  zhu2022::Random random(seed);
  Outcome outcome;
  for (std::int32_t i = 0; i < count; ++i) {
    cable::ThetaVector theta = random.theta(robot, kind.range_deg);
    for (std::size_t k = 0; k < zhu2022::kThetas; ++k) {
      if (((kind.held_mask >> k) & 1u) != 0) theta[k] = 0.0;
    }
    inverse_kinematics::GoalIkProblem problem;
    problem.tip_in_base = forward_kinematics(robot, theta).tip_in_base;
    problem.held_mask = kind.held_mask;
    const inverse_kinematics::GoalIkResult result = inverse_kinematics::solve_goal(robot, problem);
    outcome.converged += result.converged ? 1 : 0;
    outcome.wrong += result.converged && !is_right(robot, problem, result.theta_rad) ? 1 : 0;
    outcome.iterations.push_back(result.iterations);
  }
  std::sort(outcome.iterations.begin(), outcome.iterations.end());
  return outcome;
}

void print(const Kind& kind, const Outcome& o, bool json, bool first) {
  const std::size_t n = o.iterations.size();
  const char* format = json ? "%s{\"held\":\"%s\",\"range_deg\":%g,\"goals\":%zu,\"converged\":%d,\"wrong\":%d,"
                              "\"iterations\":{\"median\":%d,"
                              "\"p99\":%d,\"most\":%d}}"
                            : "%sheld %-10s theta within %g deg: %zu goals, %d converged, %d wrong; iterations median "
                              "%d, p99 %d, most %d\n";
  std::printf(format, !json ? "" : (first ? "[" : ","), kind.held, kind.range_deg, n, o.converged, o.wrong,
              o.iterations[n / 2], o.iterations[n * 99 / 100], o.iterations.back());
}

void run(const Options& options) {
  const cable::RobotParams robot = zhu2022::table();
  std::uint64_t seed = 20260;
  for (const Kind& kind : kKinds) {
    print(kind, measure(robot, kind, options.count, seed), options.json, seed == 20260);
    ++seed;
  }
  if (options.json) std::puts("]");
}

}  // namespace
}  // namespace liana::numbers

int main(int argc, char** argv) {
  liana::numbers::run(liana::numbers::parse_options(argc, argv, 20000));
  return 0;
}
