// The source's arm (docs/reference/formats.md, robot zhu2022) as the core's table, and the random poses that the core's
// tests share.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

#include "firmware_like/cable/arm/kinematics.hpp"
#include "firmware_like/cable/arm/robot_params.hpp"
#include "firmware_like/math/trig.hpp"

namespace liana::cable::zhu2022 {

constexpr std::size_t kThetas = 10;
constexpr std::size_t kCables = 15;
constexpr double kMu = 0.05;  // friction of the nominal arm

// Bits of held masks; angles as the source counts them, from 1.
constexpr std::uint32_t bit(std::size_t theta) { return 1u << (theta - 1); }
constexpr std::uint32_t kX5 = bit(9);
constexpr std::uint32_t kX4AndX5 = bit(7) | bit(9);

using Degrees = std::array<double, kThetas>;
constexpr Degrees kPrepare_deg{-8.5, 0, -12, 0, 8, -2, 13, 0, 12, -2};
constexpr Degrees kPanelEdge_deg{-6.14, -15, -3.29, -8.72, 7.2, 15, 5.55, 15, 1, -2.8};
constexpr Degrees kPressRod_deg{-2.641, -2.064, -1.81, -4.64, 4.777, 5.87, 0, 4.764, 0, -0.543};

// One segment with its cables evenly round, the first at `first_phase_deg`.
inline SegmentParams segment(std::int32_t modules, std::int32_t cables, double first_phase_deg) {
  SegmentParams out;
  out.modules = modules;
  out.cables = cables;
  out.module_length_m = 0.1;
  out.theta_limit_rad = 20.0 * kDegree;
  out.module_mass_kg = 0.3;
  out.hole_radius_m = 0.025;
  out.face_offset_m = 0.010;
  for (std::int32_t c = 0; c < cables; ++c) {
    out.cable_phase_rad[static_cast<std::size_t>(c)] = (first_phase_deg + 360.0 / cables * c) * kDegree;
  }
  return out;
}

// The arm at 250 Hz with T_c = 20 ms; `mu` is the friction that the core is told.
inline RobotParams table(double mu = kMu) {
  RobotParams robot;
  robot.segment_count = 5;
  for (std::size_t m = 0; m < 5; ++m) robot.segment[m] = segment(8, 3, 24.0 * static_cast<double>(m));
  robot.cable_EA_N = 240000.0;
  robot.lead_m = 0.5;
  robot.friction_mu = mu;
  robot.servo_time_constant_s = 0.03;
  robot.tick_s = 0.004;
  robot.interval_ticks = 5;
  robot.tension = {40.0, 15.0, 1.0, 150.0, 400.0, 600.0};
  robot.limits = {2.0 * kDegree,  4.0 * kDegree,   0.10, 0.03, 0.2, 2.0, 20.0 * kDegree,
                  40.0 * kDegree, 400.0 * kDegree, 0.010};
  for (std::size_t i = 0; i < kMaxCables; ++i)
    robot.drive[i] = {2.0 * kPi * 0.015 / 65536.0, i % 2 == 0 ? 1 : -1, 1000000, 0.6};
  return robot;
}

// Another arm within the capacity: odd module counts, other link lengths, four cables in one segment, uneven phases,
// other holes and discs in each segment.
inline RobotParams uneven_table() {
  RobotParams robot = table();
  robot.segment_count = 3;
  robot.segment[0] = segment(7, 4, 10.0);
  robot.segment[1] = segment(8, 3, 35.0);
  robot.segment[2] = segment(9, 3, 0.0);
  robot.segment[1].module_length_m = 0.08;
  robot.segment[1].hole_radius_m = 0.021;
  robot.segment[2].hole_radius_m = 0.017;
  robot.segment[0].face_offset_m = 0.012;
  robot.segment[2].face_offset_m = 0.007;
  robot.segment[2].cable_phase_rad = {5.0 * kDegree, 110.0 * kDegree, 250.0 * kDegree, 0.0};
  return robot;
}

inline ThetaVector radians(const Degrees& theta_deg) {
  ThetaVector theta{};
  for (std::size_t i = 0; i < kThetas; ++i) theta[i] = theta_deg[i] * kDegree;
  return theta;
}

// Repeatable random numbers; the same on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  // Evenly spread in [low, high).
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) / 9007199254740992.0;
  }
  // Every theta within +-`range_deg`.
  ThetaVector theta(const RobotParams& robot, double range_deg) {
    ThetaVector out{};
    for (std::size_t i = 0; i < static_cast<std::size_t>(robot.theta_count()); ++i)
      out[i] = uniform(-range_deg, range_deg) * kDegree;
    return out;
  }
  Vec3 vector(double range) { return {uniform(-range, range), uniform(-range, range), uniform(-range, range)}; }

 private:
  std::mt19937_64 engine_;
};

// Largest |a - b| over all entries.
template <std::size_t N>
double largest_difference(const std::array<double, N>& a, const std::array<double, N>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < N; ++i) largest = std::max(largest, std::fabs(a[i] - b[i]));
  return largest;
}

// Length of a vector of any size.
template <std::size_t N>
double length(const std::array<double, N>& a) {
  double sum = 0.0;
  for (double x : a) sum += x * x;
  return std::sqrt(sum);
}

// a + s b.
template <std::size_t N>
std::array<double, N> plus(const std::array<double, N>& a, const std::array<double, N>& b, double s = 1.0) {
  std::array<double, N> sum{};
  for (std::size_t i = 0; i < N; ++i) sum[i] = a[i] + s * b[i];
  return sum;
}

}  // namespace liana::cable::zhu2022
