// The simulated person at the VR handles, with the real clutch and the arm's own motion (req:A31 req:A49).
#include "host/operator/simulated/vr_operator_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "host/model/clearance/arm_clearance.hpp"
#include "host/operator/simulated/arm_display.hpp"
#include "tests/firmware_like/zhu2022.hpp"
#include "tests/host/operator/simulated/led_arm.hpp"
#include "tests/host/operator/simulated/scene.hpp"

namespace liana::test {
namespace {

namespace zhu2022 = cable::zhu2022;
using simulated::ArmDisplay;
using simulated::ArmObservation;
using simulated::BothHands;
using simulated::VrGains;
using simulated::VrOperatorModel;

constexpr double kInterval_s = 0.02;
constexpr double kRadius_m = 0.03;
constexpr simulated::HandMapping kMapping{4.0, 2.0, 0.1};
const arbiter::DeviceUse kUse{"vr", device::Kind::kVrControllers, {4.0, 2.0}, 3, 0.1, false};

std::vector<double> degrees_of(const cable::ThetaVector& theta_rad) {
  std::vector<double> degrees;
  for (std::size_t i = 0; i < zhu2022::kThetas; ++i) degrees.push_back(theta_rad[i] / kDegree);
  return degrees;
}

// `prepare`, every angle up to half a degree off.
cable::ThetaVector near_prepare(std::uint64_t seed) {
  simulated::RandomStream random(seed, 7);
  cable::ThetaVector theta_rad = zhu2022::radians(zhu2022::kPrepare_deg);
  for (std::size_t i = 0; i < zhu2022::kThetas; ++i) theta_rad[i] += random.uniform(-0.5, 0.5) * kDegree;
  return theta_rad;
}

std::vector<device::Sample> of_both(const std::vector<BothHands>& hands) {
  std::vector<device::Sample> samples;
  for (const BothHands& both : hands) samples.insert(samples.end(), {both.right, both.left});
  return samples;
}

// The person leads the arm; what they see is the arm as it is commanded.
class Led {
 public:
  Led(const config::SceneConfig& scene, std::uint64_t seed, const VrGains& gains = {})
      : scene_(scene), arm_(zhu2022::table(), near_prepare(seed)), person_(gains, scene, seed) {
    arm_.use(kUse);
    person_.begin(kMapping, 0.0);
  }

  // One command interval; `sees` and `follows` false: the display, or the arm, is away.
  void interval(bool sees = true, bool follows = true) {
    const double to_s = now_s_ + kInterval_s;
    samples_.clear();
    for (; (static_cast<double>(taken_) + 1.0) * VrOperatorModel::kSample_s <= to_s; ++taken_)
      samples_.push_back(person_.sample((static_cast<double>(taken_) + 1.0) * VrOperatorModel::kSample_s));
    if (follows) arm_.interval(of_both(samples_));
    now_s_ = to_s;
    const ArmObservation sight = display_.picture(degrees_of(arm_.theta_rad()), 3);
    if (sees) person_.look(sight, now_s_);
    person_.feel(follows && arm_.engaged(), now_s_);
    const double room_m = clearance::arm_clearance(sight.axis_m, kRadius_m, scene_).distance_m();
    min_room_m_ = std::min(min_room_m_, room_m);
  }

  void until_arrived(double most_s) {
    while (now_s_ < most_s && !person_.arrived()) interval();
  }

  const VrOperatorModel& person() const { return person_; }
  const LedArm& arm() const { return arm_; }
  const std::vector<BothHands>& samples() const { return samples_; }
  double now_s() const { return now_s_; }
  double min_room_m() const { return min_room_m_; }

 private:
  config::SceneConfig scene_;
  LedArm arm_;
  VrOperatorModel person_;
  ArmDisplay display_{zhu2022::table(), kRadius_m};
  std::vector<BothHands> samples_;
  std::int64_t taken_ = 0;
  double now_s_ = 0.0;
  double min_room_m_ = 1e9;
};

double off_edge_m(const Led& led, const config::SceneConfig& scene) {
  return norm(subtract(simulated::panel_edge({}, scene)->position_m, led.arm().tip().position_m));
}

TEST(VrOperatorModel, LeadsTheArmRoundTheObstacleToThePanelEdge) {
  const config::SceneConfig scene = panel_scene();
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Led led(scene, seed);
    led.until_arrived(60.0);
    EXPECT_TRUE(led.person().arrived()) << seed;
    EXPECT_GT(led.min_room_m(), 0.30) << seed;
    EXPECT_LT(off_edge_m(led, scene), 0.03) << seed;
    EXPECT_LT(led.now_s(), 40.0) << seed;
  }
}

// The tip's straight way and the node's: each is blocked in turn. A sphere inside the arm's loop, or one of 0.6 m
// across beside it, is not got round yet (docs/explanation/operator-model.md).
TEST(VrOperatorModel, FindsAWayRoundASphereOnTheWaysOfTipAndNode) {
  const std::vector<config::SceneSphere> spheres{{"by the tip", {0.40, -0.90, 0.30}, 0.15},
                                                 {"on the tip's way", {0.45, -0.70, 0.60}, 0.18},
                                                 {"on the node's way", {-0.60, -1.00, 0.60}, 0.20},
                                                 {"by the root", {-0.40, 0.10, 0.70}, 0.20}};
  for (const config::SceneSphere& sphere : spheres) {
    const config::SceneConfig scene = panel_scene(sphere);
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      Led led(scene, seed);
      led.until_arrived(100.0);
      EXPECT_TRUE(led.person().arrived()) << sphere.name;
      EXPECT_GT(led.min_room_m(), 0.0) << sphere.name;
      EXPECT_LT(off_edge_m(led, scene), 0.03) << sphere.name;
    }
  }
}

