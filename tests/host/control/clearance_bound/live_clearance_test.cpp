// The verified clearance is a lower bound of the true one, and says how sure it is.
#include "host/control/clearance_bound/live_clearance.hpp"

#include <gtest/gtest.h>

#include "host/model/clearance/arm_clearance.hpp"
#include "tests/host/control/clearance_bound/true_world.hpp"
#include "tests/rounds.hpp"

namespace liana::clearance_bound {
namespace {

const ThetaVector kEdge_rad = zhu2022::radians(zhu2022::kPanelEdge_deg);
const ThetaVector kSlit_rad = zhu2022::radians(kInSlit_deg);
const ThetaVector kRod_rad = zhu2022::radians(zhu2022::kPressRod_deg);

void swallow(std::optional<Picture>& picture) { picture.reset(); }

// A minute of motion into the slit, as fast as the arm may: claims above the truth, of how many, and what was taken
// off. With a camera what is claimed before the first picture is about the drawing, and does not count.
struct Course {
  int claims = 0, above = 0;
  double mean_bound_m = 0.0, last_bound_m = 0.0;
};

using Spoil = void (*)(std::optional<Picture>&);
Course course(TrueWorld& world, Spoil spoil, const config::SceneConfig& scene = panel_slit()) {
  const bool has_camera = spoil != swallow;
  LiveClearance live(zhu2022_config(), scene);
  Course out;
  std::uint64_t tick = 0;
  const auto judge = [&](const Claim& claim, const ThetaVector& measured_rad) {
    if (has_camera && claim.confidence != Confidence::kCamera) return;
    ++out.claims;
    out.above += claim.clearance.distance_m > world.true_clearance_m(measured_rad);
    out.mean_bound_m += claim.clearance.bound_m;
  };
  travel(live, world, kEdge_rad, kSlit_rad, 2000, tick, judge, spoil);
  travel(live, world, kSlit_rad, kRod_rad, 1000, tick, judge, spoil);
  out.mean_bound_m /= out.claims;
  out.last_bound_m = live.claim().clearance.bound_m;
  return out;
}

// req:A47
TEST(LiveClearance, IsALowerBoundOfTheTruthInSeededWorlds) {
  Course all;
  for (std::uint64_t seed = 100; seed < 100 + rounds(8u); ++seed) {
    TrueWorld world(seed, {.length_m = 30e-6, .shift_m = 0.01, .turn_deg = 1.0});
    const Course one = course(world, nothing_spoiled);
    all.claims += one.claims;
    all.above += one.above;
    EXPECT_LT(one.mean_bound_m, 0.007) << seed;
  }
  EXPECT_LE(all.above, all.claims / 1000);
}

TEST(LiveClearance, IsALowerBoundWithoutACameraWhereTheSceneIsAsDrawn) {
  Course all;
  for (std::uint64_t seed = 200; seed < 200 + rounds(8u); ++seed) {
    TrueWorld world(seed, {.length_m = 30e-6});
    const Course one = course(world, swallow);
    all.claims += one.claims;
    all.above += one.above;
    EXPECT_GT(one.mean_bound_m, 0.004) << seed;
    EXPECT_LT(one.mean_bound_m, 0.012) << seed;
  }
  EXPECT_LE(all.above, all.claims / 1000);
}

TEST(LiveClearance, WithoutACameraTheScenesAllowanceIsTakenOff) {
  config::SceneConfig allowed = panel_slit();
  allowed.margins.shift_m = 0.01;
  allowed.margins.turn_deg = 1.0;
  Course all;
  for (std::uint64_t seed = 300; seed < 300 + rounds(4u); ++seed) {
    TrueWorld world(seed, {.length_m = 30e-6, .shift_m = 0.01, .turn_deg = 1.0});
    const Course one = course(world, swallow, allowed);
    all.claims += one.claims;
    all.above += one.above;
  }
  EXPECT_LE(all.above, all.claims / 1000);
}

// What a prediction goes by: the arm as it is believed to be, against bodies where they are believed to stand.
TEST(Outlook, OfADistanceThatIsFoundByItTheRestIsTrueAlsoWhereTheSceneStandsBesideItsDrawing) {
  const config::SceneConfig scene = panel_slit();
  int claims = 0, above = 0;
  double worst_m = 0.0;
  for (std::uint64_t seed = 400; seed < 400 + rounds(4u); ++seed) {
    TrueWorld world(seed, {.length_m = 30e-6, .shift_m = 0.01, .turn_deg = 1.0});
    LiveClearance live(zhu2022_config(), scene);
    std::uint64_t tick = 0;
    const auto judge = [&](const Claim& claim, const ThetaVector& measured_rad) {
      if (claim.confidence != Confidence::kCamera) return;
      const Outlook outlook = live.outlook();
      ThetaVector believed_rad = measured_rad;
      for (std::size_t i = 0; i < believed_rad.size(); ++i) believed_rad[i] += outlook.theta_off_rad[i];
      LinkPoints links = link_points(zhu2022::table(), believed_rad);
      for (Vec3& point : links.point_in_base)
        point = compose(inverse(outlook.drawing_in_base), {point, {1, 0, 0, 0}}).position_m;
      const double found_m =
          clearance::arm_clearance(links.axis(), zhu2022_config().module_radius_m, scene).distance_m();
      ++claims;
      above += found_m - outlook.prediction_m > world.true_clearance_m(measured_rad);
      worst_m = std::max(worst_m, outlook.prediction_m);
    };
    travel(live, world, kEdge_rad, kSlit_rad, 1000, tick, judge, nothing_spoiled);
    travel(live, world, kSlit_rad, kRod_rad, 500, tick, judge, nothing_spoiled);
  }
  EXPECT_GT(claims, 1000 * rounds(4));
  EXPECT_LE(above, claims / 1000);
  printf("taken off: %.1f mm at most\n", 1e3 * worst_m);
}

TEST(Outlook, UntilAPictureIsBelievedIsTheDrawingWithTheScenesOwnMargins) {
  config::SceneConfig scene = panel_slit();
  LiveClearance plain(zhu2022_config(), scene);
  plain.look(0, kSlit_rad);
  EXPECT_EQ(plain.outlook().theta_off_rad, ThetaVector{});
  EXPECT_EQ(plain.outlook().drawing_in_base.position_m, Vec3{});
  EXPECT_EQ(plain.outlook().prediction_m, scene.margins.prediction_m);
  scene.margins.shift_m = 0.004;
  LiveClearance shifted(zhu2022_config(), scene);
  shifted.look(0, kSlit_rad);
  EXPECT_DOUBLE_EQ(shifted.outlook().prediction_m, scene.margins.prediction_m + 0.004);
  scene.margins.turn_deg = 0.1;
  LiveClearance turned(zhu2022_config(), scene);
  turned.look(0, kSlit_rad);
  EXPECT_GT(turned.outlook().prediction_m, shifted.outlook().prediction_m + 0.001) << "half a metre from its frame";
}

TEST(Outlook, TakesMoreOffWhenTheCameraIsGoneAndKeepsWhereTheSceneWasSeen) {
  TrueWorld world(8, {.length_m = 30e-6, .shift_m = 0.005});
  LiveClearance live(zhu2022_config(), panel_slit());
  std::uint64_t tick = 0;
  const auto ignore = [](const Claim&, const ThetaVector&) {};
  travel(live, world, kEdge_rad, kSlit_rad, 500, tick, ignore, nothing_spoiled);
  const Outlook seen = live.outlook();
  travel(live, world, kSlit_rad, kRod_rad, 500, tick, ignore, swallow);
  EXPECT_GT(live.outlook().prediction_m, seen.prediction_m + 0.0005);
  EXPECT_EQ(live.outlook().drawing_in_base.position_m, seen.drawing_in_base.position_m);
  printf("taken off: %.1f mm with the camera, %.1f mm ten seconds after\n", 1e3 * seen.prediction_m,
         1e3 * live.outlook().prediction_m);
}

TEST(SceneRegistrationCheck, WhatSeemsToGoIsTakenOffAndWhatIsFoundInTheFirstPicturesIsNot) {
  SceneRegistrationCheck stand(0.004);
  const Vec3 tip_m{2.5, 0.3, 0.1};
  const auto seen_at = [](double x_m) { return Pose{{x_m, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}}; };
  std::uint64_t tick = 1000;
  stand.note(tick, seen_at(0.0));
  for (; tick < 1500; tick += 10) stand.note(tick, seen_at(0.010));
  EXPECT_EQ(stand.moved_m(seen_at(0.010), tip_m), 0.0) << "found within two seconds";
  for (; tick < 2500; tick += 10) stand.note(tick, seen_at(0.010));
  EXPECT_EQ(stand.moved_m(seen_at(0.0109), tip_m), 0.0);
  EXPECT_NEAR(stand.moved_m(seen_at(0.015), tip_m), 0.004, 1e-12);
  const Pose turned{{0.010, 0.0, 0.0}, quaternion_of({0.0, 0.0, 0.002})};
  EXPECT_NEAR(stand.moved_m(turned, tip_m), 0.004, 0.0001) << "two and a half metres from what it turns about";
  for (; tick < 14000; tick += 10) stand.note(tick, seen_at(0.015));
  EXPECT_EQ(stand.moved_m(seen_at(0.015), tip_m), 0.0) << "it has stood there for forty seconds";
}

// A mirror shows an arm in the middle almost what is there: each picture fits, and the scene seems to follow the arm.
TEST(Outlook, LeavesASceneThatSeemsToFollowTheArmWhereItWas) {
  TrueWorld world(13, {.length_m = 30e-6});
  LiveClearance live(zhu2022_config(), panel_slit());
  std::uint64_t tick = 0;
  const auto ignore = [](const Claim&, const ThetaVector&) {};
  travel(live, world, kSlit_rad, kSlit_rad, 200, tick, ignore, nothing_spoiled);
  const Vec3 pivot_m = panel_slit().slit->frame.position_m, shift_m = live.shift_m();
  const auto gone_m = [&](const Vec3& now_m) { return norm(subtract(now_m, shift_m)); };
  Vec3 drift_m{};
  const auto drifting = [&](std::optional<Picture>& picture) {
    drift_m[1] += 2e-5;
    for (auto* frame : {&picture->slit_in_tip, &picture->rod_in_tip})
      if (*frame) (*frame)->position_m = add((*frame)->position_m, drift_m);
  };
  travel(live, world, kSlit_rad, kSlit_rad, 1000, tick, ignore, drifting);
  ASSERT_EQ(live.claim().trouble, CameraStatus::kNone) << "each picture fits the one before";
  ASSERT_GT(gone_m(live.shift_m()), 0.003);
  const Pose stands = live.outlook().drawing_in_base;
  const Vec3 judged_m = subtract(compose(stands, {pivot_m, {1.0, 0.0, 0.0, 0.0}}).position_m, pivot_m);
  EXPECT_LT(gone_m(judged_m), 0.5 * gone_m(live.shift_m()));
  EXPECT_EQ(live.outlook().theta_off_rad, ThetaVector{});
}

TEST(LiveClearance, KnowsMoreWithACameraThanWithout) {
  TrueWorld seen(7, {.length_m = 30e-6}), unseen(7, {.length_m = 30e-6});
  EXPECT_LT(course(seen, nothing_spoiled).last_bound_m, 0.8 * course(unseen, swallow).last_bound_m);
}

TEST(LiveClearance, SaysHowSureItIsAndTheBoundGrowsWhenTheCameraIsGone) {
  TrueWorld world(8, {.length_m = 30e-6, .shift_m = 0.005});
  LiveClearance live(zhu2022_config(), panel_slit());
  std::uint64_t tick = 0;
  const auto ignore = [](const Claim&, const ThetaVector&) {};
  EXPECT_EQ(live.look(tick, kSlit_rad).confidence, Confidence::kMeasured);
  EXPECT_FALSE(live.claim().picture_age_s);
  tick += 5;
  travel(live, world, kSlit_rad, kSlit_rad, 100, tick, ignore, nothing_spoiled);
  EXPECT_EQ(live.claim().confidence, Confidence::kCamera);
  EXPECT_EQ(live.claim().trouble, CameraStatus::kNone);
  const double with_m = live.claim().clearance.bound_m;
  const Vec3 shift_m = live.shift_m();
  travel(live, world, kSlit_rad, kSlit_rad, 50, tick, ignore, swallow);
  EXPECT_EQ(live.claim().confidence, Confidence::kCameraLost);
  EXPECT_EQ(live.claim().trouble, CameraStatus::kNoPicture);
  EXPECT_GT(*live.claim().picture_age_s, 1.0);
  const double soon_m = live.claim().clearance.bound_m;
  EXPECT_GT(soon_m, with_m);
  travel(live, world, kSlit_rad, kSlit_rad, 200, tick, ignore, swallow);
  EXPECT_GT(live.claim().clearance.bound_m, soon_m);
  EXPECT_EQ(live.shift_m(), shift_m);
}

TEST(LiveClearance, NamesLinkBodyAndPlace) {
  LiveClearance live(zhu2022_config(), panel_slit());
  const Claim& claim = live.look(0, kRod_rad);
  EXPECT_EQ(claim.clearance.link, 21);  // the module that enters the mouth: 8.3 mm off the plane
  EXPECT_TRUE(live.body_name() == "panel" || live.body_name() == "wall") << live.body_name();
  EXPECT_NEAR(dot(panel_slit().slit->u_axis, claim.clearance.where_m), 1.75, 0.1);
  EXPECT_NEAR(claim.clearance.distance_m + claim.clearance.bound_m, 0.009, 1e-3);
}

// req:A47
TEST(LiveClearance, LevelsFollowTheScenesMargins) {
  config::SceneConfig scene = panel_slit();
  LiveClearance plain(zhu2022_config(), scene);
  const double distance_m = plain.look(0, kRod_rad).clearance.distance_m;
  const auto level = [&](double slow_m, double refuse_m) {
    scene.margins.slow_m = slow_m;
    scene.margins.refuse_m = refuse_m;
    LiveClearance live(zhu2022_config(), scene);
    return live.look(0, kRod_rad).level;
  };
  EXPECT_EQ(level(distance_m - 1e-6, -0.1), Level::kFree);
  EXPECT_EQ(level(distance_m + 1e-6, -0.1), Level::kSlow);
  EXPECT_EQ(level(0.1, distance_m - 1e-6), Level::kSlow);
  EXPECT_EQ(level(0.1, distance_m + 1e-6), Level::kRefuse);
  EXPECT_STREQ(level_name(Level::kFree), "free");
  EXPECT_STREQ(level_name(Level::kSlow), "slow");
  EXPECT_STREQ(level_name(Level::kRefuse), "refuse");
}

TEST(LiveClearance, AnArmThatApproachesIsAllowedLess) {
  const config::RobotConfig robot = zhu2022_config();
  const config::SceneConfig& scene = panel_slit();
  ClearanceFinder finder(robot.table, robot.module_radius_m, scene);
  const Registration registration(robot.table, scene);
  MeasuredArm arm{kSlit_rad, {}};
  const double standing_m = finder.find(arm, {registration}).bound_m;
  double least_m = standing_m, most_m = standing_m;
  for (const double rate_rad_s : {-0.01, 0.01}) {
    arm.rate_rad_s[0] = rate_rad_s;
    const double bound_m = finder.find(arm, {registration}).bound_m;
    least_m = std::min(least_m, bound_m);
    most_m = std::max(most_m, bound_m);
  }
  EXPECT_GT(most_m, standing_m + 1e-4);
  EXPECT_GE(least_m, standing_m - 1e-3);
}

TEST(LiveClearance, WithNothingAroundTheArmThereIsNothingToClaim) {
  config::SceneConfig scene;
  LiveClearance live(zhu2022_config(), scene);
  EXPECT_EQ(live.look(0, kRod_rad).clearance.link, -1);
  EXPECT_EQ(live.body_name(), "");
  EXPECT_EQ(live.claim().level, Level::kFree);
}

TEST(LiveClearance, TheSameInputsGiveTheSameBits) {
  double first_m = 0.0;
  for (int run = 0; run < 2; ++run) {
    TrueWorld world(9, {.length_m = 30e-6, .shift_m = 0.01, .turn_deg = 1.0});
    LiveClearance live(zhu2022_config(), panel_slit());
    std::uint64_t tick = 0;
    travel(
        live, world, kEdge_rad, kSlit_rad, 100, tick, [](const Claim&, const ThetaVector&) {}, nothing_spoiled);
    if (run == 0) first_m = live.claim().clearance.distance_m;
    EXPECT_EQ(live.claim().clearance.distance_m, first_m);
  }
}

}  // namespace
}  // namespace liana::clearance_bound
