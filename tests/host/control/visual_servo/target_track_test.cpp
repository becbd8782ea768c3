#include "host/control/visual_servo/target_track.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace liana::visual_servo {
namespace {

const Pose kTracked{{3.0, 1.0, -0.5}, quaternion_of({0.2, -0.1, 0.4})};

Pose tip_at(double x) { return {{x, 0.1, 0.2}, quaternion_of({0.0, 0.05 * x, 0.0})}; }
// What a camera without errors shows.
Pose seen_from(const Pose& tip) { return compose(inverse(tip), kTracked); }

// Ten images a second of a tip that moves.
TargetTrack settled(double until_s) {
  TargetTrack track;
  for (int i = 0; 0.1 * i < until_s; ++i) track.see(0.1 * i, seen_from(tip_at(0.01 * i)), tip_at(0.01 * i));
  return track;
}

TEST(TargetTrack, ATargetAtRestStandsStillWhileTheTipMoves) {
  const TargetTrack track = settled(5.0);
  EXPECT_TRUE(track.is_settled());
  EXPECT_LT(norm(subtract(track.target_in_base().position_m, kTracked.position_m)), 1e-12);
  EXPECT_EQ(track.used(), 50);
}

TEST(TargetTrack, SettlesOnlyWhenFiveImagesAgree) {
  EXPECT_FALSE(settled(0.35).is_settled());
  EXPECT_TRUE(settled(0.45).is_settled());
}

TEST(TargetTrack, FollowsAStepWithItsTimeConstant) {
  TargetTrack track = settled(50.0);
  Pose beside = kTracked;
  beside.position_m[1] += 0.01;
  for (int i = 0; i < 40; ++i) {
    const double capture_s = 50.0 + 0.1 * i;
    track.see(capture_s, compose(inverse(tip_at(capture_s)), beside), tip_at(capture_s));
  }
  const double done = (track.target_in_base().position_m[1] - kTracked.position_m[1]) / 0.01;
  EXPECT_NEAR(done, 0.632, 0.02);
}

struct BadImage {
  const char* name;
  double capture_s;
  Pose target_in_tip;
  std::optional<Pose> tip;
  ImageUse use;
};

TEST(TargetTrack, ImagesThatCannotBeBelievedAreCountedAndLeftOut) {
  const Pose tip = tip_at(0.5);
  Pose far = seen_from(tip), turned = seen_from(tip);
  far.position_m[2] += 0.031;
  turned.quaternion = multiply(turned.quaternion, quaternion_of({0.0, 0.0, 0.06}));
  const BadImage images[] = {
      {"not newer", 4.9, seen_from(tip), tip, ImageUse::kStale},
      {"of an unknown time", 5.5, seen_from(tip), std::nullopt, ImageUse::kUnknown},
      {"the same from elsewhere", 5.5, seen_from(tip_at(0.49)), tip_at(0.6), ImageUse::kFrozen},
      {"far from the others", 5.5, far, tip, ImageUse::kOutlier},
      {"turned against the others", 5.5, turned, tip, ImageUse::kOutlier},
  };
  for (const BadImage& image : images) {
    TargetTrack track = settled(5.0);
    EXPECT_EQ(track.see(image.capture_s, image.target_in_tip, image.tip), image.use) << image.name;
    EXPECT_EQ(track.rejected(), 1) << image.name;
    EXPECT_EQ(track.used(), 50) << image.name;
    EXPECT_LT(norm(subtract(track.target_in_base().position_m, kTracked.position_m)), 1e-12) << image.name;
  }
}

TEST(TargetTrack, TheSamePictureOfATipAtRestIsANewOne) {
  TargetTrack track = settled(5.0);
  for (int i = 0; i < 10; ++i)
    EXPECT_EQ(track.see(5.0 + 0.1 * i, seen_from(tip_at(0.5)), tip_at(0.5)), ImageUse::kUsed);
}

TEST(TargetTrack, AFirstImageThatIsWrongDoesNotKeepOutThoseBehindIt) {
  TargetTrack track;
  Pose wrong = seen_from(tip_at(0.0));
  wrong.position_m[0] += 0.2;
  track.see(0.0, wrong, tip_at(0.0));
  for (int i = 1; i < 8; ++i) track.see(0.1 * i, seen_from(tip_at(0.01 * i)), tip_at(0.01 * i));
  EXPECT_TRUE(track.is_settled());
  EXPECT_EQ(track.rejected(), 1);
  EXPECT_LT(norm(subtract(track.target_in_base().position_m, kTracked.position_m)), 1e-12);
}

// req:B16
TEST(TargetTrack, OnABaseThatSwingsPlaceAndAttitudeAreThoseOfItsMiddle) {
  constexpr double kTurn_rad = 2.0 * 3.14159265358979323846;
  TargetTrack track(4.0, {34.0, 8.6});
  for (int i = 0; i < 600; ++i) {
    const double capture_s = 0.1 * i, slow = std::sin(kTurn_rad * capture_s / 33.0),
                 quick = std::cos(kTurn_rad * capture_s / 8.9);
    const Pose swung{add(kTracked.position_m, {0.006 * slow, 0.004 * quick, 0.0}),
                     multiply(quaternion_of({0.0, 0.001 * slow, 0.005 * quick}), kTracked.quaternion)};
    ASSERT_EQ(track.see(capture_s, swung, Pose{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}}), ImageUse::kUsed);
    if (capture_s < 30.0) continue;
    const Pose& middle = track.target_in_base();
    EXPECT_LT(norm(subtract(middle.position_m, kTracked.position_m)), 0.001) << capture_s;
    EXPECT_LT(norm(rotation_vector(multiply(middle.quaternion, conjugate(kTracked.quaternion)))), 0.0007) << capture_s;
  }
}

}  // namespace
}  // namespace liana::visual_servo