// Both hands straight on, a node that only comes along: the sphere on the tip's way is hit, so the sight of it matters.
TEST(VrOperatorModel, WouldHitTheSphereOnTheTipsWayWithClosedEyesForIt) {
  config::SceneConfig unseen = panel_scene({"elsewhere", {5.0, 5.0, 5.0}, 0.1});
  const config::SceneConfig scene = panel_scene({"on the tip's way", {0.45, -0.70, 0.60}, 0.18});
  LedArm arm(zhu2022::table(), near_prepare(1));
  arm.use(kUse);
  VrOperatorModel person({}, unseen, 1);
  const ArmDisplay display(zhu2022::table(), kRadius_m);
  person.begin(kMapping, 0.0);
  double min_room_m = 1e9;
  for (int k = 1; k < 2500; ++k) {
    arm.interval(of_both({person.sample((2 * k - 1) * 0.01), person.sample(2 * k * 0.01)}));
    const ArmObservation sight = display.picture(degrees_of(arm.theta_rad()), 3);
    person.look(sight, k * kInterval_s);
    person.feel(arm.engaged(), k * kInterval_s);
    min_room_m = std::min(min_room_m, clearance::arm_clearance(sight.axis_m, kRadius_m, scene).distance_m());
  }
  EXPECT_LT(min_room_m, 0.0);
}

// req:A30
TEST(VrOperatorModel, ReindexesWithinTheReachOfItsArms) {
  VrGains gains;
  gains.hand_reach_m = 0.10;
  Led led(panel_scene(), 1, gains);
  int grips = 0, far = 0;
  bool held = false;
  while (led.now_s() < 100.0 && !led.person().arrived()) {
    led.interval();
    for (const BothHands& sample : led.samples()) {
      grips += sample.right.trigger > 0.5 && !held ? 1 : 0;
      held = sample.right.trigger > 0.5;
      far += norm(sample.right.pose.position_m) > 0.11 ? 1 : 0;
    }
  }
  EXPECT_TRUE(led.person().arrived());
  EXPECT_GT(grips, 1);
  EXPECT_LT(far, 10);  // jumps of the tracker, a sample each
}

TEST(VrOperatorModel, DoesNotGripBeforeItHasSeenTheArm) {
  Led led(panel_scene(), 1);
  for (int k = 0; k < 200; ++k) {
    led.interval(false);
    for (const BothHands& sample : led.samples()) EXPECT_EQ(sample.right.trigger, 0.0);
  }
}

TEST(VrOperatorModel, KeepsTheHandsStillWhenTheDisplayFreezes) {
  VrGains gains;
  gains.tremor_m = gains.tremor_rad = 0.0;
  Led led(panel_scene(), 1, gains);
  while (led.now_s() < 12.0) led.interval();
  while (led.now_s() < 16.0) led.interval(false);
  const BothHands before = led.samples().back();
  while (led.now_s() < 18.0) led.interval(false);
  EXPECT_EQ(before.left.pose.position_m, led.samples().back().left.pose.position_m);
  EXPECT_FALSE(led.person().arrived());
}

TEST(VrOperatorModel, LetsGoAndGripsAgainWhenTheArmDoesNotFollow) {
  Led led(panel_scene(), 1);
  int releases = 0;
  bool held = false;
  while (led.now_s() < 12.0) {
    led.interval(true, false);
    for (const BothHands& sample : led.samples()) {
      releases += held && sample.right.trigger < 0.5 ? 1 : 0;
      held = sample.right.trigger > 0.5;
    }
  }
  EXPECT_GE(releases, 2);
}

TEST(VrOperatorModel, WaitsInASceneWithoutASlit) {
  Led led(config::SceneConfig{}, 1);
  for (int k = 0; k < 200; ++k) led.interval();
  EXPECT_EQ(led.samples().back().right.trigger, 0.0);
}

TEST(VrOperatorModel, GivesTheSameHandsForTheSameSeedAndOthersForAnother) {
  const auto hands = [](std::uint64_t seed) {
    VrOperatorModel person({}, panel_scene(), seed);
    std::vector<Vec3> places;
    for (int k = 1; k < 100; ++k) places.push_back(person.sample(k * VrOperatorModel::kSample_s).right.pose.position_m);
    return places;
  };
  EXPECT_EQ(hands(3), hands(3));
  EXPECT_NE(hands(3), hands(4));
}

TEST(ArmDisplay, RefusesAnglesOfAnotherRobotAndNodesThatAreNone) {
  const ArmDisplay display(zhu2022::table(), kRadius_m);
  EXPECT_THROW(display.picture({1.0, 2.0}, 3), std::runtime_error);
  EXPECT_THROW(display.picture(std::vector<double>(10, 0.0), 6), std::runtime_error);
  const ArmObservation straight = display.picture(std::vector<double>(10, 0.0), 3);
  EXPECT_NEAR(straight.node_m()[0], 2.4, 1e-9);
  EXPECT_NEAR(straight.tip.position_m[0], 4.0, 1e-9);
}

}  // namespace
}  // namespace liana::test
