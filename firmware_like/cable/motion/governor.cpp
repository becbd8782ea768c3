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

Index theta_total(const RobotParams& table) noexcept { return static_cast<Index>(table.theta_count()); }

void update_pulls(const RobotParams& table, const TensionSolver& solver, Index first, Index last,
                  GovernorState& state) noexcept {
  for (Index k = first; k < last; ++k) {
    const CableVector pull_N = pulls_for(table, solver, state.mass_kg_m2[k]);
    for (Index c = 0; c < static_cast<Index>(table.cable_count()); ++c) state.pull_N_s2[c][k] = pull_N[c];
  }
}

// J J^T + damping of the free thetas, factored.
bool factor_of(const RobotParams& table, const Jacobian& J, std::uint32_t held_mask, SquareMatrix<6>& A) noexcept {
  A = {};
  for (Index k = 0; k < theta_total(table); ++k) {
    if ((held_mask >> k & 1u) != 0) continue;
    const Task column{J.linear[k][0],  J.linear[k][1],  J.linear[k][2],
                      J.angular[k][0], J.angular[k][1], J.angular[k][2]};
    for (Index r = 0; r < 6; ++r) {
      for (Index s = 0; s <= r; ++s) A[r][s] += column[r] * column[s];
    }
  }
  for (Index r = 0; r < 6; ++r) A[r][r] += kDamped;
  return cholesky_factor(A);
}

// Pull of one cable per acceleration of the tip, by the free thetas that move it least.
Task pull_per_tip(const RobotParams& table, const Jacobian& J, std::uint32_t held_mask, const SquareMatrix<6>& factor,
                  const ThetaVector& pull_N_s2) noexcept {
  Task pull{};
  for (Index k = 0; k < theta_total(table); ++k) {
    if ((held_mask >> k & 1u) != 0) continue;
    for (Index r = 0; r < 3; ++r) {
      pull[r] += J.linear[k][r] * pull_N_s2[k];
      pull[r + 3] += J.angular[k][r] * pull_N_s2[k];
    }
  }
  cholesky_solve(factor, pull);
  return pull;
}

void update_shares(const RobotParams& table, const Jacobian& J, std::uint32_t held_mask,
                   GovernorState& state) noexcept {
  SquareMatrix<6> factor;
  if (!factor_of(table, J, held_mask, factor)) return;
  double linear_s2_m = 0.0, angular_s2_rad = 0.0;  // shares of the room, squared, per unit of acceleration
  Index c = 0;
  for (Index j = 0; j < theta_total(table) / 2; ++j) {
    const double per_room = 1.0 / (state.room_N[j] * state.room_N[j]);
    for (std::int32_t i = 0; i < table.segment[j].cables; ++i, ++c) {
      const Task pull = pull_per_tip(table, J, held_mask, factor, state.pull_N_s2[c]);
      linear_s2_m = larger(linear_s2_m, per_room * (pull[0] * pull[0] + pull[1] * pull[1] + pull[2] * pull[2]));
      angular_s2_rad = larger(angular_s2_rad, per_room * (pull[3] * pull[3] + pull[4] * pull[4] + pull[5] * pull[5]));
    }
  }
  const MotionLimits& limits = table.limits;
  const double linear = std::sqrt(linear_s2_m) * limits.tip_accel_m_s2;
  const double angular = std::sqrt(angular_s2_rad) * limits.tip_angular_accel_rad_s2;
  state.linear_share = linear > kGovernorTip ? kGovernorTip / linear : 1.0;
  state.angular_share = angular > kGovernorTip ? kGovernorTip / angular : 1.0;
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
}

void look_at_load(const RobotParams& table, const CableGeometry& geometry, const TensionRatio& ratio,
                  const ArmKinematics& arm, std::uint32_t held_mask, std::uint32_t tick,
                  GovernorState& state) noexcept {
  const bool looks = state.cycle == 0;
  if (tick == 9) state.cycle = state.cycle + 1 < kGovernorCycles ? state.cycle + 1 : 0;
  if (!looks) return;
  const Index half = theta_total(table) / 2;
  if (tick == 5) update_mass_matrix(table, arm, state.mass_kg_m2);
  if (tick == 6 || tick == 8) {
    const TensionSolver solver = tension_solver(table, geometry, ratio);
    if (tick == 6) update_pulls(table, solver, 0, half, state);
    if (tick == 8) update_pulls(table, solver, half, theta_total(table), state);
  }
  if (tick == 9) {
    update_shares(table, arm.tip_jacobian, held_mask, state);
    update_accels(table, state);
  }
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
