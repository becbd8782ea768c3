#include "firmware_like/cable/motion/servo_ik.hpp"

#include <cmath>

#include "firmware_like/math/cholesky.hpp"
#include "firmware_like/math/scalar.hpp"

namespace liana::cable {
namespace {

using Index = std::size_t;
using Task = std::array<double, 6>;

bool is_set(std::uint32_t mask, Index i) noexcept { return ((mask >> i) & 1u) != 0; }

double limit_of(const RobotParams& table, Index theta) noexcept { return table.segment[theta / 2].theta_limit_rad; }

double size2(const Task& e) noexcept {
  return e[0] * e[0] + e[1] * e[1] + e[2] * e[2] + e[3] * e[3] + e[4] * e[4] + e[5] * e[5];
}

// J J^T + damping I over the thetas that `fixed` leaves free, factored.
struct TaskSolver {
  SquareMatrix<6> factor{};
  std::uint32_t fixed = 0;
  double damping = 0.0;
  bool regular = false;
};

// Sum of u v^T over the free columns, as rows; the loops of three are written out so that the sums stay in registers.
struct Block {
  Vec3 x{}, y{}, z{};
};

void add_outer(const Vec3& u, const Vec3& v, Block& sum) noexcept {
  sum.x = {sum.x[0] + u[0] * v[0], sum.x[1] + u[0] * v[1], sum.x[2] + u[0] * v[2]};
  sum.y = {sum.y[0] + u[1] * v[0], sum.y[1] + u[1] * v[1], sum.y[2] + u[1] * v[2]};
  sum.z = {sum.z[0] + u[2] * v[0], sum.z[1] + u[2] * v[1], sum.z[2] + u[2] * v[2]};
}

using Columns = std::array<Vec3, kMaxTheta>;

Block outer_sum(const Columns& u, const Columns& v, Index n, std::uint32_t fixed) noexcept {
  Block sum;
  for (Index k = 0; k < n; ++k) {
    if (!is_set(fixed, k)) add_outer(u[k], v[k], sum);
  }
  return sum;
}

void put_block(const Block& block, Index row, Index column, SquareMatrix<6>& A) noexcept {
  for (Index i = 0; i < 3; ++i) {
    A[row][column + i] = block.x[i];
    A[row + 1][column + i] = block.y[i];
    A[row + 2][column + i] = block.z[i];
  }
}

// J J^T over free thetas, lower triangle.
using TaskSum = SquareMatrix<6>;

void take_sum(const Jacobian& J, Index n, std::uint32_t fixed, TaskSum& sum) noexcept {
  put_block(outer_sum(J.linear, J.linear, n, fixed), 0, 0, sum);
  put_block(outer_sum(J.angular, J.linear, n, fixed), 3, 0, sum);
  put_block(outer_sum(J.angular, J.angular, n, fixed), 3, 3, sum);
}

// Leaves out thetas that were among the free ones.
void leave_out(const Jacobian& J, Index n, std::uint32_t thetas, TaskSum& sum) noexcept {
  for (Index k = 0; k < n; ++k) {
    if (!is_set(thetas, k)) continue;
    const Vec3 &l = J.linear[k], &a = J.angular[k];
    const Task column{l[0], l[1], l[2], a[0], a[1], a[2]};
    for (Index r = 0; r < 6; ++r) {
      for (Index c = 0; c <= r; ++c) sum[r][c] -= column[r] * column[c];
    }
  }
}

void factor_task(const TaskSum& sum, std::uint32_t fixed, double damping, TaskSolver& solver) noexcept {
  solver.fixed = fixed;
  solver.damping = damping;
  solver.factor = sum;
  for (Index r = 0; r < 6; ++r) solver.factor[r][r] += damping;
  solver.regular = cholesky_factor(solver.factor);
}

// A step of the free thetas, and the part of the error that it will leave because of damping: e - J step = damping y.
struct Step {
  ThetaVector theta_rad{};
  double left2 = 0.0;  // squared length
};

Step solve_step(const TaskSolver& solver, const Jacobian& J, Index n, const Task& e) noexcept {
  Step step;
  step.left2 = size2(e);
  if (!solver.regular) return step;
  Task y = e;
  cholesky_solve(solver.factor, y);
  for (Index k = 0; k < n; ++k) {
    if (is_set(solver.fixed, k)) continue;
    const Vec3 &l = J.linear[k], &a = J.angular[k];
    step.theta_rad[k] = l[0] * y[0] + l[1] * y[1] + l[2] * y[2] + a[0] * y[3] + a[1] * y[4] + a[2] * y[5];
  }
  step.left2 = solver.damping * solver.damping * size2(y);
  return step;
}

// Takes from e what a theta does that has `moved` already.
void take_share(const Jacobian& J, Index k, double moved, Task& e) noexcept {
  for (Index r = 0; r < 3; ++r) {
    e[r] -= J.linear[k][r] * moved;
    e[r + 3] -= J.angular[k][r] * moved;
  }
}

// Sets thetas that the step would carry over their limit onto it; returns those newly fixed and takes their share from
// e.
std::uint32_t clip_to_limits(const RobotParams& table, const Jacobian& J, std::uint32_t fixed, const ThetaVector& step,
                             const FollowBounds* within, ThetaVector& theta, Task& e) noexcept {
  std::uint32_t clipped = 0;
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) {
    const double limit = limit_of(table, k), wanted = theta[k] + step[k];
    const double most = within != nullptr ? within->max_rad[k] : limit;
    const double least = within != nullptr ? within->min_rad[k] : -limit;
    if ((wanted <= most && wanted >= least) || is_set(fixed, k)) continue;
    const double bound = wanted > most ? most : least;
    const double moved = bound - theta[k];
    clipped |= 1u << k;
    theta[k] = bound;  // theta + moved may be a rounding beyond it
    take_share(J, k, moved, e);
  }
  return clipped;
}

void add_free(const TaskSolver& solver, Index n, const ThetaVector& step, ThetaVector& theta) noexcept {
  for (Index k = 0; k < n; ++k) {
    if (!is_set(solver.fixed, k)) theta[k] += step[k];
  }
}

// One damped step with limits; `left2` is the squared error it is expected to leave.
struct DampedMove {
  TaskSolver solver;
  std::uint32_t limit_mask = 0;
  double left2 = 0.0;
};

DampedMove move_damped(const RobotParams& table, const Jacobian& J, std::uint32_t held_mask, double damping, Task e,
                       const FollowBounds* within, ThetaVector& theta) noexcept {
  const Index n = static_cast<Index>(table.theta_count());
  DampedMove move;
  TaskSum sum{};
  take_sum(J, n, held_mask, sum);
  for (std::int32_t pass = 0; pass < kLimitPasses; ++pass) {
    factor_task(sum, held_mask | move.limit_mask, damping, move.solver);
    const Step step = solve_step(move.solver, J, n, e);
    move.left2 = step.left2;
    const std::uint32_t clipped = clip_to_limits(table, J, move.solver.fixed, step.theta_rad, within, theta, e);
    if (clipped == 0) {
      add_free(move.solver, n, step.theta_rad, theta);
      break;
    }
    leave_out(J, n, clipped, sum);
    move.limit_mask |= clipped;  // too many at once: the rest waits for the next tick
  }
  return move;
}

IkResult report_of(const Task& e) noexcept {
  IkResult report;
  report.residual = e;
  report.position_error_m = std::sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]);
  report.attitude_error_rad = std::sqrt(e[3] * e[3] + e[4] * e[4] + e[5] * e[5]);
  return report;
}

