#include "hil/serial/pin_contact.hpp"

#include <algorithm>
#include <cmath>

#include "hil/serial/capture_logic.hpp"

namespace liana::bench {

namespace {

constexpr double kSlow_m_s = 1e-4;  // below it dry friction fades

// Dry friction of 1 N per N against a velocity.
Vec3 against(const Vec3& velocity_m_s) {
  return (-1.0 / std::sqrt(dot(velocity_m_s, velocity_m_s) + kSlow_m_s * kSlow_m_s)) * velocity_m_s;
}

double funnel_length_m(const AdapterParams& figures) { return figures.funnel_m - figures.entry_m; }

// How deep the pin is in a wall, and the direction in which that grows fastest. Its elastic energy is half the
// stiffness times the depth squared, without a jump anywhere: that is what keeps contacts from making energy.
struct Overlap {
  double depth_m = 0.0;
  Vec3 gradient;
};

Overlap overlap_of(const AdapterParams& figures, const Vec3& at_m) {
  const double before_face = at_m.z + funnel_length_m(figures);
  const double radius = std::hypot(at_m.x, at_m.y);
  if (before_face <= 0.0 || radius == 0.0) return {};
  const PinClearance clearance = clearance_at(figures, at_m.z);
  const double into_wall = radius - clearance.radius_m;
  if (into_wall <= 0.0) return {};
  if (before_face < into_wall) return {before_face, {0.0, 0.0, 1.0}};  // beside the funnel
  return {into_wall, {at_m.x / radius, at_m.y / radius, -clearance.slope}};
}

Vec3 wall_force_N(const AdapterParams& figures, const PinState& pin) {
  const auto [depth, gradient] = overlap_of(figures, pin.at_m);
  if (depth <= 0.0) return {};
  const double closing = dot(gradient, pin.velocity_m_s);
  const double press = std::max(0.0, figures.stiffness_N_m * depth + figures.damping_Ns_m * closing);
  const Vec3 sliding = pin.velocity_m_s - (closing / dot(gradient, gradient)) * gradient;
  return (-press) * gradient + (figures.friction * press * norm(gradient)) * against(sliding);
}

double spring_force_N(const AdapterParams& figures, const PinState& pin) {
  if (pin.at_m.z <= 0.0) return 0.0;
  const double rate = pin.velocity_m_s.z, dry = -against({0.0, 0.0, rate}).z;
  const double force =
      figures.spring_N_m * pin.at_m.z + figures.spring_friction_N * dry + figures.spring_damping_Ns_m * rate;
  return -std::max(0.0, force) / kPins;  // it pushes only
}

double stop_force_N(double stiffness_N_m, double damping_Ns_m, double stop_m, const PinState& pin) {
  if (pin.at_m.z <= stop_m) return 0.0;
  return -std::max(0.0, stiffness_N_m * (pin.at_m.z - stop_m) + damping_Ns_m * pin.velocity_m_s.z);
}

}  // namespace

PinClearance clearance_at(const AdapterParams& figures, double depth_m) {
  if (depth_m < 0.0) return {figures.entry_m - depth_m, -1.0};
  if (depth_m >= figures.depth_m) return {figures.full_m, 0.0};
  const double slope = (figures.full_m - figures.entry_m) / figures.depth_m;
  return {figures.entry_m + slope * depth_m, slope};
}

bool is_over_body(const AdapterParams& figures, const PinState& pin) {
  return std::hypot(pin.at_m.x, pin.at_m.y) < figures.body_m;
}

Vec3 pin_force_N(const AdapterParams& figures, const PinDefects& defects, const PinState& pin) {
  if (!is_over_body(figures, pin)) return {};
  Vec3 force = wall_force_N(figures, pin);
  force.z += spring_force_N(figures, pin);
  force.z += stop_force_N(figures.stop_N_m / kPins, figures.damping_Ns_m, figures.stop_m, pin);
  if (defects.blocked_m) force.z += stop_force_N(figures.stop_N_m, figures.damping_Ns_m, *defects.blocked_m, pin);
  return force;
}

double latch_force_N(const AdapterParams& figures, double closed_m, const PinState& pin) {
  return -figures.latch_N_m * (pin.at_m.z - closed_m) - figures.damping_Ns_m * pin.velocity_m_s.z;
}

}  // namespace liana::bench
