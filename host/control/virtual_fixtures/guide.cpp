#include "host/control/virtual_fixtures/guide.hpp"

#include <algorithm>

namespace liana::virtual_fixtures {
namespace {

constexpr double kRise_s = 1.0;  // from standing to the most
constexpr double kEnd_s = 1.0;   // the end of the way: what is left, in this time

// `bump` shorter by what bleeds in an interval; `speed` is how fast it did in the one before.
Vec3 bled(const Vec3& bump, const Bleed& bleed, double dt_s, double& speed) {
  const double length = norm(bump);
  speed = std::min({speed + bleed.most / kRise_s * dt_s, bleed.most, std::max(length / kEnd_s, bleed.least)});
  return length > speed * dt_s ? scale(bump, 1.0 - speed * dt_s / length) : Vec3{};
}

}  // namespace

Pose Guide::bumped(const Pose& goal) const {
  return {add(goal.position_m, bump_m_), normalize(multiply(quaternion_of(bump_rad_), goal.quaternion))};
}

Pose Guide::next(const Pose& goal, const std::optional<GuidePlane>& plane, double dt_s) {
  const bool switches = plane.has_value() != plane_.has_value();
  const Pose before = bumped(wanted(goal));
  plane_ = plane;
  const Pose now = wanted(goal);
  if (switches) {
    bump_m_ = subtract(before.position_m, now.position_m);
    bump_rad_ = rotation_vector(multiply(before.quaternion, conjugate(now.quaternion)));
    bleeds_m_s_ = bleeds_rad_s_ = 0.0;
  }
  bump_m_ = bled(bump_m_, kBleed_m, dt_s, bleeds_m_s_);
  bump_rad_ = bled(bump_rad_, kBleed_rad, dt_s, bleeds_rad_s_);
  return bumped(now);
}

void Guide::stop() {
  plane_.reset();
  bump_m_ = bump_rad_ = {};
}

}  // namespace liana::virtual_fixtures