double arm_length_m(const RobotParams& table) noexcept {
  double length_m = table.segment[0].slide_m_rad * table.segment[0].theta_limit_rad;
  for (Index m = 0; m < static_cast<Index>(table.segment_count); ++m)
    length_m += table.segment[m].modules * table.segment[m].module_length_m;
  return length_m;
}

double damping_for(const IkGoal& goal, const Task& e) noexcept {
  const double e2 = size2(e);
  return goal.curvature_m > 0.0 ? kDamping + goal.curvature_m * std::sqrt(e2) : kDamping + e2;
}

IkOutcome outcome_of(const RobotParams& table, const IkGoal& goal, const IkResult& report, double converged,
                     double asked2, double left2) noexcept {
  if (report.position_error_m <= converged && report.attitude_error_rad <= converged) return IkOutcome::kConverged;
  if (norm(goal.tip_in_base.position_m) > arm_length_m(table)) return IkOutcome::kUnreachable;
  if (left2 <= kIkBlockedShare * kIkBlockedShare * asked2) return IkOutcome::kApproaching;
  return report.limit_mask != 0 ? IkOutcome::kLimited : IkOutcome::kSingular;
}

}  // namespace

IkResult ik_step(const RobotParams& table, const IkGoal& goal, double damping, ThetaVector& theta_rad) noexcept {
  const ArmKinematics arm = forward_kinematics(table, theta_rad);
  const Task e = pose_error(goal.tip_in_base, arm.tip_in_base);
  IkResult report = report_of(e);
  const DampedMove move = move_damped(table, arm.tip_jacobian, goal.held_mask, damping, e, nullptr, theta_rad);
  report.limit_mask = move.limit_mask;
  report.outcome = outcome_of(table, goal, report, kIkConverged, size2(e), move.left2);
  return report;
}

