#include "host/servo/swing_filter.hpp"

namespace liana::servo {

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

SwingFilter::SwingFilter(const std::array<double, kSwings>& period_s) {
  for (std::size_t k = 0; k < kSwings; ++k) rate_rad_s_[k] = period_s[k] > 0.0 ? 2.0 * kPi / period_s[k] : 0.0;
}

// What is seen first is a mean and swings of which only the sum is known.
void SwingFilter::begin(double time_s, const Vec3& seen_m) {
  constexpr double kSwing_m2 = kExpectedSwing_m * kExpectedSwing_m;
  time_s_ = time_s;
  state_m_ = {seen_m};
  covariance_m2_ = {};
  covariance_m2_[0][0] = kSeen_m * kSeen_m;
  for (std::size_t k = 0; k < kSwings; ++k) {
    if (rate_rad_s_[k] == 0.0) continue;
    const std::size_t i = in_phase(k), q = quadrature(k);
    covariance_m2_[i][i] = covariance_m2_[q][q] = kSwing_m2;
    covariance_m2_[0][i] = covariance_m2_[i][0] = -kSwing_m2;
    covariance_m2_[0][0] += kSwing_m2;
  }
}

SwingFilter::Matrix SwingFilter::step_of(double dt_s) const {
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

SwingFilter::States SwingFilter::at(double time_s) const {
  const Matrix step = step_of(time_s - time_s_);
  States out{};
  for (std::size_t i = 0; i < kSwingStates; ++i)
    for (std::size_t j = 0; j < kSwingStates; ++j) out[i] = add(out[i], scale(state_m_[j], step[i][j]));
  return out;
}

void SwingFilter::advance(double time_s) {
  const double dt_s = time_s - time_s_;
  const Matrix step = step_of(dt_s);
  state_m_ = at(time_s);
  time_s_ = time_s;
  covariance_m2_ = product(step, transposed(product(step, covariance_m2_)));  // it is symmetric
  covariance_m2_[0][0] += kMeanChange_m_sqrt_s * kMeanChange_m_sqrt_s * dt_s;
  for (std::size_t k = 0; k < kSwings; ++k) {
    if (rate_rad_s_[k] == 0.0) continue;
    for (const std::size_t i : {in_phase(k), quadrature(k)})
      covariance_m2_[i][i] += kSwingChange_m_sqrt_s * kSwingChange_m_sqrt_s * dt_s;
  }
}

void SwingFilter::see(double time_s, const Vec3& seen_m) {
  advance(time_s);
  const Vec3 off_m = subtract(seen_m, expected_m(time_s));
  std::array<double, kSwingStates> with_seen_m2{};  // covariance of each state with what is seen
  for (std::size_t i = 0; i < kSwingStates; ++i)
    for (const std::size_t j : kSeenStates) with_seen_m2[i] += covariance_m2_[i][j];
  double variance_m2 = kSeen_m * kSeen_m;
  for (const std::size_t j : kSeenStates) variance_m2 += with_seen_m2[j];
  for (std::size_t i = 0; i < kSwingStates; ++i) {
    state_m_[i] = add(state_m_[i], scale(off_m, with_seen_m2[i] / variance_m2));
    for (std::size_t j = 0; j < kSwingStates; ++j)
      covariance_m2_[i][j] -= with_seen_m2[i] * with_seen_m2[j] / variance_m2;
  }
}

Vec3 SwingFilter::expected_m(double time_s) const {
  const States states = at(time_s);
  Vec3 out{};
  for (const std::size_t i : kSeenStates) out = add(out, states[i]);
  return out;
}

Vec3 SwingFilter::calming_m(double time_s) const { return scale(at(time_s)[quadrature(0)], -1.0); }

double SwingFilter::amplitude_m() const {
  double out_m = 0.0;
  for (std::size_t k = 0; k < kSwings; ++k)
    out_m += std::hypot(norm(state_m_[in_phase(k)]), norm(state_m_[quadrature(k)]));
  return out_m;
}

}  // namespace liana::servo
