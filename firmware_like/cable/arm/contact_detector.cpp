#include "firmware_like/cable/arm/contact_detector.hpp"

#include <cmath>

#include "firmware_like/math/scalar.hpp"

namespace liana::cable {
namespace {

using Index = std::size_t;
using Columns = std::array<Vec3, kMaxTheta>;  // torque about each angle of a force along x, y, z

Index thetas(const RobotParams& table) noexcept { return static_cast<Index>(table.theta_count()); }

// Deviation of a force along an axis: `times` that of the least squares, and `share` of the force itself. Fitted to the
// bench's truth and taken times 1.2 (docs/explanation/contact-force.md).
struct SureLaw {
  double times, share;
};
constexpr SureLaw kSure[] = {{0.75, 0.06}, {0.75, 0.03}, {1.2, 0.06}};  // stuck, moving, dithered

// Lower factor of the variances, its diagonal inverted. No pivot is less than the floor that is in each variance, but
// for rounding.
void factorise(Index n, const TorqueMatrix& variance_Nm2, TorqueMatrix& root) noexcept {
  constexpr double kLeast = 0.25 * kTorqueFloor_Nm * kTorqueFloor_Nm;
  for (Index k = 0; k < n; ++k) {
    double pivot = variance_Nm2[k][k];
    for (Index l = 0; l < k; ++l) {
      double rest = variance_Nm2[k][l];
      for (Index i = 0; i < l; ++i) rest -= root[k][i] * root[l][i];
      root[k][l] = rest * root[l][l];
      pivot -= root[k][l] * root[k][l];
    }
    root[k][k] = 1.0 / std::sqrt(larger(pivot, kLeast));
  }
}

// Forward substitution: torques in their own deviations.
void whiten(Index n, const TorqueMatrix& root, ThetaVector& torque) noexcept {
  for (Index k = 0; k < n; ++k) {
    for (Index l = 0; l < k; ++l) torque[k] -= root[k][l] * torque[l];
    torque[k] *= root[k][k];
  }
}

void whiten(Index n, const TorqueMatrix& root, Columns& columns) noexcept {
  for (Index k = 0; k < n; ++k) {
    for (Index l = 0; l < k; ++l) columns[k] = subtract(columns[k], scale(columns[l], root[k][l]));
    columns[k] = scale(columns[k], root[k][k]);
  }
}

// The force that explains the torques best; `spread_N2`: its variance along each axis.
struct Fit {
  Vec3 force_N{}, spread_N2{};
};

Fit fit(Index n, const Columns& columns, const ThetaVector& torque) noexcept {
  constexpr double kPrior = 1.0 / (kContactMost_N * kContactMost_N);
  Vec3 a{kPrior, 0.0, 0.0}, b{0.0, kPrior, 0.0}, c{0.0, 0.0, kPrior}, right{};
  for (Index k = 0; k < n; ++k) {
    const Vec3& row = columns[k];
    a = add(a, scale(row, row[0]));
    b = add(b, scale(row, row[1]));
    c = add(c, scale(row, row[2]));
    right = add(right, scale(row, torque[k]));
  }
  const Vec3 bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  const double inverse = 1.0 / dot(a, bc);  // at least the prior's
  const Vec3 force_N{dot(right, bc) * inverse, dot(right, ca) * inverse, dot(right, ab) * inverse};
  return {force_N, {bc[0] * inverse, ca[1] * inverse, ab[2] * inverse}};
}

double misfit(Index n, const Columns& columns, const ThetaVector& torque, const Vec3& force_N) noexcept {
  double sum = 0.0;
  for (Index k = 0; k < n; ++k) {
    const double left = torque[k] - dot(columns[k], force_N);
    sum += left * left;
  }
  return sum;
}

// A point at `share` of segment `j`, as the kinematics of its ends has it: what comes before turns it as a rigid body,
// the segment's own angles move it with the square of the share.
Columns columns_at(const ArmKinematics& arm, Index j, double share) noexcept {
  Columns out{};
  const auto node = static_cast<std::int32_t>(j + 1);
  const Pose& root = arm.node_in_base[j];
  const Vec3 chord_m = subtract(arm.node_in_base[j + 1].position_m, root.position_m);
  const Vec3 point_m = add(root.position_m, scale(chord_m, share));
  const Vec3 lever_m = subtract(point_m, arm.tip_in_base.position_m);
  for (Index k = 0; k < 2 * j; ++k)
    out[k] = add(arm.tip_jacobian.linear[k], cross(arm.tip_jacobian.angular[k], lever_m));
  for (Index k = 2 * j; k < 2 * j + 2; ++k)
    out[k] = scale(node_jacobian_column(arm, node, static_cast<std::int32_t>(k)), share * share);
  return out;
}

// A dither that has ended leaves friction known, until the arm moves or is touched otherwise.
void follow_state(const ContactConditions& now, ContactDetectorState& contact) noexcept {
  const double moved_N = norm(subtract(contact.force_N, contact.dithered_N));
  if (now.moving) {
    contact.state = ContactState::kMoving;
  } else if (contact.dithering && !now.dithering) {
    contact.state = ContactState::kDithered;
    contact.dithered_N = contact.force_N;
  } else if (contact.state == ContactState::kMoving || now.dithering || moved_N > kContactMoved_N) {
    contact.state = ContactState::kStuck;
  }
  contact.dithering = now.dithering;
}

void take_force(const Fit& found, ContactDetectorState& contact) noexcept {
  const SureLaw& law = kSure[static_cast<Index>(contact.state)];
  const double of_force = law.share * norm(found.force_N);
  contact.force_N = found.force_N;
  for (Index i = 0; i < 3; ++i)
    contact.sd_N[i] = std::sqrt(law.times * law.times * found.spread_N2[i] + of_force * of_force);
}

// Where the places of the last round say. It stays named while it is felt.
void name_segment(bool is_felt, ContactDetectorState& contact) noexcept {
  if (!is_felt) {
    contact.sweeps = 0;
    contact.segment = -1;
    return;
  }
  if (!is_in_contact(contact)) ++contact.sweeps;
  const std::int32_t best = contact.best_place / static_cast<std::int32_t>(kPlaces);
  contact.segment = is_in_contact(contact) && contact.best_place >= 0 && best >= kFirstNamed ? best : -1;
}

}  // namespace

void watch_contact(const RobotParams& table, const ArmKinematics& kinematics, const TorqueBalance& balance,
                   const ContactConditions& now, ContactDetectorState& contact) noexcept {
  const Index n = thetas(table);
  factorise(n, balance.variance_Nm2, contact.root_Nm);
  contact.torque = balance.torque_Nm;
  whiten(n, contact.root_Nm, contact.torque);
  Columns columns = kinematics.tip_jacobian.linear;
  whiten(n, contact.root_Nm, columns);
  const Fit tip = fit(n, columns, contact.torque);
  follow_state(now, contact);
  take_force(tip, contact);

  const double push_N = norm(tip.force_N);
  const Vec3 explained_N = push_N > kContactTip_N ? scale(tip.force_N, kContactTip_N / push_N) : tip.force_N;
  contact.torque_Nm = 0.0;
  const Index first = static_cast<Index>(table.feed_count());  // what feeds tells nothing
  for (Index k = first; k < n; ++k) {
    const double left_Nm = balance.torque_Nm[k] - dot(kinematics.tip_jacobian.linear[k], explained_N);
    contact.torque_Nm = larger(contact.torque_Nm, std::fabs(left_Nm));
  }
  name_segment(misfit(n, columns, contact.torque, explained_N) > kContactMisfit * static_cast<double>(n - first),
               contact);
  contact.best_place = -1;
}

void try_place(const RobotParams& table, const ArmKinematics& kinematics, std::uint32_t place,
               ContactDetectorState& contact) noexcept {
  const Index n = thetas(table), segment = place / kPlaces;
  Columns columns = columns_at(kinematics, segment, (1.0 + place % kPlaces) / kPlaces);
  whiten(n, contact.root_Nm, columns);
  const double left = misfit(n, columns, contact.torque, fit(n, columns, contact.torque).force_N);
  if (contact.best_place >= 0 && left >= contact.least_misfit) return;
  contact.least_misfit = left;
  contact.best_place = static_cast<std::int32_t>(place);
}

}  // namespace liana::cable
