// What is at the tip: the camera that sees the target late, with noise and bias, and the end effector.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "hil/payload/grapple.hpp"
#include "hil/payload/target_camera.hpp"

namespace liana::bench {
namespace {

constexpr CameraConfig kCamera{.rate_hz = 10.0,
                               .latency_s = 0.2,
                               .noise_m = 0.002,
                               .noise_rad = 0.2 * 0.017453292519943295,
                               .range_m = 4.0,
                               .bias_m = 0.0003,
                               .bias_rad = 0.1 * 0.017453292519943295,
                               .dropout = 0.05};
const Pose kTarget{{0.01, 0.02, 0.6}, {}};

std::vector<TargetView> pictures(TargetCamera& camera, double seconds) {
  std::vector<TargetView> views;
  for (double now_s = 0.0; now_s < seconds; now_s += 0.004) {
    camera.look(now_s, {}, kTarget);
    while (const auto view = camera.deliver(now_s)) views.push_back(*view);
  }
  return views;
}

// req:B9
TEST(TargetCamera, TenTimesASecondLateByAFifthWithTheNoiseBiasAndDropoutsThatAreStated) {
  TargetCamera camera(kCamera, Lens::kGrapple, true, 5);
  const std::vector<TargetView> views = pictures(camera, 400.0);
  EXPECT_NEAR(static_cast<double>(views.size()), 3998.0, 2.0);
  Vec3 mean;
  double squares = 0.0, turn = 0.0;
  int seen = 0;
  for (const TargetView& view : views) {
    if (!view.target) continue;
    const Vec3 off = view.target->position_m - kTarget.position_m;
    mean = mean + off;
    squares += off.x * off.x;
    turn += angle_of(view.target->attitude);
    ++seen;
  }
  EXPECT_NEAR(1.0 - seen / static_cast<double>(views.size()), 0.05, 0.015);
  EXPECT_NEAR(norm((1.0 / seen) * mean), 0.0003, 0.0001);
  EXPECT_NEAR(std::sqrt(squares / seen), 0.002, 0.0002);
  EXPECT_NEAR(turn / seen / 0.017453292519943295, 0.2 * 1.6, 0.05) << "mean length of three normal numbers";
}

TEST(TargetCamera, APictureComesWhenItsLatencyHasPassed) {
  TargetCamera camera(kCamera, Lens::kGrapple, false, 1);
  camera.look(0.0, {}, kTarget);
  EXPECT_FALSE(camera.deliver(0.196));
  EXPECT_TRUE(camera.deliver(0.2));
}

TEST(TargetCamera, TheOtherLensHasItsOwnNameAndBiasAndTakesASecondToChange) {
  CameraConfig exact = kCamera;
  exact.noise_m = exact.noise_rad = exact.dropout = 0.0;
  TargetCamera camera(exact, Lens::kGrapple, true, 3);
  const Vec3 first = pictures(camera, 1.0).back().target->position_m;
  camera.use(Lens::kAdapter, 1.0);
  for (double now_s = 1.0; now_s < 1.99; now_s += 0.004) camera.look(now_s, {}, kTarget);
  while (const auto view = camera.deliver(2.0)) EXPECT_EQ(view->lens, Lens::kGrapple) << "pictures from before";
  camera.look(2.1, {}, kTarget);
  const auto view = camera.deliver(3.0);
  ASSERT_TRUE(view);
  EXPECT_EQ(view->lens, Lens::kAdapter);
  EXPECT_NEAR(norm(view->target->position_m - kTarget.position_m), 0.0003, 1e-9);
  EXPECT_GT(norm(view->target->position_m - first), 1e-6);
  const auto message = nlohmann::json::parse(target_message(*view));
  EXPECT_EQ(message["op"], "camera");
  EXPECT_EQ(message["target_name"], "adapter");
  ASSERT_EQ(message["target"].size(), 7U);
  EXPECT_EQ(message["target"][2], view->target->position_m.z);
}

// req:B26
TEST(TargetCamera, ALostTargetIsAPictureThatShowsNothing) {
  TargetCamera camera(kCamera, Lens::kGrapple, false, 1);
  CameraDefects defects;
  defects.lost = true;
  camera.suffer(defects);
  const std::vector<TargetView> views = pictures(camera, 2.0);
  ASSERT_GT(views.size(), 15U);
  for (const TargetView& view : views) EXPECT_FALSE(view.target);
  EXPECT_TRUE(nlohmann::json::parse(target_message(views[0]))["target"].is_null());
}

TEST(TargetCamera, FartherAwayThanItsRangeNothingIsSeen) {
  TargetCamera camera(kCamera, Lens::kGrapple, false, 1);
  camera.look(0.0, {}, {{0.0, 0.0, 4.1}, {}});
  EXPECT_FALSE(camera.deliver(1.0)->target);
}

constexpr GrappleObservation kNear{.grapple_in_tip = {{0.003, 0.0, 0.005}, {}}};

// req:B6
TEST(Grapple, ClosesInThreeSecondsOnAPayloadWithinReach) {
  Grapple grapple;
  grapple.ask({4, "grapple", 1.0});
  EXPECT_FALSE(grapple.act(0.9, kNear));
  EXPECT_EQ(grapple.act(1.0, kNear)->phase, "acting");
  EXPECT_FALSE(grapple.act(3.9, kNear));
  const auto done = grapple.act(4.0, kNear);
  ASSERT_TRUE(done);
  EXPECT_EQ(done->phase, "done");
  EXPECT_EQ(done->number, 4);
  EXPECT_FALSE(grapple.act(4.1, kNear));
}

struct Failing {
  const char* command;
  GrappleObservation sight;
  const char* word;
};

TEST(Grapple, WhatCannotBeSaysWhy) {
  const Quat tilted = from_rotation_vector({0.05, 0.0, 0.0});
  const Failing cases[] = {
      {"grapple", {.grapple_in_tip = {{0.0, 0.0, 0.03}, {}}}, "30 mm"},
      {"grapple", {.grapple_in_tip = {{}, tilted}}, "2.9 deg"},
      {"grapple", {.has_payload = true}, "on the arm already"},
      {"release", {}, "no payload"},
      {"release", {.has_payload = true}, "not locked"},
      {"repair", {}, "grapple and release"},
  };
  for (const Failing& one : cases) {
    Grapple grapple;
    grapple.ask({1, one.command, 0.0});
    const auto report = grapple.act(0.0, one.sight);
    ASSERT_TRUE(report) << one.word;
    EXPECT_EQ(report->phase, "failed");
    EXPECT_NE(report->reason.find(one.word), std::string::npos) << report->reason;
  }
}

TEST(Grapple, APayloadThatMovesAwayMeanwhileIsNotTaken) {
  Grapple grapple;
  grapple.ask({1, "grapple", 0.0});
  grapple.act(0.0, kNear);
  EXPECT_EQ(grapple.act(1.0, {.grapple_in_tip = {{0.0, 0.1, 0.0}, {}}})->phase, "failed");
}

TEST(Grapple, JammedItFailsHalfWayAndSilentItHearsNothing) {
  Grapple jammed, silent;
  jammed.suffer({.jams = true});
  jammed.ask({1, "grapple", 0.0});
  jammed.act(0.0, kNear);
  EXPECT_EQ(jammed.act(1.6, kNear)->phase, "failed");
  silent.suffer({.silent = true});
  silent.ask({1, "grapple", 0.0});
  EXPECT_FALSE(silent.act(5.0, kNear));
}

}  // namespace
}  // namespace liana::bench
