#include "host/control/visual_servo/sway_filter.hpp"

namespace liana::visual_servo {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr std::size_t in_phase(std::size_t swing) { return 1 + 2 * swing; }
constexpr std::size_t quadrature(std::size_t swing) { return 2 + 2 * swing; }
// What is seen is the sum of these.
constexpr std::array<std::size_t, 1 + kSwings> kSeenStates{0, in_phase(0), in_phase(1)};

template <std::size_t N>
using Square = std::array<std::array<double, N>, N>;

template <std::size_t N>
Square<N> product(const Square<N>& a, const Square<N>& b) {
  Square<N> out{};
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j < N; ++j)
      for (std::size_t k = 0; k < N; ++k) out[i][j] += a[i][k] * b[k][j];
  return out;
}

template <std::size_t N>
Square<N> transposed(const Square<N>& a) {
  Square<N> out{};
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j < N; ++j) out[i][j] = a[j][i];
  return out;
}

}  // namespace

SwayFilter::SwayFilter(const motion::Swings& swings, const SwingNoise& noise) : noise_(noise) {
  const std::array<double, kSwings> period_s{swings.slow_s, swings.quick_s};
  for (std::size_t k = 0; k < kSwings; ++k) rate_rad_s_[k] = period_s[k] > 0.0 ? 2.0 * kPi / period_s[k] : 0.0;
}

// What is seen first is a mean and swings of which only the sum is known.
void SwayFilter::begin(double time_s, const Vec3& seen) {
  const double swing2 = noise_.swing * noise_.swing;
  time_s_ = time_s;
  state_ = {seen};
  covariance_ = {};
  covariance_[0][0] = noise_.seen * noise_.seen;
  for (std::size_t k = 0; k < kSwings; ++k) {
    if (rate_rad_s_[k] == 0.0) continue;
    const std::size_t i = in_phase(k), q = quadrature(k);
    covariance_[i][i] = covariance_[q][q] = swing2;
    covariance_[0][i] = covariance_[i][0] = -swing2;
    covariance_[0][0] += swing2;
  }
}

SwayFilter::Matrix SwayFilter::step_of(double dt_s) const {
  Matrix step{};
  step[0][0] = 1.0;
  for (std::size_t k = 0; k < kSwings; ++k) {
    const double cos = std::cos(rate_rad_s_[k] * dt_s), sin = std::sin(rate_rad_s_[k] * dt_s);
    const std::size_t i = in_phase(k), q = quadrature(k);
    step[i][i] = step[q][q] = cos;
    step[i][q] = -sin;
    step[q][i] = sin;
  }
  return step;
}

SwayFilter::States SwayFilter::at(double time_s) const {
  const Matrix step = step_of(time_s - time_s_);
  States out{};
  for (std::size_t i = 0; i < kSwingStates; ++i)
    for (std::size_t j = 0; j < kSwingStates; ++j) out[i] = add(out[i], scale(state_[j], step[i][j]));
  return out;
}

void SwayFilter::advance(double time_s) {
  const double dt_s = time_s - time_s_;
  const Matrix step = step_of(dt_s);
  state_ = at(time_s);
  time_s_ = time_s;
  covariance_ = product(step, transposed(product(step, covariance_)));  // it is symmetric
  covariance_[0][0] += noise_.mean_change_sqrt_s * noise_.mean_change_sqrt_s * dt_s;
  for (std::size_t k = 0; k < kSwings; ++k) {
    if (rate_rad_s_[k] == 0.0) continue;
    for (const std::size_t i : {in_phase(k), quadrature(k)})
      covariance_[i][i] += noise_.swing_change_sqrt_s * noise_.swing_change_sqrt_s * dt_s;
  }
}

void SwayFilter::see(double time_s, const Vec3& seen) {
  advance(time_s);
  const Vec3 off = subtract(seen, expected(time_s));
  std::array<double, kSwingStates> with_seen2{};  // covariance of each state with what is seen
  for (std::size_t i = 0; i < kSwingStates; ++i)
    for (const std::size_t j : kSeenStates) with_seen2[i] += covariance_[i][j];
  double variance = noise_.seen * noise_.seen;
  for (const std::size_t j : kSeenStates) variance += with_seen2[j];
  for (std::size_t i = 0; i < kSwingStates; ++i) {
    state_[i] = add(state_[i], scale(off, with_seen2[i] / variance));
    for (std::size_t j = 0; j < kSwingStates; ++j) covariance_[i][j] -= with_seen2[i] * with_seen2[j] / variance;
  }
}

Vec3 SwayFilter::expected(double time_s) const {
  const States states = at(time_s);
  Vec3 out{};
  for (const std::size_t i : kSeenStates) out = add(out, states[i]);
  return out;
}

Vec3 SwayFilter::calming(double time_s) const { return scale(at(time_s)[quadrature(0)], -1.0); }

double SwayFilter::amplitude() const {
  double out = 0.0;
  for (std::size_t k = 0; k < kSwings; ++k) out += std::hypot(norm(state_[in_phase(k)]), norm(state_[quadrature(k)]));
  return out;
}

}  // namespace liana::visual_servo
