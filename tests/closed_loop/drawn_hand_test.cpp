// Hands that nobody has tamed lead the arm through the real arbiter and both verification ends: whatever they do, no
// cable goes slack, nothing is touched and no fault is latched.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "drawn_hand.hpp"
#include "fixture.hpp"
#include "verified_arm.hpp"

namespace liana::closed_loop {
namespace {

constexpr double kLed_s = 9.0, kBegins_s = 0.3, kLetsGo_s = 7.0;
constexpr int kSamples = 2;  // in an interval

struct LedByHand {
  double min_motor_N = 1e9, max_contact_N = 0.0, max_tip_m_s = 0.0;
  std::size_t refused = 0;
  std::int32_t faults = 0;
};

LedByHand lead_by_hand(const std::string& pose, std::uint64_t seed, const std::string& physics = "nominal") {
  VerifiedArm arm({physics, seed, true, pose}, true);
  DrawnHand hand(seed, HandBounds{});
  arbiter::DeviceUse use;
  use.kind = device::Kind::kHandController;
  use.speed_m_s = arm.arm().table().limits.tip_speed_m_s;
  arm.arbiter().use_device(arm.arm().outputs(), use);
  LedByHand out;
  Vec3 tip_m = arm.arm().plant().tip_in_base().position_m;
  arm.arm().plant().take_load();
  for (double t_s = 0.0; t_s < kLed_s; t_s += arm.interval_s()) {
    for (int i = 1; i <= kSamples; ++i) {
      const double at_s = t_s + arm.interval_s() * i / kSamples;
      device::Sample sample{.t_us = std::llround(1e6 * at_s), .valid = true, .deadman = t_s < kLetsGo_s};
      sample.pose = hand.at(std::max(0.0, at_s - kBegins_s));
      arm.arbiter().device().add(sample);
    }
    arm.interval([&](ArmUnderControl& now) {
      const Load load = now.plant().take_load();
      out.min_motor_N = std::min(out.min_motor_N, load.min_motor_N);
      out.max_contact_N = std::max(out.max_contact_N, load.contact_N);
      const Vec3 here_m = now.plant().tip_in_base().position_m;
      out.max_tip_m_s = std::max(out.max_tip_m_s, norm(subtract(here_m, tip_m)) / now.table().tick_s);
      tip_m = here_m;
    });
  }
  out.refused = arm.refused().size();
  out.faults = arm.arm().outputs().faults.count;
  return out;
}

// The seeds are of hands that made cables slack before tensions were planned with the arm's mass.
// req:A32 req:C5
TEST(DrawnHand, LeadsTheArmWithoutSlackContactOrFault) {
  const struct {
    const char* pose;
    std::uint64_t seed;
  } hands[] = {{"panel_edge", 6},  {"jig", 8},  {"prepare", 10},         {"prepare", 15},
               {"panel_edge", 16}, {"zero", 2}, {"segment5_in_slit", 4}, {"jig", 18}};
  for (const auto& [pose, seed] : hands) {
    const std::string name = pose + std::string(", seed ") + std::to_string(seed);
    const LedByHand led = lead_by_hand(pose, seed);
    measured(name + ": least tension at any motor", led.min_motor_N, "N");
    measured(name + ": true tip", led.max_tip_m_s, "m/s");
    measured(name + ": commands refused", static_cast<double>(led.refused), "");
    EXPECT_GE(led.min_motor_N, 10.0) << name;
    EXPECT_EQ(led.max_contact_N, 0.0) << name;
    EXPECT_EQ(led.faults, 0) << name;
  }
}

}  // namespace
}  // namespace liana::closed_loop
