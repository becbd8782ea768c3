// Where a target is that swings in the arm's base, because the base swings: each axis, of its place or of its attitude,
// is a mean and up to two oscillations whose periods are roughly known, told apart by a Kalman filter (states: the
// mean, then each oscillation and what it is a quarter of a period later). All figures are in the unit of what is seen.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "firmware_like/math/pose.hpp"
#include "host/control/timing/trajectory_timing.hpp"

namespace liana::visual_servo {

constexpr std::size_t kSwings = 2;
constexpr std::size_t kSwingStates = 1 + 2 * kSwings;

// Deviations that a filter assumes; with them 10 mm of swing with a period that is a tenth off is followed.
struct SwingNoise {
  double seen;                // of an image: the camera that is assumed
  double swing;               // before the first image
  double mean_change_sqrt_s;  // per root of a second
  double swing_change_sqrt_s;
};
constexpr SwingNoise kPlaceNoise_m{0.002, 0.006, 2e-4, 5e-4};
constexpr SwingNoise kAttitudeNoise_rad{0.0035, 0.003, 1e-4, 2.5e-4};  // an arm 2 to 4 m long turns what it moves

class SwayFilter {
 public:
  // Both periods > 0 and different, or the quick one 0: then there is no such oscillation.
  explicit SwayFilter(const motion::Swings& swings, const SwingNoise& noise = kPlaceNoise_m);

  // Begins anew with an image of `time_s`.
  void begin(double time_s, const Vec3& seen);
  // An image later than the one before; a constant number of operations.
  void see(double time_s, const Vec3& seen);

  const Vec3& mean() const { return state_[0]; }
  // Its deviation: swings tell themselves from the mean only after a part of their periods.
  double mean_deviation() const { return std::sqrt(covariance_[0][0]); }
  // Where it should be seen at `time_s`.
  Vec3 expected(double time_s) const;
  // The first oscillation a quarter of its period before `time_s`, with the other sign: what moves so, a mass on the
  // base, takes energy out of it. The second is too quick for an arm that follows some seconds late.
  Vec3 calming(double time_s) const;
  // Greatest way of the oscillations from the mean, all axes together.
  double amplitude() const;

 private:
  using States = std::array<Vec3, kSwingStates>;
  using Matrix = std::array<std::array<double, kSwingStates>, kSwingStates>;
  Matrix step_of(double dt_s) const;
  States at(double time_s) const;
  void advance(double time_s);

  SwingNoise noise_;
  std::array<double, kSwings> rate_rad_s_{};  // 0: there is no such oscillation
  double time_s_ = 0.0;
  States state_{};
  Matrix covariance_{};  // of the states, the same for every axis
};

}  // namespace liana::visual_servo
