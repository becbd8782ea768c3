#include "firmware_like/serial/mass_table.hpp"

namespace liana::serial {
namespace {

// Adds what a point of mass at `offset_m` has about the origin (Steiner).
void add_point(double mass_kg, const Vec3& offset_m, LinkMass& to) noexcept {
  const double x = offset_m[0], y = offset_m[1], z = offset_m[2];
  to.inertia_kgm2[kXx] += mass_kg * (y * y + z * z);
  to.inertia_kgm2[kYy] += mass_kg * (x * x + z * z);
  to.inertia_kgm2[kZz] += mass_kg * (x * x + y * y);
  to.inertia_kgm2[kXy] -= mass_kg * x * y;
  to.inertia_kgm2[kXz] -= mass_kg * x * z;
  to.inertia_kgm2[kYz] -= mass_kg * y * z;
}

// NaN is not within.
bool is_at_most(double value, double most) noexcept { return value >= -most && value <= most; }

// By its leading minors; of principal moments none exceeds the other two, so that no diagonal element does.
bool is_inertia(const std::array<double, kInertiaElements>& I) noexcept {
  const double minor = I[kXx] * I[kYy] - I[kXy] * I[kXy];
  const double det =
      I[kZz] * minor - I[kXx] * I[kYz] * I[kYz] - I[kYy] * I[kXz] * I[kXz] + 2.0 * I[kXy] * I[kXz] * I[kYz];
  return I[kXx] > 0.0 && minor > 0.0 && det > 0.0 && I[kXx] <= I[kYy] + I[kZz] && I[kYy] <= I[kXx] + I[kZz] &&
         I[kZz] <= I[kXx] + I[kYy];
}

}  // namespace

bool is_body(const LinkMass& body) noexcept {
  if (!(body.mass_kg >= 0.0 && body.mass_kg <= kMaxMass_kg)) return false;
  for (const double center : body.center_m) {
    if (!is_at_most(center, kMaxCenter_m)) return false;
  }
  for (const double inertia : body.inertia_kgm2) {
    if (!is_at_most(inertia, kMaxInertia_kgm2)) return false;
  }
  return body.mass_kg == 0.0 || is_inertia(body.inertia_kgm2);
}

LinkMass joined(const LinkMass& a, const LinkMass& b) noexcept {
  LinkMass both;
  both.mass_kg = a.mass_kg + b.mass_kg;
  if (!(both.mass_kg > 0.0)) return both;
  const Vec3 moment = add(scale(a.center_m, a.mass_kg), scale(b.center_m, b.mass_kg));
  both.center_m = scale(moment, 1.0 / both.mass_kg);
  for (std::size_t i = 0; i < kInertiaElements; ++i) both.inertia_kgm2[i] = a.inertia_kgm2[i] + b.inertia_kgm2[i];
  add_point(a.mass_kg, subtract(a.center_m, both.center_m), both);
  add_point(b.mass_kg, subtract(b.center_m, both.center_m), both);
  return both;
}

// R I R^T, column by column: R I R^T e is what the turned body has about e.
LinkMass moved(const LinkMass& body, const Pose& frame_in_outer) noexcept {
  LinkMass out;
  out.mass_kg = body.mass_kg;
  out.center_m = add(frame_in_outer.position_m, rotate(frame_in_outer.quaternion, body.center_m));
  std::array<Vec3, 3> column;
  for (std::size_t k = 0; k < 3; ++k) {
    Vec3 unit{};
    unit[k] = 1.0;
    const Vec3 within = rotate(conjugate(frame_in_outer.quaternion), unit);
    column[k] = rotate(frame_in_outer.quaternion, inertia_times(body, within));
  }
  out.inertia_kgm2 = {column[0][0], column[1][1], column[2][2], column[1][0], column[2][0], column[2][1]};
  return out;
}

Vec3 inertia_times(const LinkMass& body, const Vec3& v) noexcept {
  const auto& I = body.inertia_kgm2;
  return {I[kXx] * v[0] + I[kXy] * v[1] + I[kXz] * v[2], I[kXy] * v[0] + I[kYy] * v[1] + I[kYz] * v[2],
          I[kXz] * v[0] + I[kYz] * v[1] + I[kZz] * v[2]};
}

}  // namespace liana::serial
