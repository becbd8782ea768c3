// From every way of being led to every other, at random instants: the real arbiter and core, closed over ideal drives.
// Whatever is switched, clutched, re-indexed, lost or back again, the command goes on within the robot table's bounds.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <random>
#include <string>

#include "host/control/arbiter/cable_arbiter.hpp"
#include "tests/firmware_like/ideal_drives.hpp"
#include "tests/firmware_like/panel_slit.hpp"
#include "tests/rounds.hpp"

namespace liana::arbiter {
namespace {

using namespace cable;

constexpr std::uint32_t kSlowing = kLimitTheta | kLimitThetaRate | kLimitThetaAccel | kLimitCableSpeed;
constexpr std::uint32_t kX4 = 1u << 6, kX5 = 1u << 8;

// A way of being led, as steps of missions choose it.
struct Mode {
  const char* name;
  device::Kind device;
  std::uint32_t held_mask;
  bool fixtures;
  double scale;
  bool line;  // a planned line begins
};
constexpr std::array kModes{
    Mode{"nobody", device::Kind::kNone, 0, true, 1.0, false},
    Mode{"a line", device::Kind::kNone, kX4 | kX5, true, 1.0, true},
    Mode{"vr, 10+0", device::Kind::kVrControllers, 0, true, 4.0, false},
    Mode{"hand, 10+0", device::Kind::kHandController, 0, true, 1.0, false},
    Mode{"hand, 9+1", device::Kind::kHandController, kX5, true, 1.0, false},
    Mode{"hand, 8+2", device::Kind::kHandController, kX4 | kX5, true, 0.5, false},
    Mode{"hand, 8+2, coarse", device::Kind::kHandController, kX4 | kX5, true, 4.0, false},
    Mode{"hand, 8+2, no fixtures", device::Kind::kHandController, kX4 | kX5, false, 1.0, false}};

std::vector<config::SceneFixture> slit_plane() {
  const inverse_kinematics::SlitMouth mouth = panel_slit();
  config::SceneFixture plane{"slit_plane",
                             config::FixtureKind::kPlane,
                             {mouth.frame_in_base.position_m, mouth.frame_in_base.quaternion},
                             mouth.depth_m,
                             2.0,
                             0.05};
  return {plane};
}

// The largest changes from tick to tick since the start.
struct Steps {
  double joint_rad_s = 0.0, joint_rad_s2 = 0.0;
  double target_m_s = 0.0, target_m_s2 = 0.0;
  double slowed_m_s2 = 0.0;  // of the target while the core takes a share of its motion only, for the joints' sake
  double payout_m_s = 0.0;
};

// A hand that does at random what hands do, on an arm near the press rod.
class LedArm {
 public:
  explicit LedArm(std::uint64_t seed)
      : random_(seed),
        rig_(zhu2022::radians(zhu2022::kPressRod_deg)),
        arbiter_(rig_.robot, {}, SearchResult::kInItsInterval, {},
                 virtual_fixtures::Guidance(rig_.robot, slit_plane(), 0.03)) {
    rig_.enable();
    home_m_ = rig_.out.tip_command.position_m;
    before_ = rig_.out;
  }

  void switch_to(const Mode& mode) {
    if (arbiter_.is_busy()) arbiter_.hold();
    DeviceUse use;
    use.name = device::kind_name(mode.device);
    use.kind = mode.device;
    use.mapping.scale = mode.scale;
    use.speed_m_s = 0.03;
    use.anywhere = true;
    scale_ = mode.scale;
    if (mode.scale != arbiter_.device().in_use().mapping.scale) arbiter_.use_device(rig_.out, {});  // or it is refused
    arbiter_.use_device(rig_.out, use);
    arbiter_.choose_fixtures(mode.fixtures ? virtual_fixtures::Choice{}
                                           : virtual_fixtures::Choice{std::vector<std::string>{}});
    arbiter_.hold_theta(rig_.out, mode.held_mask, {});
    if (mode.line) {
      Pose goal = rig_.out.tip_command;
      goal.position_m = add(goal.position_m, within(0.01));
      arbiter_.move_line(rig_.out, goal);
    }
  }
  // What a hand does beside steering: 0 to 4.
  void happen(int what) {
    if (what == 0) pressed_ = !pressed_;                                       // clutch
    if (what == 1) lost_intervals_ = 5 + 5 * static_cast<int>(random_() % 4);  // tracking lost, shorter and longer
    if (what == 2) silent_intervals_ = 10;                                     // dropout
    if (what == 3) hand_.position_m = add(hand_.position_m, within(0.5));      // the tracker jumps
    if (what == 4) reindex_intervals_ = 6;                                     // lets go, comes back, grips
    if (what != 0) pressed_ = true;
  }
  void run(int intervals) {
    for (int i = 0; i < intervals; ++i) interval();
  }
  const Steps& steps() const { return steps_; }
  bool is_engaged() const { return arbiter_.device().engaged(); }
  double from_home_m() const { return norm(subtract(rig_.out.tip_command.position_m, home_m_)); }
  const Rig& rig() const { return rig_; }

 private:
  double one() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random_); }
  Vec3 within(double size) {
    const double x = one(), y = one(), z = one();
    return {size * x, size * y, size * z};
  }

  // A drift that leads the tip home again, and some noise: out of the slit's plane, too.
  void move_hand() {
    const Vec3 home = subtract(home_m_, rig_.out.tip_command.position_m);
    way_m_ = add(scale(way_m_, 0.95), add(within(1.5e-4), scale(home, 0.01 / scale_)));
    turn_rad_ = add(scale(turn_rad_, 0.95), within(2e-4));
    hand_.position_m = add(hand_.position_m, scale(way_m_, 0.1));
    hand_.quaternion = normalize(multiply(quaternion_of(scale(turn_rad_, 0.1)), hand_.quaternion));
  }

