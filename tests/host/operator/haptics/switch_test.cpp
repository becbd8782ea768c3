// Law, wall, scale and button switched at random instants under a hand: the force goes on without a step.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>

#include "host/operator/haptics/haptic_loop.hpp"
#include "host/operator/haptics/omega.hpp"
#include "tests/host/operator/haptics/laws.hpp"

namespace liana::haptics {
namespace {

constexpr double kWallDamping_N_s_m = 10.0;
// In a millisecond, besides what the damping of a wall is to a hand that comes into it at speed, which is no switch:
// what the law's rate limit lets through (0.2 N), a wall of 1500 N/m that gets its stiffness in 20 ms under a hand up
// to 10 mm inside (0.75 N), its damping and that of the air under a hand that accelerates (0.15 N).
constexpr double kMaxStep_N = 1.1;

struct Felt {
  double step_N = 0.0;  // largest change in a millisecond that the tank has no part in
  double most_N = 0.0;
  int switches = 0;
};

// An arm that lags 0.3 s behind the hand, and is told of and predicted without delay.
class SwitchedHand {
 public:
  explicit SwitchedHand(std::uint64_t seed) : random_(seed), omega_({}, hand(), {}, seed) {}

  Felt run(int instants) {
    for (int i = 0; i < instants; ++i) {
      change();
      for (int ms = 0, most = 100 + static_cast<int>(random_() % 300); ms < most; ++ms) step();
    }
    felt_.switches = instants;
    return felt_;
  }

 private:
  static HandParams hand() {
    HandParams table;
    table.stiffness_N_m = 300.0;
    return table;
  }
  double one() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random_); }

  void change() {
    const auto what = random_() % 5;
    if (what == 0) loop_.choose(kLaws[random_() % kLaws.size()]);
    if (what == 1) has_wall_ = !has_wall_;
    if (what == 1 || what == 2) next_wall_m_ = sensed_m_ + 0.010 * one();
    if (what == 3) rescale();
    if (what == 4) button_ = !button_;
  }
  // As on a new grip: the tip asked for stays where it is.
  void rescale() {
    anchor_tip_m_ = asked_m();
    anchor_hand_m_ = sensed_m_;
    scale_ = 0.5 + 1.5 * std::fabs(one());
  }
  double asked_m() const { return anchor_tip_m_ + scale_ * (sensed_m_ - anchor_hand_m_); }

  void tell() {
    tip_m_ += (asked_m() - tip_m_) * 0.02 / 0.3;
    loop_.predict(t_us_, {{0.0, asked_m(), 0.0}, {}});
    loop_.take(StatePacket{++sequence_, t_us_, 0, {{0.0, tip_m_, 0.0}, {}}});
    const bool is_none = !has_wall_ || wall_m_ != next_wall_m_;  // a wall elsewhere comes after an interval of none
    loop_.take(Plane{{0.0, -1.0, 0.0}, -wall_m_, is_none ? 0.0 : 1500.0, is_none ? 0.0 : kWallDamping_N_s_m});
    wall_m_ = next_wall_m_;
  }

  void step() {
    if (t_us_ % 20000 == 0) tell();
    auto sample = omega_.sample();
    sample.deadman = button_;
    sensed_m_ = sample.pose.position_m[1];
    const HandForce& now = loop_.step(sample, {0.0, asked_m(), 0.0});
    const bool enters = (norm(now.wall_N) > 0.0) != (norm(before_.wall_N) > 0.0);
    const double entry_N = enters ? kWallDamping_N_s_m * norm(omega_.truth().velocity_m_s) : 0.0;
    const double step_N = norm(subtract(now.force_N, before_.force_N)) - entry_N;
    if (now.passed == 1.0 && before_.passed == 1.0) felt_.step_N = std::max(felt_.step_N, step_N);
    felt_.most_N = std::max(felt_.most_N, norm(now.force_N));
    before_ = now;
    const double aim_m = 0.015 * std::sin(2e-6 * static_cast<double>(t_us_));
    omega_.step(now.force_N, {{0.0, aim_m, 0.0}, {}, true});
    t_us_ += 1000;
  }

  std::mt19937_64 random_;
  HeldOmega omega_;
  HapticLoop loop_{HandLoopTable{}};
  HandForce before_{};
  Felt felt_;
  double sensed_m_ = 0.0, tip_m_ = 0.0, wall_m_ = 0.01, next_wall_m_ = 0.01, scale_ = 1.0, anchor_tip_m_ = 0.0,
         anchor_hand_m_ = 0.0;
  bool has_wall_ = true, button_ = true;
  std::uint32_t sequence_ = 0;
  std::int64_t t_us_ = 0;
};

// req:C14
TEST(HandSwitch, NoForceStepsAtAThousandSwitchesOfLawWallScaleAndButton) {
  const Felt felt = SwitchedHand(11).run(1000);
  std::printf("  measured: at most %.3f N in a millisecond, %.2f N in all\n", felt.step_N, felt.most_N);
  EXPECT_LE(felt.step_N, kMaxStep_N);
  EXPECT_GT(felt.most_N, 2.0) << "or nothing was felt";
}

}  // namespace
}  // namespace liana::haptics
