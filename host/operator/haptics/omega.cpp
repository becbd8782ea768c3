#include "host/operator/haptics/omega.hpp"

#include <algorithm>
#include <cmath>

namespace liana::haptics {
namespace {

constexpr int kParts = 10;  // of a millisecond: the stiffest spring here, 20 kN/m on 0.25 kg, turns 0.03 rad in one

Quat attitude(const Vec3& wrist_rad) {  // assumed order: about x, then the turned y, then the turned z
  return multiply(multiply(quaternion_of({wrist_rad[0], 0.0, 0.0}), quaternion_of({0.0, wrist_rad[1], 0.0})),
                  quaternion_of({0.0, 0.0, wrist_rad[2]}));
}

}  // namespace

HeldOmega::HeldOmega(const OmegaTable& omega, const HandParams& hand, const Vec3& start_m, std::uint64_t seed)
    : table_(omega), hand_(hand, omega.mass_kg, seed), truth_{start_m, {}}, sensed_m_(start_m) {}

// Beyond the workspace, towards it; a stop never pulls.
Vec3 HeldOmega::stop_force() const noexcept {
  const auto push = [this](double beyond_m, double outwards_m_s) {
    return beyond_m > 0.0 ? std::max(0.0, table_.stop_N_m * beyond_m + table_.stop_N_s_m * outwards_m_s) : 0.0;
  };
  const Vec3 &p = truth_.position_m, &v = truth_.velocity_m_s;
  const double radius_m = std::hypot(p[1], p[2]);
  const double along = std::copysign(push(std::fabs(p[0]) - table_.depth_m, std::copysign(1.0, p[0]) * v[0]), p[0]);
  if (radius_m <= table_.radius_m) return {-along, 0.0, 0.0};
  const double across = push(radius_m - table_.radius_m, (p[1] * v[1] + p[2] * v[2]) / radius_m) / radius_m;
  return {-along, -across * p[1], -across * p[2]};
}

void HeldOmega::integrate(const Vec3& motors_N, double step_s) noexcept {
  const Vec3 drag = scale(truth_.velocity_m_s, -table_.damping_N_s_m);
  const Vec3 force = add(add(motors_N, drag), add(stop_force(), hand_.force(truth_.position_m, truth_.velocity_m_s)));
  truth_.velocity_m_s = add(truth_.velocity_m_s, scale(force, step_s / (table_.mass_kg + hand_.mass_kg())));
  const Vec3 moved = scale(truth_.velocity_m_s, step_s);
  truth_.position_m = add(truth_.position_m, moved);
  absorbed_J_ -= dot(motors_N, moved);
}

void HeldOmega::step(const Vec3& force_N, const Intent& intent) noexcept {
  hand_.intend(intent);
  hand_.tremble(1e-6 * static_cast<double>(t_us_));
  const Vec3 motors_N = no_longer(force_N, table_.force_N);
  for (int part = 0; part < kParts; ++part) integrate(motors_N, kTick_s / kParts);
  for (std::size_t i = 0; i < 3; ++i)
    wrist_rad_[i] = std::clamp(hand_.acted().wrist_rad[i], -table_.wrist_rad[i], table_.wrist_rad[i]);
  t_us_ += kTick_us;
  const auto angles = delta_angles(table_.delta, add(truth_.position_m, {table_.centre_m, 0.0, 0.0}));
  const auto jacobian = angles ? delta_jacobian(table_.delta, *angles) : std::nullopt;
  torques_Nm_ = jacobian ? delta_torques(*jacobian, motors_N) : std::array<double, 3>{};
}

device::Sample HeldOmega::sample() noexcept {
  auto angles = delta_angles(table_.delta, add(truth_.position_m, {table_.centre_m, 0.0, 0.0}));
  if (angles) {
    for (double& angle : *angles) angle = table_.encoder_rad * std::round(angle / table_.encoder_rad);
  }
  const auto position = angles ? delta_position(table_.delta, *angles) : std::nullopt;
  if (position) sensed_m_ = subtract(*position, {table_.centre_m, 0.0, 0.0});
  return {.t_us = t_us_,
          .valid = position.has_value(),
          .deadman = hand_.acted().button,
          .pose = {sensed_m_, attitude(wrist_rad_)}};
}

}  // namespace liana::haptics