IkResult servo_ik(const RobotParams& table, const IkGoal& goal, const ArmKinematics& arm,
                  ThetaVector& theta_rad) noexcept {
  const Index n = static_cast<Index>(table.theta_count());
  const Task asked = pose_error(goal.tip_in_base, arm.tip_in_base);
  const DampedMove move =
      move_damped(table, arm.tip_jacobian, goal.held_mask, damping_for(goal, asked), asked, nullptr, theta_rad);
  ArmTrig trig;  // only what the table uses is written, and read
  update_trig(table, theta_rad, trig);
  const Task rest = pose_error(goal.tip_in_base, tip_pose(table, trig));
  IkResult report = report_of(rest);
  const Step correction = solve_step(move.solver, arm.tip_jacobian, n, rest);
  report.limit_mask = move.limit_mask;
  for (Index k = 0; k < n; ++k) {
    if (is_set(move.solver.fixed, k)) continue;
    const double limit = limit_of(table, k), wanted = theta_rad[k] + correction.theta_rad[k];
    theta_rad[k] = clamp(wanted, -limit, limit);
    if (theta_rad[k] != wanted) report.limit_mask |= 1u << k;
  }
  report.outcome = outcome_of(table, goal, report, kIkConverged, size2(asked), move.left2);
  return report;
}

FollowStep follow_ik(const RobotParams& table, const IkGoal& goal, const ArmKinematics& arm, const FollowBounds& bounds,
                     ThetaVector& theta_rad) noexcept {
  Task asked = pose_error(goal.tip_in_base, arm.tip_in_base);
  for (Index r = 0; r < asked.size(); ++r) asked[r] -= goal.later[r];
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k)
    take_share(arm.tip_jacobian, k, theta_rad[k] - bounds.arm_rad[k], asked);
  const DampedMove move =
      move_damped(table, arm.tip_jacobian, goal.held_mask, damping_for(goal, asked), asked, &bounds, theta_rad);
  return {size2(asked), move.left2, move.limit_mask};
}

IkResult follow_report(const RobotParams& table, const IkGoal& goal, const ArmKinematics& arm,
                       const FollowStep& step) noexcept {
  IkResult report = report_of(pose_error(goal.tip_in_base, arm.tip_in_base));
  report.limit_mask = step.limit_mask;
  report.outcome = outcome_of(table, goal, report, kIkFollowed, step.asked2, step.left2);
  return report;
}

}  // namespace liana::cable
