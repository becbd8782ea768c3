// Tremor stage (req:A16): 8 to 12 Hz go, slower motion stays, nothing is amplified, and what rests is left alone.
#include "firmware_like/operator_input/tremor_notch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "firmware_like/math/trig.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana {
namespace {

constexpr double kTick_s = 0.004;

Pose at(double x_m, const Vec3& turn_rad = {}) { return {{x_m, 0.0, 0.0}, quaternion_of(turn_rad)}; }

// How much of a sine of 1 mm and 5 mrad is left [dB], of the position and of the attitude: by their parts at the
// frequency, over the last half of 20 s.
struct Gain {
  double position_dB, attitude_dB;
};
Gain gain_at(double frequency_hz, double tick_s) {
  constexpr double kSize_m = 0.001, kSize_rad = 0.005;
  TremorState state;
  Vec3 in_phase{}, across{};
  const auto ticks = static_cast<int>(20.0 / tick_s);
  for (int i = 0; i < ticks; ++i) {
    const double phase = 2.0 * kPi * frequency_hz * i * tick_s, wave = std::sin(phase);
    const SteadyTarget out = without_tremor(at(kSize_m * wave, {0.0, kSize_rad * wave, 0.0}), tick_s, state);
    if (i < ticks / 2) continue;
    const Vec3 now{out.pose.position_m[0] / kSize_m, rotation_vector(out.pose.quaternion)[1] / kSize_rad, 0.0};
    in_phase = add(in_phase, scale(now, wave));
    across = add(across, scale(now, std::cos(phase)));
  }
  const auto dB = [&](std::size_t k) { return 20.0 * std::log10(4.0 * std::hypot(in_phase[k], across[k]) / ticks); };
  return {dB(0), dB(1)};
}

TEST(TremorNotch, TakesTwentyDecibelAndMoreFromEightToTwelveHertz) {
  for (const double tick_s : {0.004, 0.002}) {
    for (double hz = 8.0; hz <= 12.01; hz += 0.1) {
      const Gain gain = gain_at(hz, tick_s);
      ASSERT_LT(gain.position_dB, -25.0) << hz;
      ASSERT_LT(gain.attitude_dB, -25.0) << hz;
    }
  }
}

TEST(TremorNotch, AmplifiesNothingAndLeavesWhatIsSlow) {
  for (double hz = 0.25; hz < 100.0; hz += hz < 7.0 ? 0.25 : 3.0) {
    const Gain gain = gain_at(hz, kTick_s);
    ASSERT_LT(gain.position_dB, 0.01) << hz;
    ASSERT_LT(gain.attitude_dB, 0.01) << hz;
    if (hz <= 2.0) {
      ASSERT_GT(gain.position_dB, -0.5) << hz;
    }
  }
}

TEST(TremorNotch, IsLateByTheStatedTimeAndTellsTheVelocity) {
  const Vec3 rate{0.1, -0.05, 0.2};
  TremorState state;
  SteadyTarget out;
  double t_s = 0.0;
  for (; t_s < 2.0; t_s += kTick_s) out = without_tremor(at(0.1 * t_s, scale(rate, t_s)), kTick_s, state);
  EXPECT_NEAR((0.1 * (t_s - kTick_s) - out.pose.position_m[0]) / 0.1, kTremorLag_s, 0.001);
  EXPECT_NEAR(out.velocity_m_s[0], 0.1, 1e-6);
  const double behind_rad = norm(rate) * (t_s - kTick_s) - norm(rotation_vector(out.pose.quaternion));
  EXPECT_NEAR(behind_rad / norm(rate), kTremorLag_s, 0.001);
  EXPECT_NEAR(norm(out.rate_rad_s), norm(rate), 1e-6);
}

// Once round about changing axes, which leaves nothing behind.
TEST(TremorNotch, ATargetThatRestsIsReachedToTheLastBitWhateverWentBefore) {
  cable::zhu2022::Random random(3);
  TremorState state;
  Pose target;
  for (int i = 0; i < 5000; ++i) {
    target.position_m = add(target.position_m, random.vector(0.001));
    target.quaternion = normalize(multiply(quaternion_of(random.vector(0.02)), target.quaternion));
    const SteadyTarget out = without_tremor(target, kTick_s, state);
    ASSERT_LT(norm(subtract(out.pose.position_m, target.position_m)), 0.02);
  }
  SteadyTarget out;
  for (int i = 0; i < 500; ++i) out = without_tremor(target, kTick_s, state);
  EXPECT_EQ(out.pose.position_m, target.position_m);
  EXPECT_EQ(out.velocity_m_s, Vec3{});
  EXPECT_LT(norm(rotation_vector(multiply(out.pose.quaternion, conjugate(target.quaternion)))), 1e-15);
}

TEST(TremorNotch, BeginsAtRestWhereItIsTold) {
  TremorState state;
  for (const double x_m : {0.3, 0.3, 0.5}) {
    if (x_m == 0.5) state = TremorState{};
    const SteadyTarget out = without_tremor(at(x_m), kTick_s, state);
    EXPECT_EQ(out.pose.position_m[0], x_m);
    EXPECT_EQ(out.velocity_m_s[0], 0.0);
  }
}

TEST(TremorNotch, ATargetThatJumpsAsNoHandDoesRingsNoLonger) {
  TremorState state;
  without_tremor(at(0.0), kTick_s, state);
  for (const double x_m : {0.3, 1e300, -1e300, 0.0}) {
    const SteadyTarget out = without_tremor(at(x_m), kTick_s, state);
    EXPECT_EQ(out.pose.position_m[0], x_m);
    EXPECT_EQ(norm(out.velocity_m_s), 0.0);
  }
}

TEST(TremorNotch, ATickTooLongForTheFrequenciesPassesTheTargetAsItIs) {
  TremorState state;
  without_tremor(at(0.0), 0.05, state);
  const SteadyTarget out = without_tremor(at(0.01), 0.05, state);
  EXPECT_EQ(out.pose.position_m[0], 0.01);
  EXPECT_NEAR(out.velocity_m_s[0], 0.2, 1e-15);
}

}  // namespace
}  // namespace liana
