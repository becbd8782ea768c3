// What the tip camera tells, and when.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fixtures.hpp"
#include "hil/arm/tip_camera.hpp"

namespace liana::bench {
namespace {

const Pose kTip{{2.5, -0.75, 0.2}, {1.0, 0.0, 0.0, 0.0}};

// req:A7
TEST(TipCamera, DeliversTwentyFivePicturesASecondEachAHundredMillisecondsLate) {
  const SceneConfig scene = fixture_scene();
  TipCamera camera(scene.camera, scene.slit_frame, scene.rod.pose, 1);
  int delivered = 0;
  for (int slot = 0; slot < 250; ++slot) {
    const double now_s = slot * 0.004;
    camera.look(now_s, kTip);
    while (const auto view = camera.deliver(now_s)) {
      EXPECT_NEAR(now_s - view->capture_time_s, 0.1, 1e-6);
      EXPECT_NEAR(view->capture_time_s, 0.04 * delivered, 1e-6);
      ++delivered;
    }
  }
  EXPECT_EQ(delivered, 23);  // captures at 0 .. 0.88 s have arrived before 1 s
}

TEST(TipCamera, HasTheNoiseOfTheSceneAndTheSameForOneSeed) {
  const SceneConfig scene = fixture_scene();
  TipCamera camera(scene.camera, scene.slit_frame, scene.rod.pose, 1);
  TipCamera twin(scene.camera, scene.slit_frame, scene.rod.pose, 1);
  const Pose exact = relative(kTip, scene.rod.pose);
  double shift = 0.0;
  double turn = 0.0;
  constexpr int kPictures = 2000;
  for (int i = 0; i < kPictures; ++i) {
    camera.look(0.04 * i, kTip);
    twin.look(0.04 * i, kTip);
    const auto view = camera.deliver(0.04 * i + 0.1);
    const auto same = twin.deliver(0.04 * i + 0.1);
    ASSERT_TRUE(view && view->rod && same && same->rod);
    EXPECT_EQ(view->rod->position_m.x, same->rod->position_m.x);
    const double error_m = view->rod->position_m.x - exact.position_m.x;
    const double error_rad = 2.0 * (conjugate(exact.attitude) * view->rod->attitude).x;
    shift += error_m * error_m;
    turn += error_rad * error_rad;
  }
  EXPECT_NEAR(std::sqrt(shift / kPictures), 0.0003, 0.00002);
  EXPECT_NEAR(std::sqrt(turn / kPictures) / kRadPerDeg, 0.05, 0.004);
}

TEST(TipCamera, SeesNothingOutOfRange) {
  const SceneConfig scene = fixture_scene();
  TipCamera camera(scene.camera, scene.slit_frame, scene.rod.pose, 1);
  camera.look(0.0, {{-2.0, 0.0, 0.0}, {}});
  const auto view = camera.deliver(0.1);
  ASSERT_TRUE(view);
  EXPECT_FALSE(view->rod);
  EXPECT_FALSE(view->slit);
  EXPECT_EQ(camera_message(*view), R"({"capture_time_s":0.0,"op":"camera","rod":null,"slit":null})");
}

// The pictures taken in a second of a camera with these defects from 0.4 s on, and when each was delivered.
struct Delivered {
  double at_s;
  CameraView view;
};

std::vector<Delivered> pictures_with(const CameraDefects& defects) {
  const SceneConfig scene = fixture_scene();
  TipCamera camera(scene.camera, scene.slit_frame, scene.rod.pose, 1);
  std::vector<Delivered> found;
  for (int slot = 0; slot < 250; ++slot) {
    const double now_s = slot * 0.004;
    if (slot == 100) camera.suffer(defects);
    camera.look(now_s, {{2.5, -0.75, 0.2 + 0.1 * now_s}, {}});
    while (const auto view = camera.deliver(now_s)) found.push_back({now_s, *view});
  }
  return found;
}

TEST(TipCamera, FrozenShowsTheLastSoundPictureWithNewTimes) {
  const auto sound = pictures_with({}), frozen = pictures_with({.frozen = true});
  ASSERT_EQ(sound.size(), frozen.size());
  EXPECT_EQ(frozen.back().view.rod->position_m.z, frozen[10].view.rod->position_m.z);
  EXPECT_EQ(frozen[9].view.rod->position_m.z, sound[9].view.rod->position_m.z);
  EXPECT_GT(std::fabs(sound.back().view.rod->position_m.z - frozen.back().view.rod->position_m.z), 0.03);
  EXPECT_EQ(sound.back().view.capture_time_s, frozen.back().view.capture_time_s);
}

TEST(TipCamera, DroppedLateJumpedAndMirroredAreWhatTheySay) {
  const auto sound = pictures_with({});
  EXPECT_EQ(pictures_with({.dropped = true}).size(), 10U) << "those taken before 0.4 s";
  const auto late = pictures_with({.late_s = 0.2});
  EXPECT_NEAR(late.back().at_s - late.back().view.capture_time_s, 0.3, 1e-6);
  const auto jumped = pictures_with({.jump_m = 0.02});
  EXPECT_NEAR(jumped.back().view.rod->position_m.y, sound.back().view.rod->position_m.y + 0.02, 1e-12);
  EXPECT_NEAR(jumped.back().view.slit->position_m.y, sound.back().view.slit->position_m.y + 0.02, 1e-12);
  EXPECT_EQ(jumped[9].view.rod->position_m.y, sound[9].view.rod->position_m.y) << "not before it begins";
  const Pose mirrored = *pictures_with({.mirrored = true}).back().view.slit, plain = *sound.back().view.slit;
  EXPECT_EQ(mirrored.position_m.y, -plain.position_m.y);
  EXPECT_EQ(mirrored.position_m.x, plain.position_m.x);
  const Vec3 x = rotate(plain.attitude, {1.0, 0.0, 0.0}), seen = rotate(mirrored.attitude, {1.0, 0.0, 0.0});
  EXPECT_LT(norm(seen - Vec3{x.x, -x.y, x.z}), 1e-9) << "its axes are mirrored, too";
}

}  // namespace
}  // namespace liana::bench
