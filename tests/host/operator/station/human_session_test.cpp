// The human's whole session, slit crossing without physics: devices, prediction, force, delay (req:A27 req:A49).
#include "host/operator/station/human_session.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/firmware_like/zhu2022.hpp"
#include "tests/host/operator/simulated/scene.hpp"
#include "tests/host/operator/station/human_rig.hpp"
#include "tests/rounds.hpp"

namespace liana::test {
namespace {

namespace zhu2022 = cable::zhu2022;
using station::HumanSession;
using station::HumanSteering;
using station::HumanTable;

config::RobotConfig robot() {
  config::RobotConfig config;
  config.table = zhu2022::table();
  config.module_radius_m = 0.03;
  return config;
}

config::SceneConfig scene() {
  config::SceneConfig scene = panel_scene();
  scene.slit->normal = kAcrossSlit;
  scene.slit->offset_m = -0.7845031;
  scene.slit->u_axis = kIntoSlit;
  scene.slit->mouth_u_m = 1.75;
  scene.slit->end_u_m = 3.70;
  scene.slit->half_gap_m = 0.05;
  return scene;
}

HumanSteering human(const HumanTable& table, const haptics::Delays& delays = {}) {
  return HumanSteering(HumanSession(table, robot(), scene()), delays, table.seed);
}

// What came of one crossing.
struct Crossing {
  bool edge = false, slit = false, rod = false;
  double edge_s = 0.0, slit_s = 0.0, rod_s = 0.0;
  double error_m = 0.0, error_rad = 0.0, widest_m = 0.0;
  station::HandMotionParams hand{};
};

Crossing cross(HumanTable table, const haptics::Delays& delays = {}) {
  table.there_and_back_s = delays.forward_s + delays.back_s;
  HumanSteering person = human(table, delays);
  HumanRigTable rig_table;
  rig_table.seed = table.seed;
  HumanRig rig(rig_table, zhu2022::table(), zhu2022::radians(zhu2022::kPrepare_deg), scene(), person);
  Crossing out;
  const auto clocked = [&](bool& done, double& duration_s, auto run) {
    const double from_s = rig.now_s();
    done = run();
    duration_s = rig.now_s() - from_s;
  };
  clocked(out.edge, out.edge_s, [&] {
    return rig.step("vr", "edge", {"vr", device::Kind::kVrControllers, {4.0, 2.0}, 3, 0.1, false}, 120.0);
  });
  rig.hold_at_zero(1u << 8);
  const arbiter::DeviceUse entry{"hand", device::Kind::kHandController, {4.0, 1.0}, 0, 0.1, false};
  clocked(out.slit, out.slit_s, [&] { return out.edge && rig.step("hand", "slit", entry, 300.0); });
  rig.hold_at_zero(1u << 6 | 1u << 8);
  const arbiter::DeviceUse fine{"hand", device::Kind::kHandController, {2.0, 1.0}, 0, 0.03, false};
  clocked(out.rod, out.rod_s, [&] { return out.slit && rig.step("hand", "rod", fine, 90.0); });
  const auto off = simulated::step_between(press_rod(), rig.true_tip());
  out.error_m = norm(off.shift_m);
  out.error_rad = norm(off.turn_rad);
  out.widest_m = rig.widest_in_slit_m();
  out.hand = person.figures().value();
  return out;
}

void report(const char* name, const Crossing& c) {
  std::vector<double> errors = c.hand.errors_m;
  std::sort(errors.begin(), errors.end());
  std::printf(
      "%s: %d %d %d in %.0f + %.0f + %.0f s, error %.2f mm %.3f deg, off plane %.1f mm, hand %.2f N, %.4f J, "
      "prediction %.2f mm median, %.1f mm worst\n",
      name, c.edge, c.slit, c.rod, c.edge_s, c.slit_s, c.rod_s, 1e3 * c.error_m, c.error_rad / kDegree,
      1e3 * c.widest_m, c.hand.peak_force_N, c.hand.min_energy_J,
      errors.empty() ? 0.0 : 1e3 * errors[errors.size() / 2], errors.empty() ? 0.0 : 1e3 * errors.back());
}

TEST(HumanSession, CrossesTheSlitWithForceAndWithout) {
  for (const bool feels : {true, false}) {
    HumanTable table;
    if (!feels) table.feedback = "off";
    const Crossing c = cross(table);
    report(feels ? "aligned" : "off", c);
    EXPECT_TRUE(c.rod);
    EXPECT_LT(c.error_m, 0.0015);
    EXPECT_LT(c.widest_m, 0.010);
    EXPECT_GT(c.hand.min_energy_J, -0.1);
  }
}

TEST(HumanSession, CrossesTheSlitBehindASecondOfDelay) {
  const Crossing c = cross({}, {0.5, 0.5});
  report("0.5 + 0.5 s", c);
  EXPECT_TRUE(c.rod);
  EXPECT_LT(c.error_m, 0.0015);
  EXPECT_LT(c.widest_m, 0.012);
  EXPECT_GT(c.hand.min_energy_J, -0.1);
}

TEST(HumanSession, ALivelyOneCrossesTheSlitOfAnArmThatObeysAlsoBehindASecondOfDelay) {
  for (std::uint64_t seed = 3 - rounds(std::uint64_t{2}); seed <= 2; ++seed) {
    const double delay_s = seed % 2 == 0 ? 0.5 : 0.0;
    const Crossing c = cross({.seed = seed, .temper = simulated::Temper::kLively}, {delay_s, delay_s});
    report(delay_s > 0.0 ? "lively, 0.5 + 0.5 s" : "lively", c);
    EXPECT_TRUE(c.edge && c.slit && c.rod) << seed;
    EXPECT_LT(c.error_m, 0.003) << seed;
  }
}

TEST(HumanSession, ALivelyOneHoldsBothDevicesAtTimes) {
  HumanSession session({.temper = simulated::Temper::kLively}, robot(), scene());
  for (const char* device : {"vr", "hand"}) {
    const Json step{{"index", 1}, {"name", device}, {"device", device}, {"task", "slit"}, {"entry", 1}};
    const std::vector<double> origin{0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0}, angles(10, 0.0);
    std::size_t aside = 0, intervals = 0;
    for (int k = 1; k <= 3000; ++k) {
      const double now_s = (device[0] == 'v' ? 0.0 : 100.0) + 0.02 * k;
      const Json state{{"time_s", now_s},       {"step", step},          {"device", device},
                       {"setpoint_cp", origin}, {"measured_cp", origin}, {"measured_js_deg", angles}};
      session.hear({state, {}, std::nullopt}, now_s);
      const auto answer = session.act(now_s + 0.02);
      for (const device::Sample& sample : answer.aside) EXPECT_TRUE(sample.deadman);
      aside += answer.aside.size();
      intervals += answer.aside.empty() ? 0 : 1;
    }
    EXPECT_GT(intervals, 50u) << device;
    EXPECT_LT(intervals, 1500u) << device;
    EXPECT_NEAR(static_cast<double>(aside), static_cast<double>(intervals) * (device[0] == 'v' ? 20.0 : 4.0),
                0.1 * static_cast<double>(aside));
  }
}

TEST(HumanSession, RepeatsByTheSameSeedToTheLastSample) {
  const auto first_minute = [](std::uint64_t seed, simulated::Temper temper = simulated::Temper::kGentle) {
    HumanTable table;
    table.seed = seed;
    table.temper = temper;
    HumanSteering person = human(table, {0.1, 0.1});
    HumanRig rig({}, zhu2022::table(), zhu2022::radians(zhu2022::kPrepare_deg), scene(), person);
    rig.step("vr", "edge", {"vr", device::Kind::kVrControllers, {4.0, 2.0}, 3, 0.1, false}, 20.0);
    return rig.arm().theta_rad();
  };
  EXPECT_EQ(first_minute(3), first_minute(3));
  EXPECT_NE(first_minute(3), first_minute(4));
  const auto lively = simulated::Temper::kLively;
  EXPECT_EQ(first_minute(3, lively), first_minute(3, lively));
  EXPECT_NE(first_minute(3, lively), first_minute(3));
}

TEST(HumanSession, StatesOfAnotherRobotAndOnesWithoutAPoseAreRefusedByName) {
  HumanSession session({}, robot(), scene());
  const Json step{{"index", 1}, {"name", "a"}, {"device", "hand"}, {"task", "slit"}, {"entry", 1}};
  const Json no_pose{{"time_s", 1.0}, {"step", step}, {"device", "hand"}};
  try {
    session.hear({no_pose, {}, std::nullopt}, 1.0);
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("setpoint_cp"), std::string::npos);
  }
}

TEST(HumanSession, DoesNothingInStepsThatAreNotForItsDevices) {
  HumanSession session({}, robot(), scene());
  const Json step{{"index", 1}, {"name", "a"}, {"device", "none"}, {"task", ""}, {"entry", 1}};
  session.hear({{{"time_s", 1.0}, {"step", step}, {"device", "none"}}, {}, std::nullopt}, 1.0);
  EXPECT_TRUE(session.act(1.02).samples.empty());
}

}  // namespace
}  // namespace liana::test
