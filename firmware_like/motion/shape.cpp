#include "firmware_like/motion/shape.hpp"

#include <cmath>

#include "firmware_like/math/pair.hpp"
#include "firmware_like/math/scalar.hpp"

namespace liana {
namespace {

using Index = std::size_t;

bool is_set(std::uint32_t mask, Index i) noexcept { return ((mask >> i) & 1u) != 0; }

double product(const ThetaVector& a, const ThetaVector& b, Index n) noexcept { return dot_pairs(a.data(), b.data(), n / 2); }

// v less its parts along the first `rank` rows, twice (once leaves rounding of the order of the cancelled part).
void remove_rows(const NullSpace& space, ThetaVector& v) noexcept {
  const Index pairs = static_cast<Index>(space.theta_count) / 2;
  for (std::int32_t pass = 0; pass < 2; ++pass) {
    for (Index r = 0; r < static_cast<Index>(space.rank); ++r) {
      const double* const row = space.row[r].data();
      add_scaled_pairs(-dot_pairs(v.data(), row, pairs), row, v.data(), pairs);
    }
  }
}

double limit_of(const RobotTable& table, Index theta) noexcept { return table.segment[theta / 2].theta_limit_rad; }

// Pitch of the segment before the planar part at the arm's end; theta_count when there is no planar part.
Index lead_pitch(const RobotTable& table, std::uint32_t held_mask) noexcept {
  std::int32_t m = table.segment_count - 1;
  while (m >= 0 && is_set(held_mask, static_cast<Index>(2 * m))) --m;
  const bool planar = m < table.segment_count - 1 && m >= 0;
  return static_cast<Index>(planar ? 2 * m : table.theta_count());
}

ThetaVector centring(const RobotTable& table, std::uint32_t held_mask, const ThetaVector& theta) noexcept {
  const Index lead = lead_pitch(table, held_mask);
  ThetaVector pull{};
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k)
    pull[k] = -(k == lead ? kLeadWeight : 1.0) * kCentringRate_1_s * theta[k];
  return pull;
}

// Scales v so that no entry is larger than `largest`: one factor for all keeps it in the null space.
void scale_to(double largest, Index n, ThetaVector& v) noexcept {
  double factor = 1.0;
  for (Index k = 0; k < n; ++k) {
    const double size = std::fabs(v[k]);
    if (size > largest) factor = smaller(factor, largest / size);
  }
  for (Index k = 0; k < n; ++k) v[k] *= factor;
}

// Null-space velocity [rad/s] with the thetas in `space.fixed` still.
ThetaVector shape_velocity(const RobotTable& table, const ArmKinematics& arm, const NullSpace& space, std::uint32_t held_mask,
                           const NodeTargets& nodes, const ThetaVector& theta) noexcept {
  const Index n = static_cast<Index>(table.theta_count());
  ThetaVector velocity = project(space, centring(table, held_mask, theta));
  const NodeCost cost = node_cost(table, arm, nodes);
  if (!(cost.sum_m > 0.0)) return velocity;
  const ThetaVector descent = project(space, cost.descent);
  const double slope2 = product(descent, descent, n);
  const double rate = kNodeRate_1_s * cost.sum_m / (slope2 + kNodeFade_m_rad * kNodeFade_m_rad);
  for (Index k = 0; k < n; ++k) velocity[k] += rate * descent[k];
  return velocity;
}

}  // namespace

NullSpace null_space(const Jacobian& J, std::int32_t theta_count, std::uint32_t fixed) noexcept {
  constexpr double kDependent_m_rad = 1e-10;  // below this a row adds nothing that the tip could feel
  NullSpace space;
  space.fixed = fixed;
  space.theta_count = theta_count;
  const Index n = static_cast<Index>(theta_count);
  for (Index r = 0; r < 6; ++r) {
    ThetaVector& v = space.row[static_cast<Index>(space.rank)];
    const auto& column = r < 3 ? J.linear : J.angular;
    for (Index k = 0; k < n; ++k) v[k] = is_set(fixed, k) ? 0.0 : column[k][r % 3];
    remove_rows(space, v);
    const double length = std::sqrt(product(v, v, n));
    if (!(length > kDependent_m_rad)) continue;
    for (Index k = 0; k < n; ++k) v[k] /= length;
    ++space.rank;
  }
  return space;
}

ThetaVector project(const NullSpace& space, const ThetaVector& v) noexcept {
  ThetaVector out{};
  for (Index k = 0; k < static_cast<Index>(space.theta_count); ++k) out[k] = is_set(space.fixed, k) ? 0.0 : v[k];
  remove_rows(space, out);
  return out;
}

NodeCost node_cost(const RobotTable& table, const ArmKinematics& arm, const NodeTargets& nodes) noexcept {
  NodeCost cost;
  for (const NodeTarget& target : nodes) {
    if (target.node < 1 || target.node > table.segment_count) continue;
    const Vec3 towards = subtract(target.position_m, arm.node_in_base[static_cast<Index>(target.node)].position_m);
    const double distance = norm(towards);
    if (!(distance > target.threshold_m) || distance < 1e-9) continue;
    cost.sum_m += target.weight * distance;
    const Vec3 pull = scale(towards, target.weight / distance);
    for (std::int32_t k = 0; k < 2 * target.node; ++k) {
      cost.descent[static_cast<Index>(k)] += dot(pull, node_jacobian_column(arm, target.node, k));
    }
  }
  return cost;
}

ThetaVector shape_move(const RobotTable& table, const ArmKinematics& arm, const NodeTargets& nodes, std::uint32_t held_mask, bool braking,
                       const ThetaVector& theta_rad, ThetaVector& rate_rad_s) noexcept {
  const Index n = static_cast<Index>(table.theta_count());
  std::uint32_t fixed = held_mask;
  NullSpace space;
  ThetaVector wanted{};
  // Thetas that stand on their limit and are pushed outwards take no part; the second pass is for them.
  for (std::int32_t pass = 0; pass < 2; ++pass) {
    space = null_space(arm.tip_jacobian, table.theta_count(), fixed);
    if (!braking) wanted = shape_velocity(table, arm, space, held_mask, nodes, theta_rad);
    for (Index k = 0; k < n; ++k) {
      const double room = limit_of(table, k) - (wanted[k] > 0.0 ? theta_rad[k] : -theta_rad[k]);
      if (wanted[k] != 0.0 && room < 1e-9) fixed |= 1u << k;
    }
    if (fixed == held_mask) break;
  }
  scale_to(kShapeShare * table.limits.theta_rate_rad_s, n, wanted);
  ThetaVector change{};
  // Braking has to end: straight down to zero, without the smoothing's tail.
  const double share = braking ? 1.0 : smaller(1.0, table.tick_s / kShapeSmoothing_s);
  for (Index k = 0; k < n; ++k) change[k] = (wanted[k] - rate_rad_s[k]) * share;
  scale_to(kShapeAccelShare * table.limits.theta_accel_rad_s2 * table.tick_s, n, change);
  for (Index k = 0; k < n; ++k) rate_rad_s[k] += change[k];
  rate_rad_s = project(space, rate_rad_s);

  double factor = table.tick_s;
  for (Index k = 0; k < n; ++k) {
    const double room = limit_of(table, k) - (rate_rad_s[k] > 0.0 ? theta_rad[k] : -theta_rad[k]);
    const double size = std::fabs(rate_rad_s[k]);
    if (size * factor > room) factor = room > 0.0 ? room / size : 0.0;
  }
  ThetaVector move{};
  for (Index k = 0; k < n; ++k) move[k] = rate_rad_s[k] * factor;
  return move;
}

}  // namespace liana
