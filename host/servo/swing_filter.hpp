// Where a target is that swings in the arm's base, because the base swings: each axis is a mean and up to two
// oscillations whose periods are roughly known, told apart by a Kalman filter (states: the mean, then each oscillation
// and what it is a quarter of a period later).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "firmware_like/math/pose.hpp"

namespace liana::servo {

constexpr std::size_t kSwings = 2;
constexpr std::size_t kSwingStates = 1 + 2 * kSwings;

// Deviations that the filter assumes; with them 10 mm of swing with a period that is a tenth off is followed.
constexpr double kSeen_m = 0.002;              // of an image: the camera that is assumed
constexpr double kExpectedSwing_m = 0.006;     // before the first image
constexpr double kMeanChange_m_sqrt_s = 2e-4;  // per root of a second
constexpr double kSwingChange_m_sqrt_s = 5e-4;

class SwingFilter {
 public:
  // Both periods > 0 and different, or the second one 0: then there is no such oscillation.
  explicit SwingFilter(const std::array<double, kSwings>& period_s);

  // Begins anew with an image of `time_s`.
  void begin(double time_s, const Vec3& seen_m);
  // An image later than the one before; a constant number of operations.
  void see(double time_s, const Vec3& seen_m);

  const Vec3& mean_m() const { return state_m_[0]; }
  // Its deviation: swings tell themselves from the mean only after a part of their periods.
  double mean_deviation_m() const { return std::sqrt(covariance_m2_[0][0]); }
  // Where it should be seen at `time_s`.
  Vec3 expected_m(double time_s) const;
  // The first oscillation a quarter of its period before `time_s`, with the other sign: what moves so, a mass on the
  // base, takes energy out of it. The second is too quick for an arm that follows some seconds late.
  Vec3 calming_m(double time_s) const;
  // Greatest way of the oscillations from the mean, all axes together.
  double amplitude_m() const;

 private:
  using States = std::array<Vec3, kSwingStates>;
  using Matrix = std::array<std::array<double, kSwingStates>, kSwingStates>;
  Matrix step_of(double dt_s) const;
  States at(double time_s) const;
  void advance(double time_s);

  std::array<double, kSwings> rate_rad_s_{};  // 0: there is no such oscillation
  double time_s_ = 0.0;
  States state_m_{};
  Matrix covariance_m2_{};  // of the states, the same for every axis
};

}  // namespace liana::servo
