// Tip and shape together: the tick's shape motion against the best of 50 offline solves. `--count` random tip poses.
// Method: docs/explanation/shape.md.
#include <algorithm>
#include <cstdio>
#include <vector>

#include "host/model/inverse_kinematics/goal_ik.hpp"
#include "tests/firmware_like/zhu2022.hpp"
#include "tests/numbers/options.hpp"

namespace liana::numbers {

using namespace cable;
namespace {

using zhu2022::Random;

constexpr double kRadius_m = 0.3;      // node targets lie within this of the nodes
constexpr std::int32_t kOffline = 50;  // solves, from random starts for the same tip pose
constexpr std::int32_t kRun_s = 120;
constexpr std::int32_t kGuide_s = 60;    // nodes to those of the goal IK's shape first
constexpr std::int32_t kHeavier_s = 60;  // one node with four times its weight
constexpr double kWithin = 1.01;
constexpr double kZero_m = 1e-4;  // what counts as zero in a sum

// What a run of ticks did at worst.
struct Worst {
  double tip_m_rad = 0.0;  // error after each tick's correction
  double rate_rad_s = 0.0;
  double accel_rad_s2 = 0.0;
};

struct Arm {
  cable::ThetaVector theta_rad{};
  cable::ShapeState shape{};
  cable::ThetaVector rate_rad_s{};
};

void run_ticks(const cable::RobotParams& robot, const cable::IkGoal& goal, const cable::NodeTargets& nodes,
               std::int32_t seconds, Arm& arm, Worst& worst) {
  const std::int32_t ticks = static_cast<std::int32_t>(seconds / robot.tick_s);
  for (std::int32_t i = 0; i < ticks; ++i) {
    const cable::ThetaVector before = arm.theta_rad, rate_before = arm.rate_rad_s;
    const cable::ArmKinematics at = forward_kinematics(robot, before);
    const cable::ThetaVector move =
        shape_move(robot, at, nodes, {}, goal.held_mask, cable::kShapeAlone, before, arm.shape);
    arm.shape.tick = (arm.shape.tick + 1) % cable::kShapeTicks;
    arm.theta_rad = zhu2022::plus(before, move);
    servo_ik(robot, goal, at, arm.theta_rad);
    const Pose tip = tip_pose(robot, arm_trig(robot, arm.theta_rad));
    worst.tip_m_rad = std::max(worst.tip_m_rad, zhu2022::length(pose_error(goal.tip_in_base, tip)));
    for (std::size_t k = 0; k < zhu2022::kThetas; ++k) {
      arm.rate_rad_s[k] = (arm.theta_rad[k] - before[k]) / robot.tick_s;
      worst.rate_rad_s = std::max(worst.rate_rad_s, std::fabs(arm.rate_rad_s[k]));
      worst.accel_rad_s2 = std::max(worst.accel_rad_s2, std::fabs(arm.rate_rad_s[k] - rate_before[k]) / robot.tick_s);
    }
  }
}

struct Case {
  cable::ThetaVector start_rad{};
  inverse_kinematics::ShapeProblem problem{};
  std::int32_t nodes = 0;
  bool thresholds = false;
};

// One to three nodes, node 3 first; weights 0.2 to 2; every fourth case has thresholds up to 50 mm.
Case random_case(const cable::RobotParams& robot, std::int32_t index, Random& random) {
  constexpr std::int32_t kOrder[] = {3, 2, 4};
  Case out;
  out.start_rad = random.theta(robot, 15.0);
  out.nodes = 1 + index % 3;
  out.thresholds = index % 4 == 3;
  const cable::ArmKinematics arm = forward_kinematics(robot, out.start_rad);
  out.problem.goal = {arm.tip_in_base, 0};
  for (std::int32_t i = 0; i < out.nodes; ++i) {
    Vec3 offset = random.vector(kRadius_m);
    while (norm(offset) > kRadius_m) offset = random.vector(kRadius_m);
    const double weight = random.uniform(0.2, 2.0), threshold_m = random.uniform(0.0, 0.05);
    const Vec3 node = arm.node_in_base[static_cast<std::size_t>(kOrder[i])].position_m;
    out.problem.node[static_cast<std::size_t>(i)] = {kOrder[i], add(node, offset), weight,
                                                     out.thresholds ? threshold_m : 0.0};
  }
  return out;
}

// Least sum of `kOffline` solutions from random starts and of the one from the case's own start.
double best_offline_m(const cable::RobotParams& robot, const Case& c, double from_start_m, Random& random) {
  double best_m = from_start_m;
  std::int32_t iterations = 0;
  for (std::int32_t found = 0, tries = 0; found < kOffline && tries < 10 * kOffline; ++tries) {
    inverse_kinematics::GoalIkProblem tip_only;
    tip_only.tip_in_base = c.problem.goal.tip_in_base;
    tip_only.from_rad = random.theta(robot, 19.0);
    inverse_kinematics::GoalIkResult solution = inverse_kinematics::solve_goal(robot, tip_only);
    if (!solution.converged) continue;
    ++found;
    best_m = std::min(best_m, inverse_kinematics::improve_shape(robot, c.problem, solution.theta_rad, iterations));
  }
  return best_m;
}

cable::NodeTargets nodes_of(const cable::RobotParams& robot, const cable::ThetaVector& theta) {
  const cable::ArmKinematics arm = forward_kinematics(robot, theta);
  cable::NodeTargets nodes{};
  for (std::size_t i = 0; i < nodes.size(); ++i)
    nodes[i] = {static_cast<std::int32_t>(i) + 1, arm.node_in_base[i + 1].position_m, 1.0, 0.0};
  return nodes;
}

bool reaches(double sum_m, double best_m) { return sum_m <= kWithin * best_m + kZero_m; }

struct Tally {
  std::int32_t cases = 0;
  std::int32_t tick_same_branch = 0;  // of the offline solve from the same start
  std::int32_t tick_best = 0;         // of the best offline solve
  std::int32_t goal_best = 0;         // the goal IK's own answer
  std::int32_t guided_best = 0;       // the tick, led to the goal IK's shape first
  std::int32_t with_thresholds = 0, thresholds_best = 0;
  std::int32_t with_rivals = 0, heavier_closer = 0;
  Worst worst;
};

// Four times the weight of node 3 does not let it move away.
void try_heavier(const cable::RobotParams& robot, const Case& c, Arm arm, Tally& tally) {
  ++tally.with_rivals;
  const auto distance_m = [&] {
    const cable::ArmKinematics at = forward_kinematics(robot, arm.theta_rad);
    return norm(subtract(c.problem.node[0].position_m, at.node_in_base[3].position_m));
  };
  const double before_m = std::max(distance_m(), c.problem.node[0].threshold_m);
  cable::NodeTargets heavier = c.problem.node;
  heavier[0].weight *= 4.0;
  run_ticks(robot, c.problem.goal, heavier, kHeavier_s, arm, tally.worst);
  tally.heavier_closer += distance_m() <= before_m + 1e-3 ? 1 : 0;
}

void study(const cable::RobotParams& robot, std::int32_t index, Tally& tally) {
  Random random(1000 + static_cast<std::uint64_t>(index));
  const Case c = random_case(robot, index, random);
  std::int32_t iterations = 0;
  cable::ThetaVector nearest = c.start_rad;
  const double branch_m = inverse_kinematics::improve_shape(robot, c.problem, nearest, iterations);
  const double best_m = best_offline_m(robot, c, branch_m, random);
  const inverse_kinematics::GoalIkResult goal =
      inverse_kinematics::solve_goal(robot, {c.problem.goal.tip_in_base, c.start_rad, 0, {}, c.problem.node, {}});

  Arm arm{c.start_rad, {}, {}};
  run_ticks(robot, c.problem.goal, c.problem.node, kRun_s, arm, tally.worst);
  const double tick_m = inverse_kinematics::shape_sum_m(robot, c.problem, arm.theta_rad);
  if (c.nodes > 1) try_heavier(robot, c, arm, tally);

  Arm guided{c.start_rad, {}, {}};
  run_ticks(robot, c.problem.goal, nodes_of(robot, goal.theta_rad), kGuide_s, guided, tally.worst);
  run_ticks(robot, c.problem.goal, c.problem.node, kRun_s, guided, tally.worst);
  const double guided_m = inverse_kinematics::shape_sum_m(robot, c.problem, guided.theta_rad);

  ++tally.cases;
  tally.tick_same_branch += reaches(tick_m, branch_m) ? 1 : 0;
  tally.tick_best += reaches(tick_m, best_m) ? 1 : 0;
  tally.goal_best += reaches(inverse_kinematics::shape_sum_m(robot, c.problem, goal.theta_rad), best_m) ? 1 : 0;
  tally.guided_best += reaches(guided_m, best_m) ? 1 : 0;
  tally.with_thresholds += c.thresholds ? 1 : 0;
  tally.thresholds_best += c.thresholds && reaches(guided_m, best_m) ? 1 : 0;
}

void print(const Tally& t, bool json) {
  const char* format = json ? "{\"cases\":%d,\"tick_same_branch\":%d,\"tick_best\":%d,\"goal_best\":%d,\"guided_best\":"
                              "%d,\"with_thresholds\":%d,"
                              "\"thresholds_best\":%d,\"with_rivals\":%d,\"heavier_closer\":%d,\"worst_tip_error\":%."
                              "3e,\"worst_rate_deg_s\":%.4f,"
                              "\"worst_accel_deg_s2\":%.4f}\n"
                            : "cases %d; within 1 %% of the offline solve from the same start %d, of the best of 50: "
                              "tick %d, goal IK %d, tick led by the "
                              "goal IK %d\nwith thresholds %d, of these best %d; with rival nodes %d, of these the "
                              "heavier came no farther %d\n"
                              "worst tip error %.3e (m and rad), rate %.4f deg/s, acceleration %.4f deg/s2\n";
  std::printf(format, t.cases, t.tick_same_branch, t.tick_best, t.goal_best, t.guided_best, t.with_thresholds,
              t.thresholds_best, t.with_rivals, t.heavier_closer, t.worst.tip_m_rad, t.worst.rate_rad_s / kDegree,
              t.worst.accel_rad_s2 / kDegree);
}

void run(const Options& options) {
  const cable::RobotParams robot = zhu2022::table();
  Tally tally;
  for (std::int32_t i = 0; i < options.count; ++i) study(robot, i, tally);
  print(tally, options.json);
}

}  // namespace
}  // namespace liana::numbers

int main(int argc, char** argv) {
  liana::numbers::run(liana::numbers::parse_options(argc, argv, 500));
  return 0;
}
