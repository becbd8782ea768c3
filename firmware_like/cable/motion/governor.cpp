#include "firmware_like/cable/motion/governor.hpp"

#include <cmath>

#include "firmware_like/math/cholesky.hpp"
#include "firmware_like/math/pair.hpp"
#include "firmware_like/math/scalar.hpp"

namespace liana::cable {
namespace {

using Index = std::size_t;
using Task = std::array<double, 6>;

constexpr double kDamped = 1e-3;  // m2/rad2: directions that are all but lost take no wild accelerations
// sqrt(kDamped / 10): a direction that is lost altogether takes as much of ten thetas as one that is all but lost.
constexpr double kLostTakes = 0.01;

Index theta_total(const RobotParams& table) noexcept { return static_cast<Index>(table.theta_count()); }

void update_pulls(const RobotParams& table, const TensionSolver& solver, Index first, Index last,
                  GovernorState& state) noexcept {
  const Index cables = static_cast<Index>(table.cable_count());
  for (Index k = first; k < last; ++k) {
    const CableVector pull_N = pulls_for(table, solver, state.mass_kg_m2[k]);
    for (Index c = 0; c < cables; ++c) state.pull_N_s2[c][k] = pull_N[c];
  }
}

// What the tip is moved by when one theta turns.
Task column_of(const Jacobian& J, Index k) noexcept {
  return {J.linear[k][0], J.linear[k][1], J.linear[k][2], J.angular[k][0], J.angular[k][1], J.angular[k][2]};
}

// J J^T + damping of the free thetas, factored.
bool factor_of(const RobotParams& table, const Jacobian& J, std::uint32_t held_mask, SquareMatrix<6>& A) noexcept {
  A = {};
  for (Index k = 0; k < theta_total(table); ++k) {
    if ((held_mask >> k & 1u) != 0) continue;
    const Task column = column_of(J, k);
    for (Index r = 0; r < 6; ++r) {
      for (Index s = 0; s <= r; ++s) A[r][s] += column[r] * column[s];
    }
  }
  for (Index r = 0; r < 6; ++r) A[r][r] += kDamped;
  return cholesky_factor(A);
}

// What every free theta turns by, per unit of the tip's way and turn, when those that move it least make it; 0 for held
// ones.
using ThetaTasks = std::array<Task, kMaxTheta>;
bool thetas_per_tip(const RobotParams& table, const Jacobian& J, std::uint32_t held_mask, SquareMatrix<6>& factor,
                    ThetaTasks& out) noexcept {
  if (!factor_of(table, J, held_mask, factor)) return false;
  for (Index k = 0; k < theta_total(table); ++k) {
    out[k] = {};
    if ((held_mask >> k & 1u) != 0) continue;
    out[k] = column_of(J, k);
    cholesky_solve(factor, out[k]);
  }
  return true;
}

// The same of what all thetas together do to one cable, by `per_theta` each.
Task cable_per_tip(const RobotParams& table, const ThetaTasks& theta, const ThetaVector& per_theta) noexcept {
  Task out{};
  for (Index k = 0; k < theta_total(table); ++k) {
    for (Index r = 0; r < 6; ++r) out[r] += theta[k][r] * per_theta[k];
  }
  return out;
}

using LimitRows = std::array<Vec3, kMaxTheta + kMaxCables + 6>;

// What a unit of the tip's way, and of its turn, takes of every joint's or cable's limit, whichever way it goes.
struct Taken {
  LimitRows way, turn;  // the first `count` of each
  Index count = 0;

