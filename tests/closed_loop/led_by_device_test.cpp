// A tip led by a VR handle through the real arbiter: what a moment without tracking costs the cables.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "fixture.hpp"
#include "hand_to_tip.hpp"
#include "host/control/arbiter/cable_arbiter.hpp"

namespace liana::closed_loop {
namespace {

using namespace cable;

constexpr double kScale = 4.0;      // as the slit crossing has it
constexpr double kTip_m_s = 0.06;   // as its person leads the tip
constexpr double kSpeedUp_s = 1.5;  // they take so long to get there
constexpr double kLimit_m_s = 0.10;
constexpr double kSample_s = 1.0 / 90.0;
constexpr double kSeconds = 8.0;

// What a tracker tells of the hand from `from_s` on, for `for_s`.
enum class Tells { kNothing, kWhereItWas };
struct Disturbed {
  double from_s = 1e9, for_s = 0.15;
  Tells what = Tells::kNothing;
  bool at(double t_s) const { return t_s >= from_s && t_s < from_s + for_s; }
};

class LedByDevice {
 public:
  explicit LedByDevice(std::uint64_t seed) : arm_(real_arm(kFree, seed), robot_table().limits), arbiter_(arm_.table()) {
    arm_.settle(kFree);
    arbiter::DeviceUse use;
    use.kind = device::Kind::kVrControllers;
    use.mapping.scale = kScale;
    use.speed_m_s = kLimit_m_s;
    arbiter_.use_device(arm_.outputs(), use);
  }

  // Least tension at any motor [N] while the hand speeds up and goes on.
  double lead(const Disturbed& disturbed) {
    arm_.plant().take_load();
    const double interval_s = arm_.table().tick_s * arm_.table().interval_ticks;
    Setpoint in_force{};  // a command is verified for an interval before it comes into force
    in_force.kind = CommandKind::kTip;
    in_force.tip_in_base = arm_.outputs().tip_command;
    in_force.tip_speed_m_s = kLimit_m_s;
    for (double t_s = 0.0; t_s < kSeconds; t_s += interval_s) {
      take_samples(t_s + interval_s, disturbed);
      tick_ += static_cast<std::uint64_t>(arm_.table().interval_ticks);
      const std::optional<Setpoint> next = arbiter_.next_setpoint(tick_, arm_.outputs());
      arm_.follow(interval_s, [&](double) { return in_force; });
      if (next) in_force = *next;
    }
    EXPECT_EQ(arm_.outputs().faults.count, 0);
    return arm_.plant().take_load().min_motor_N;
  }

 private:
  static double way_m(double t_s) {
    const double up_s = std::min(t_s, kSpeedUp_s);
    return kTip_m_s * (0.5 * up_s * up_s / kSpeedUp_s + std::max(0.0, t_s - kSpeedUp_s));
  }
  void take_samples(double until_s, const Disturbed& disturbed) {
    for (; sampled_s_ < until_s; sampled_s_ += kSample_s) {
      const bool is_disturbed = disturbed.at(sampled_s_);
      const bool is_valid = !is_disturbed || disturbed.what == Tells::kWhereItWas;
      device::Sample sample{.t_us = std::llround(1e6 * sampled_s_), .valid = is_valid, .deadman = true};
      const double hand_s = is_disturbed ? disturbed.from_s : sampled_s_;
      sample.pose.position_m = scale(kFree.direction, way_m(hand_s) / kScale);
      arbiter_.device().add(sample);
    }
  }

  ArmToLead arm_;
  arbiter::CableArbiter arbiter_;
  double sampled_s_ = 0.0;
  std::uint64_t tick_ = 0;
};

// A tracker is blind as long as the simulated person's, at two phases of the swing that the start has left. One that
// shows the hand where it was, and then where it is, does to the arm what waiting for the hand did.
// req:A32
TEST(LedByDevice, AHandThatIsNotSeenForAMomentCostsNoTension) {
  for (const std::uint64_t seed : {1U, 2U}) {
    const std::string arm = "seed " + std::to_string(seed);
    const double undisturbed_N = LedByDevice(seed).lead({});
    double unseen_N = undisturbed_N, waited_for_N = undisturbed_N;
    for (const double from_s : {3.0, 3.7}) {
      unseen_N = std::min(unseen_N, LedByDevice(seed).lead({from_s}));
      waited_for_N = std::min(waited_for_N, LedByDevice(seed).lead({from_s, 0.15, Tells::kWhereItWas}));
    }
    measured(arm + ": least tension of a hand always seen", undisturbed_N, "N");
    measured(arm + ": not seen for 0.15 s", unseen_N, "N");
    measured(arm + ": seen where it was for 0.15 s", waited_for_N, "N");
    EXPECT_GT(unseen_N, undisturbed_N - 1.0);
    EXPECT_GE(unseen_N, waited_for_N - 0.5);
  }
}

}  // namespace
}  // namespace liana::closed_loop
