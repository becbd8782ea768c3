#include "host/control/virtual_fixtures/moving_plane.hpp"

#include <algorithm>
#include <cmath>

namespace liana::haptics {
namespace {

constexpr double kMaxStiffness_N_m = 3000.0;
constexpr double kMaxDamping_N_s_m = 30.0;

double between(double from, double to, double share) { return from + share * (to - from); }

Plane between(const Plane& from, const Plane& to, double share) {
  const Vec3 normal = add(from.normal, scale(subtract(to.normal, from.normal), share));
  const double length = norm(normal);
  return {length > 0.0 ? scale(normal, 1.0 / length) : to.normal, between(from.offset_m, to.offset_m, share),
          between(from.stiffness_N_m, to.stiffness_N_m, share), between(from.damping_N_s_m, to.damping_N_s_m, share)};
}

}  // namespace

// Comparisons are false for NaN.
bool is_valid(const Plane& plane) noexcept {
  return std::fabs(norm(plane.normal) - 1.0) <= 1e-6 && std::isfinite(plane.offset_m) && plane.stiffness_N_m >= 0.0 &&
         plane.stiffness_N_m <= kMaxStiffness_N_m && plane.damping_N_s_m >= 0.0 &&
         plane.damping_N_s_m <= kMaxDamping_N_s_m;
}

Vec3 plane_force(const Plane& plane, double plane_m_s, const Motion& hand) noexcept {
  const double depth_m = plane.offset_m - dot(plane.normal, hand.position_m);
  if (depth_m <= 0.0) return {};
  const double inwards_m_s = plane_m_s - dot(plane.normal, hand.velocity_m_s);
  return scale(plane.normal, std::max(0.0, plane.stiffness_N_m * depth_m + plane.damping_N_s_m * inwards_m_s));
}

bool MovingPlane::take(const Plane& plane) noexcept {
  if (!is_valid(plane)) return false;
  from_ = now_;
  if (now_.stiffness_N_m == 0.0) from_ = {plane.normal, plane.offset_m, 0.0, 0.0};
  to_ = plane;
  done_ = 0;
  return true;
}

void MovingPlane::advance() noexcept {
  if (done_ == kInterval) {
    speed_m_s_ = 0.0;
    return;
  }
  ++done_;
  const double before_m = done_ == 1 ? from_.offset_m : now_.offset_m;
  now_ = between(from_, to_, static_cast<double>(done_) / kInterval);
  speed_m_s_ = (now_.offset_m - before_m) / kTick_s;
}

}  // namespace liana::haptics