  void take(const Task& per_tip, double limit) noexcept {
    const double a = 1.0 / limit;
    way[count] = {a * per_tip[0], a * per_tip[1], a * per_tip[2]};
    turn[count] = {a * per_tip[3], a * per_tip[4], a * per_tip[5]};
    ++count;
  }
};

// The share of a motion that takes no more than kGovernorTip of a limit.
double share_within(double taken) noexcept { return taken > kGovernorTip ? kGovernorTip / taken : 1.0; }

// The share of so much way or turn, the slow directions less of it, that takes no more than kGovernorTip of any limit.
double share_of(const LimitRows& rows, Index count, const SlowDirections& slow, double most) noexcept {
  const bool even = is_even(slow);
  double taken2 = 0.0;
  for (Index i = 0; i < count; ++i) {
    const Vec3 row = even ? rows[i] : slowed(slow, rows[i]);
    taken2 = larger(taken2, dot(row, row));
  }
  return share_within(std::sqrt(taken2) * most);
}

// An arm that has lost a direction stands straight or folded: it sways more about each change of acceleration.
double accel_share_of(const LimitRows& rows, Index count, const SlowDirections& slow, double most) noexcept {
  const double share = share_of(rows, count, slow, most);
  return is_even(slow) ? share : smaller(share, kGovernorNearLost);
}

// Which directions are lost, and what is left of them.
SlowDirections lost_directions(const LimitRows& rows, Index count, double most) noexcept {
  SlowDirections out;
  if (share_of(rows, count, out, most) >= kGovernorLost) return out;
  Symmetric3 sum{};
  for (Index i = 0; i < count; ++i) {
    Index element = 0;
    for (Index r = 0; r < 3; ++r) {
      for (Index s = 0; s <= r; ++s) sum[element++] += rows[i][r] * rows[i][s];
    }
  }
  out.axis = eigenvectors(sum);
  Vec3 share{};
  double best = 0.0;
  for (Index a = 0; a < 3; ++a) {
    double taken = 0.0;
    for (Index i = 0; i < count; ++i) taken = larger(taken, std::fabs(dot(rows[i], out.axis[a])));
    share[a] = share_within(taken * most);
    best = larger(best, share[a]);
  }
  for (Index a = 0; a < 3; ++a) {
    const double left = share[a] / (kGovernorLost * best);
    if (left < 1.0) out.share[a] = left * left * left * std::sqrt(left);
  }
  return out;
}

// Accelerations grow with the square of the speed: of what turns as it moves, and, far more, where the arm all but
// loses a direction, whose thetas speed up while the tip does not.
double speed_of(double accel_share, double by_rates) noexcept {
  const double by_turning = accel_share < kGovernorSpeed ? std::sqrt(accel_share / kGovernorSpeed) : 1.0;
  const double by_loss = kGovernorLoss * by_rates * by_rates * std::sqrt(by_rates);
  return smaller(by_rates, smaller(by_turning, by_loss));
}

// Of `theta_limit` for every free theta, and of each cable's limit for its row of `per_theta`; false, and nothing is
// known anew, where the Jacobian has no factors.
template <class Limit>
bool look_at(const RobotParams& table, const Jacobian& J, std::uint32_t held_mask, double theta_limit,
             const std::array<ThetaVector, kMaxCables>& per_theta, const Limit& limit_of, Taken& out) noexcept {
  ThetaTasks theta;
  SquareMatrix<6> factor;
  if (!thetas_per_tip(table, J, held_mask, factor, theta)) return false;
  // No theta turns for a direction that is lost altogether: the damping stands for them.
  for (Index r = 0; r < 6; ++r) {
    Task damped{};
    damped[r] = kLostTakes;
    cholesky_solve(factor, damped);
    out.take(damped, theta_limit);
  }
  for (Index k = 0; k < theta_total(table); ++k) out.take(theta[k], theta_limit);
  Index c = 0;
  for (Index j = 0; j < theta_total(table) / 2; ++j) {
    for (std::int32_t i = 0; i < table.segment[j].cables; ++i, ++c)
      out.take(cable_per_tip(table, theta, per_theta[c]), limit_of(j));
  }
  return true;
}

void update_accel_shares(const RobotParams& table, const Jacobian& J, std::uint32_t held_mask,
                         GovernorState& state) noexcept {
  const MotionLimits& limits = table.limits;
  Taken taken;
  const auto room_of = [&state](Index segment) noexcept { return state.room_N[segment]; };
  if (!look_at(table, J, held_mask, limits.theta_accel_rad_s2, state.pull_N_s2, room_of, taken)) return;
  state.linear_share = accel_share_of(taken.way, taken.count, state.slow_ways, limits.tip_accel_m_s2);
  state.angular_share = accel_share_of(taken.turn, taken.count, state.slow_turns, limits.tip_angular_accel_rad_s2);
}

// What the joints' rates and the cables' speeds are taken by.
bool look_at_rates(const RobotParams& table, const CableGeometry& geometry, const Jacobian& J, std::uint32_t held_mask,
                   Taken& out) noexcept {
  const MotionLimits& limits = table.limits;
  const auto speed_of_cable = [&limits](Index) noexcept { return limits.cable_speed_m_s; };
  return look_at(table, J, held_mask, limits.theta_rate_rad_s, geometry.jacobian_m_rad, speed_of_cable, out);
}

void update_speed_shares(const RobotParams& table, const CableGeometry& geometry, const Jacobian& J,
                         std::uint32_t held_mask, GovernorState& state) noexcept {
  Taken taken;
  if (!look_at_rates(table, geometry, J, held_mask, taken)) return;
  const double way = share_of(taken.way, taken.count, state.slow_ways, table.limits.tip_speed_m_s);
  const double turn = share_of(taken.turn, taken.count, state.slow_turns, table.limits.tip_rate_rad_s);
  state.speed_share = speed_of(state.linear_share, way);
  state.turn_share = speed_of(state.angular_share, turn);
}

// What each theta may brake with by itself, with a part of the room.
void update_accels(const RobotParams& table, GovernorState& state) noexcept {
  for (Index k = 0; k < theta_total(table); ++k) {
    double taken = kGovernorTip / (kGovernorAlone * table.limits.theta_accel_rad_s2);
    Index c = 0;
    for (Index j = 0; j < theta_total(table) / 2; ++j) {
      for (std::int32_t i = 0; i < table.segment[j].cables; ++i, ++c)
        taken = larger(taken, std::fabs(state.pull_N_s2[c][k]) / state.room_N[j]);
    }
    state.accel_rad_s2[k] = kGovernorTip / taken;
  }
}

// Over the thetas, two at a time; there are two for each segment.
double dot_thetas(const RobotParams& table, const ThetaVector& a, const ThetaVector& b) noexcept {
  return dot_pairs(a.data(), b.data(), static_cast<Index>(table.segment_count));
}

}  // namespace

void take_room(const RobotParams& table, const TensionPlan& plan, GovernorState& state) noexcept {
  const TensionLimits& limits = table.tension;
  const double between_N =
      kLoadCeilingShare * limits.ceiling_free_N - limits.floor_motor_N - kGovernorKeep_N * limits.scale();
  for (Index j = 0; j < theta_total(table) / 2; ++j)
    state.room_N[j] = larger(kGovernorLeast_N * limits.scale(), 0.5 * (between_N - plan.spread_N[j]));
  if (table.feed_count() != 0) state.room_N[0] = kGovernorFeed_N;
}

void look_at_load(const RobotParams& table, const CableGeometry& geometry, const TensionRatio& ratio,
                  const ArmKinematics& arm, std::uint32_t held_mask, std::uint32_t tick,
                  GovernorState& state) noexcept {
  const std::uint32_t cycle = state.cycle;
  if (tick == 9) state.cycle = cycle + 1 < kGovernorCycles ? cycle + 1 : 0;
  const Index half = theta_total(table) / 2;
  if (cycle == 0 && tick == 5) update_mass_matrix(table, arm, state.mass_kg_m2);
  if (cycle == 0 && (tick == 6 || tick == 8)) {
    const TensionSolver solver = tension_solver(table, geometry, ratio);
    if (tick == 6) update_pulls(table, solver, 0, half, state);
    if (tick == 8) update_pulls(table, solver, half, theta_total(table), state);
  }
  if (cycle == 0 && tick == 9) update_accel_shares(table, arm.tip_jacobian, held_mask, state);
  if (cycle == 1 && tick == 8) update_accels(table, state);
  if (cycle == 1 && tick == 9) update_speed_shares(table, geometry, arm.tip_jacobian, held_mask, state);
  const auto update_slow = [&](LimitRows Taken::*rows, double most, SlowDirections& slow) noexcept {
    Taken taken;
    if (look_at_rates(table, geometry, arm.tip_jacobian, held_mask, taken))
      slow = lost_directions(taken.*rows, taken.count, most);
  };
  if (cycle == 2 && tick == 6) update_slow(&Taken::turn, table.limits.tip_rate_rad_s, state.slow_turns);
  if (cycle == 2 && tick == 9) update_slow(&Taken::way, table.limits.tip_speed_m_s, state.slow_ways);
}

double room_taken(const RobotParams& table, const ThetaVector& accel_rad_s2, const GovernorState& state) noexcept {
  double most = 0.0;
  Index c = 0;
  for (Index j = 0; j < theta_total(table) / 2; ++j) {
    for (std::int32_t i = 0; i < table.segment[j].cables; ++i, ++c)
      most = larger(most, std::fabs(dot_thetas(table, state.pull_N_s2[c], accel_rad_s2)) / state.room_N[j]);
  }
  return most;
}

LoadShares shares_in_room(const RobotParams& table, const ThetaVector& asked_rad_s, const ThetaVector& now_rad_s,
                          const GovernorState& state) noexcept {
  LoadShares out;
  Index c = 0;
  for (Index j = 0; j < theta_total(table) / 2; ++j) {
    const double room_N_s = state.room_N[j] * table.tick_s;
    for (std::int32_t i = 0; i < table.segment[j].cables; ++i, ++c) {
      const double asked = dot_thetas(table, state.pull_N_s2[c], asked_rad_s);
      const double going = dot_thetas(table, state.pull_N_s2[c], now_rad_s);
      if (std::fabs(asked - going) <= room_N_s) continue;
      const double now = asked < 0.0 ? -going : going, size = std::fabs(asked);
      if (size > now + room_N_s) out.most = smaller(out.most, larger(0.0, now + room_N_s) / size);
      if (now - room_N_s > 0.0) out.least = larger(out.least, smaller(1.0, (now - room_N_s) / larger(size, 1e-12)));
    }
  }
  return out;
}

}  // namespace liana::cable
