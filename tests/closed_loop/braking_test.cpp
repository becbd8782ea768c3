// A command that expires in motion, as after a refusal: the arm brakes as gently as it moved, whatever it was doing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "arm_under_control.hpp"
#include "firmware_like/math/trig.hpp"
#include "fixture.hpp"

namespace liana::closed_loop {

using namespace cable;

namespace {

constexpr double kTick_s = 0.004;
constexpr double kSettle_s = 3.0;
constexpr double kStop_s = 3.0;
constexpr std::uint32_t kHeldPitch = 0x100;  // X5 of the mission

// What to ask for while the arm stands at `start`, at a share of the time.
using Ask = std::function<Setpoint(const cable::Outputs& now, double share)>;

struct Motion {
  const char* name;
  const char* pose;
  Ask ask;
  std::vector<double> cut_after_s;
};

Setpoint tip_at_goal(const cable::Outputs& now) {
  Setpoint setpoint;
  setpoint.kind = CommandKind::kTip;
  setpoint.tip_in_base = now.tip_goal;
  setpoint.tip_speed_m_s = 0.1;
  return setpoint;
}

// The tip goes on with this velocity: the target leads by the filter's lag.
Setpoint tip_along(const cable::Outputs& now, const Vec3& velocity_m_s, std::uint32_t held_mask) {
  constexpr double kLag_s = 0.75;
  Setpoint setpoint = tip_at_goal(now);
  setpoint.tip_in_base.position_m = add(setpoint.tip_in_base.position_m, scale(velocity_m_s, kLag_s));
  setpoint.tip_speed_m_s = norm(velocity_m_s);
  setpoint.held_mask = held_mask;
  return setpoint;
}

Setpoint going_planar(const cable::Outputs& now, double) {
  Setpoint setpoint = tip_at_goal(now);
  setpoint.held_mask = kHeldPitch;
  return setpoint;
}

Setpoint tip_and_node(const cable::Outputs& now, double) {
  Setpoint setpoint = tip_along(now, {-0.045, -0.045, 0.0}, 0);
  setpoint.node[0] = {3, add(now.node_command_m[2], {0.0, 0.1, 0.1}), 1.0, 0.001};
  return setpoint;
}

struct Stop {
  double least_N = 1e9;
  double rest_s = 0.0;
  double joint_accel_deg_s2 = 0.0;
  std::int32_t faults = 0;
};

Stop stop_of(ArmUnderControl& arm) {
  Stop stop;
  ThetaVector rate = arm.outputs().theta_rate_rad_s;
  arm.plant().take_load();
  for (double t_s = 0.0; t_s < kStop_s; t_s += kTick_s) {
    arm.step();
    const ThetaVector& now = arm.outputs().theta_rate_rad_s;
    for (std::size_t k = 0; k < now.size(); ++k)
      stop.joint_accel_deg_s2 = std::max(stop.joint_accel_deg_s2, std::fabs(now[k] - rate[k]) / kTick_s / kDegree);
    rate = now;
    if (arm.outputs().at_rest == 0) stop.rest_s = t_s;
  }
  stop.least_N = arm.plant().take_load().min_motor_N;
  stop.faults = arm.outputs().faults.count;
  return stop;
}

class Braking : public ::testing::TestWithParam<Motion> {};

TEST_P(Braking, KeepsEveryCableTautAndEndsSoonAfterTheLastCommand) {
  const Motion& motion = GetParam();
  Stop worst;
  for (const std::uint64_t seed : {1u, 2u}) {
    for (const double cut_s : motion.cut_after_s) {
      ArmUnderControl arm({"nominal", seed, true, motion.pose});
      arm.boot();
      arm.move_joints(named_pose_rad(motion.pose), kSettle_s);
      arm.hold(1.0);
      arm.follow(cut_s, [&](double share) { return motion.ask(arm.outputs(), share); });
      ASSERT_EQ(arm.outputs().at_rest, 0) << "there is something to brake";
      const Stop stop = stop_of(arm);
      worst.least_N = std::min(worst.least_N, stop.least_N);
      worst.rest_s = std::max(worst.rest_s, stop.rest_s);
      worst.joint_accel_deg_s2 = std::max(worst.joint_accel_deg_s2, stop.joint_accel_deg_s2);
      worst.faults = std::max(worst.faults, stop.faults);
    }
  }
  const std::string name = motion.name;
  measured(name + ", stop: least tension at a motor", worst.least_N, "N");
  measured(name + ", stop: time to rest", worst.rest_s, "s");
  measured(name + ", stop: largest joint acceleration", worst.joint_accel_deg_s2, "deg/s2");
  EXPECT_EQ(worst.faults, 0);
  EXPECT_GE(worst.least_N, 15.0);
  EXPECT_LE(worst.rest_s, 0.9) << "full speed takes 0.45 s to brake and the jerk limit 0.09 s";
  EXPECT_LT(worst.joint_accel_deg_s2, 3.9) << "no joint is thrown against its limit of 4";
}

// A pitch on its way into the plane while the others keep the tip where it is, both early and at full speed.
const Motion kGoingPlanar{"going planar", "prepare", going_planar, {0.4, 0.9, 2.0}};
const Motion kFreeTip{"free tip at 0.1 m/s",
                      "prepare",
                      [](const cable::Outputs& now, double) {
                        return tip_along(now, {-0.06, -0.06, 0.0529}, 0);
                      },
                      {3.0}};
const Motion kTipAndNode{"tip and node", "prepare", tip_and_node, {3.0}};
const Motion kInSlit{"in the slit at 0.03 m/s",
                     "segment5_in_slit",
                     [](const cable::Outputs& now, double) {
                       return tip_along(now, {0.03, 0.0, 0.0}, kHeldPitch);
                     },
                     {3.0}};
const Motion kJoints{"joints",
                     "prepare",
                     [](const cable::Outputs&, double share) {
                       const ThetaVector from = named_pose_rad("prepare"), to = named_pose_rad("panel_edge");
                       Setpoint setpoint;
                       setpoint.kind = CommandKind::kJoint;
                       const double way = minimum_jerk(0.3 * share);  // of 20 s
                       for (std::size_t i = 0; i < from.size(); ++i)
                         setpoint.joint_rad[i] = from[i] + way * (to[i] - from[i]);
                       return setpoint;
                     },
                     {15.0}};

INSTANTIATE_TEST_SUITE_P(In, Braking, ::testing::Values(kGoingPlanar, kFreeTip, kTipAndNode, kInSlit, kJoints));

}  // namespace
}  // namespace liana::closed_loop
