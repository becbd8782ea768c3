// The prediction on the hand's side against the arm's own clutch and motion (req:A18).
#include "host/operator/station/tip_prediction.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/firmware_like/zhu2022.hpp"
#include "tests/host/operator/simulated/led_arm.hpp"

namespace liana::test {
namespace {

namespace zhu2022 = cable::zhu2022;

device::Sample hand_at(std::int64_t t_us, const Vec3& position_m, bool held) {
  return {.t_us = t_us, .deadman = held, .pose = {position_m, {1.0, 0.0, 0.0, 0.0}}};
}

// 20 samples of a hand that moves evenly, held from half a second on.
std::vector<device::Sample> interval_of(int k, const Vec3& speed_m_s) {
  std::vector<device::Sample> samples;
  for (int i = 1; i <= 20; ++i) {
    const double t_s = 0.02 * k + 0.001 * i;
    samples.push_back(
        hand_at(std::llround(1e6 * t_s), scale(speed_m_s, std::max(0.0, t_s - 0.6)), t_s > 0.5 && t_s < 3.0));
  }
  return samples;
}

TEST(TipPrediction, IsTheArmsOwnWayWhereNoJointSlowsItDown) {
  const cable::RobotParams robot = zhu2022::table();
  const arbiter::DeviceUse use{"hand", device::Kind::kHandController, {2.0, 1.0}, 0, 0.1, false};
  for (const Vec3& speed_m_s : {Vec3{0.01, 0.0, 0.0}, Vec3{0.0, 0.01, 0.01}, Vec3{-0.005, 0.0, 0.008}}) {
    LedArm arm(robot, zhu2022::radians(zhu2022::kPanelEdge_deg));
    arm.use(use);
    station::TipPrediction prediction(robot, {});
    prediction.begin(use, arm.tip());
    double worst_m = 0.0, moved_m = 0.0;
    const Pose start = arm.tip();
    for (int k = 0; k < 250; ++k) {
      const auto samples = interval_of(k, speed_m_s);
      for (const device::Sample& sample : samples) prediction.add(sample);
      prediction.finish_interval();
      arm.interval(samples);
      worst_m = std::max(worst_m, norm(subtract(prediction.tip().position_m, arm.tip().position_m)));
      moved_m = std::max(moved_m, norm(subtract(arm.tip().position_m, start.position_m)));
    }
    EXPECT_GT(moved_m, 0.02);
    EXPECT_LT(worst_m, 0.0015);  // the arm's stop is that of its joints
    EXPECT_FALSE(prediction.engaged());
  }
}

TEST(TipPrediction, StandsWhereTheArmWasTold) {
  station::TipPrediction prediction(zhu2022::table(), {});
  prediction.begin({}, {{1.0, 2.0, 3.0}, {1.0, 0.0, 0.0, 0.0}});
  prediction.stand_at({{1.1, 2.0, 3.0}, {1.0, 0.0, 0.0, 0.0}});
  for (int k = 0; k < 10; ++k) prediction.finish_interval();
  EXPECT_EQ(prediction.tip().position_m, (Vec3{1.1, 2.0, 3.0}));
  EXPECT_EQ(prediction.goal().position_m, (Vec3{1.1, 2.0, 3.0}));
}

}  // namespace
}  // namespace liana::test
