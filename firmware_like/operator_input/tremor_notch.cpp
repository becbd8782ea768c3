#include "firmware_like/operator_input/tremor_notch.hpp"

#include "firmware_like/math/trig.hpp"

namespace liana {
namespace {

// Spread so that between 8 and 12 Hz no frequency is far from one of them; the lower Q, the wider and the later.
constexpr std::array<double, kNotches> kFrequency_hz{8.2, 9.9, 11.6};
constexpr double kQ = 1.4;

constexpr double kJump_m = 0.25;
constexpr double kJump_rad = 1.0;
constexpr double kGone = 1e-10;  // m or rad: an offset below is none, and never becomes a denormal number

// 1 / (1 + alpha) (1 + alpha, -2 cos w, 1 - alpha), alpha = sin w / 2 Q: the common denominator of notch and band pass.
struct NotchFactors {
  double now, before;  // of the last offset and of the one before
  double drive;        // of two steps of the input
};

NotchFactors factors(double frequency_hz, double tick_s) noexcept {
  const SinCos w = sin_cos(2.0 * kPi * frequency_hz * tick_s);
  const double alpha = w.sin / (2.0 * kQ), scale = 1.0 / (1.0 + alpha);
  return {2.0 * w.cos * scale, (1.0 - alpha) * scale, alpha * scale};
}

// One notch; `step` and `offset` are those of the chain so far, and become those behind this notch.
void pass(const NotchFactors& by, NotchState& state, Vec3& step, Vec3& offset) noexcept {
  const Vec3 two_steps = add(step, state.step);
  const Vec3 swing = subtract(scale(state.offset, by.now), scale(state.earlier, by.before));
  const Vec3 now = subtract(swing, scale(two_steps, by.drive));
  const Vec3 out = add(step, subtract(now, state.offset));
  state = {step, now, state.offset};
  if (dot(now, now) + dot(state.earlier, state.earlier) < kGone * kGone) state = {step, {}, {}};
  offset = add(offset, now);
  step = out;
}

bool jumps(const Vec3& step_m, const Vec3& turn_rad) noexcept {
  return !(norm(step_m) <= kJump_m && norm(turn_rad) <= kJump_rad);
}

}  // namespace

SteadyTarget without_tremor(const Pose& target, double tick_s, TremorState& state) noexcept {
  Vec3 step = subtract(target.position_m, state.target.position_m);
  Vec3 turn = rotation_vector(multiply(target.quaternion, conjugate(state.target.quaternion)));
  if (!state.begun || jumps(step, turn)) {
    state = TremorState{true, target, {}, {}};
    return {target, {}, {}};
  }
  state.target = target;
  Vec3 shift{}, tilt{};
  for (std::size_t i = 0; i < kNotches && tick_s <= kLongestNotchTick_s; ++i) {
    const NotchFactors by = factors(kFrequency_hz[i], tick_s);
    pass(by, state.linear[i], step, shift);
    pass(by, state.angular[i], turn, tilt);
  }
  return {{add(target.position_m, shift), normalize(multiply(quaternion_of(tilt), target.quaternion))},
          scale(step, 1.0 / tick_s),
          scale(turn, 1.0 / tick_s)};
}

}  // namespace liana
