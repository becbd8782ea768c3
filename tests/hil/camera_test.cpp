// What the tip camera tells, and when.
#include <gtest/gtest.h>

#include <cmath>

#include "fixtures.hpp"
#include "hil/arm/tip_camera.hpp"

namespace liana::bench {
namespace {

const Pose kTip{{2.5, -0.75, 0.2}, {1.0, 0.0, 0.0, 0.0}};

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

}  // namespace
}  // namespace liana::bench