  void feel_hand() {
    const bool is_open = reindex_intervals_ > 0 && reindex_intervals_-- > 0;
    if (is_open) hand_.position_m = scale(hand_.position_m, 0.8);
    const bool is_lost = lost_intervals_ > 0 && lost_intervals_-- > 0;
    if (silent_intervals_ > 0 && silent_intervals_-- > 0) return void(t_us_ += 20000);
    for (int i = 0; i < 10; ++i) {
      move_hand();
      arbiter_.device().add({.t_us = t_us_ += 2000, .valid = !is_lost, .deadman = pressed_ && !is_open, .pose = hand_});
    }
  }

  void interval() {
    feel_hand();
    const std::optional<Setpoint> setpoint = arbiter_.next_setpoint(rig_.now - 1, rig_.out);
    look(rig_.tick(Request::kNone, setpoint ? rig_.release(*setpoint, 5) : cable::Telecommand{}));
    for (int i = 1; i < 5; ++i) look(rig_.tick());
  }

  void look(const cable::Outputs& out) {
    const double h = rig_.robot.tick_s;
    for (std::size_t k = 0; k < zhu2022::kThetas; ++k) {
      const double rate = (out.theta_command_rad[k] - before_.theta_command_rad[k]) / h;
      steps_.joint_rad_s = std::max(steps_.joint_rad_s, std::fabs(rate));
      steps_.joint_rad_s2 = std::max(steps_.joint_rad_s2, std::fabs(rate - rate_rad_s_[k]) / h);
      rate_rad_s_[k] = rate;
    }
    for (std::size_t c = 0; c < zhu2022::kCables; ++c)
      steps_.payout_m_s =
          std::max(steps_.payout_m_s, std::fabs(out.payout_command_m[c] - before_.payout_command_m[c]) / h);
    const Vec3 speed = scale(subtract(out.tip_goal.position_m, before_.tip_goal.position_m), 1.0 / h);
    const Vec3 accel = scale(subtract(speed, speed_m_s_), 1.0 / h);
    steps_.target_m_s = std::max(steps_.target_m_s, norm(speed));
    since_slowed_ = (out.limits & kSlowing) != 0 ? 0 : since_slowed_ + 1;
    double& largest_m_s2 = since_slowed_ > 2 ? steps_.target_m_s2 : steps_.slowed_m_s2;
    largest_m_s2 = std::max(largest_m_s2, norm(accel));
    speed_m_s_ = speed;
    before_ = out;
  }

  std::mt19937_64 random_;
  Rig rig_;
  CableArbiter arbiter_;
  Vec3 home_m_{};
  Pose hand_{};
  Vec3 way_m_{}, turn_rad_{};
  double scale_ = 1.0;
  bool pressed_ = true;
  int lost_intervals_ = 0, silent_intervals_ = 0, reindex_intervals_ = 0;
  std::int64_t t_us_ = 0;
  cable::Outputs before_{};
  ThetaVector rate_rad_s_{};
  Vec3 speed_m_s_{};
  int since_slowed_ = 0;
  Steps steps_;
};

// req:A38
TEST(Continuity, NoStepFromAnyModeToAnyOtherAtAThousandRandomInstants) {
  std::mt19937_64 random(7);
  LedArm arm(7);
  int engaged = 0;
  double farthest_m = 0.0;
  for (std::size_t instant = 0; instant < rounds(std::size_t{1024}); ++instant) {  // every pair of modes sixteen times
    const std::size_t pair = instant % (kModes.size() * kModes.size());
    arm.switch_to(kModes[pair / kModes.size()]);
    arm.run(5 + static_cast<int>(random() % 20));
    arm.happen(static_cast<int>(random() % 5));
    arm.run(5 + static_cast<int>(random() % 20));
    engaged += arm.is_engaged() ? 1 : 0;
    farthest_m = std::max(farthest_m, arm.from_home_m());
    arm.switch_to(kModes[pair % kModes.size()]);
    arm.run(5 + static_cast<int>(random() % 20));
    ASSERT_EQ(arm.rig().out.faults.count, 0) << instant;
  }
  const MotionLimits& limits = arm.rig().robot.limits;
  const Steps& steps = arm.steps();
  std::printf(
      "  measured: joints %.3f of %.3f deg/s, %.3f of %.3f deg/s2; target %.4f m/s, %.3f of %.3f m/s2 (slowed %.3f); "
      "cables %.4f of %.4f m/s; engaged at %d instants, up to %.3f m from home\n",
      steps.joint_rad_s / kDegree, limits.theta_rate_rad_s / kDegree, steps.joint_rad_s2 / kDegree,
      limits.theta_accel_rad_s2 / kDegree, steps.target_m_s, steps.target_m_s2, limits.tip_accel_m_s2,
      steps.slowed_m_s2, steps.payout_m_s, limits.cable_speed_m_s, engaged, farthest_m);
  constexpr double kRounding = 1.0 + 1e-6;
  EXPECT_LE(steps.joint_rad_s, kRounding * limits.theta_rate_rad_s);
  EXPECT_LE(steps.joint_rad_s2, kRounding * limits.theta_accel_rad_s2);
  EXPECT_LE(steps.payout_m_s, kRounding * limits.cable_speed_m_s);
  EXPECT_LE(steps.target_m_s, 1.05 * limits.tip_speed_m_s);
  EXPECT_LE(steps.target_m_s2, 1.05 * limits.tip_accel_m_s2);
  EXPECT_GT(engaged, rounds(200)) << "or nobody has steered";
  EXPECT_GT(farthest_m, 0.01);
}

}  // namespace
}  // namespace liana::arbiter
