// Cameras that tell something else than what is there: each is recognised, named, and not believed.
#include "host/control/clearance_bound/camera_monitor.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "tests/host/control/clearance_bound/true_world.hpp"

namespace liana::clearance_bound {
namespace {

constexpr std::uint64_t kBegin = 5000, kEnd = 7000;  // ticks of capture while the camera is wrong

struct WrongCamera {
  const char* name;
  CameraStatus named;
  std::function<void(Picture&, const Picture& last_right)> spoil;
};

void for_both(Picture& picture, const std::function<void(Pose&)>& change) {
  change(*picture.slit_in_tip);
  change(*picture.rod_in_tip);
}

const WrongCamera kWrong[] = {
    {"frozen", CameraStatus::kFrozen,
     [](Picture& picture, const Picture& last) {
       picture.slit_in_tip = last.slit_in_tip;
       picture.rod_in_tip = last.rod_in_tip;
     }},
    {"jumped", CameraStatus::kJumped,
     [](Picture& picture, const Picture&) { for_both(picture, [](Pose& p) { p.position_m[1] += 0.015; }); }},
    {"mirrored", CameraStatus::kMirrored,
     [](Picture& picture, const Picture&) {
       for_both(picture, [](Pose& p) {
         p.position_m[1] = -p.position_m[1];
         p.quaternion[1] = -p.quaternion[1];
         p.quaternion[3] = -p.quaternion[3];
       });
     }},
    {"mirrored upside down", CameraStatus::kMirrored,
     [](Picture& picture, const Picture&) {
       for_both(picture, [](Pose& p) {
         p.position_m[2] = -p.position_m[2];
         p.quaternion[1] = -p.quaternion[1];
         p.quaternion[2] = -p.quaternion[2];
       });
     }},
    {"turned", CameraStatus::kJumped,
     [](Picture& picture, const Picture&) {
       const Pose turned{{}, quaternion_of({0.0, 0.02, 0.0})};
       for_both(picture, [&](Pose& p) { p = compose(turned, p); });
     }},
};

// In the slit, as fast as the arm may there, the camera is wrong for a while.
void go_in(const WrongCamera& wrong) {
  TrueWorld world(11, {.length_m = 30e-6, .shift_m = 0.005, .turn_deg = 0.5});
  LiveClearance live(zhu2022_config(), panel_slit());
  Picture last_right;
  std::uint64_t tick = 0;
  int wrong_ones = 0, named = 0, believed = 0, right_ones_doubted = 0;
  const ThetaVector slit_rad = zhu2022::radians(kInSlit_deg), rod_rad = zhu2022::radians(zhu2022::kPressRod_deg);
  const auto judge = [&](const Claim& claim, const ThetaVector&) {
    const std::uint64_t seen = tick - std::min<std::uint64_t>(tick, 35);  // capture of the picture that came last
    if (seen < 100) return;
    if (seen < kBegin || seen > kEnd + 10) right_ones_doubted += claim.trouble != CameraStatus::kNone;
    if (seen <= kBegin + 60 || seen >= kEnd) return;
    ++wrong_ones;
    named += claim.trouble == wrong.named;
    believed += claim.trouble == CameraStatus::kNone;
  };
  const auto spoil = [&](std::optional<Picture>& picture) {
    if (picture->tick >= kBegin && picture->tick < kEnd) {
      wrong.spoil(*picture, last_right);
    } else {
      last_right = *picture;
    }
  };
  travel(live, world, slit_rad, rod_rad, 2000, tick, judge, spoil);
  EXPECT_EQ(right_ones_doubted, 0) << wrong.name;
  EXPECT_EQ(believed, 0) << wrong.name;
  EXPECT_GT(named, 0.9 * wrong_ones) << wrong.name;
}

TEST(CameraMonitor, NamesWhatIsWrongAndBelievesTheCameraAgainAfterwards) {
  for (const WrongCamera& wrong : kWrong) go_in(wrong);
}

TEST(CameraMonitor, PicturesOfAnArmAtRestAreNotFrozen) {
  TrueWorld world(12, {.length_m = 30e-6});
  LiveClearance live(zhu2022_config(), panel_slit());
  std::uint64_t tick = 0;
  const ThetaVector rest_rad = zhu2022::radians(kInSlit_deg);
  const auto judge = [&](const Claim& claim, const ThetaVector&) {
    if (tick > 100) {
      EXPECT_EQ(claim.trouble, CameraStatus::kNone) << tick;
    }
  };
  travel(live, world, rest_rad, rest_rad, 200, tick, judge, nothing_spoiled);
}

TEST(CameraMonitor, APictureIsLateAfterItsLatencyAndATenthOfASecond) {
  CameraMonitor watch(*panel_slit().camera, 0.004);
  EXPECT_EQ(watch.judge_time({100, {}, {}}, 100 + 50), CameraStatus::kNone);
  EXPECT_EQ(watch.judge_time({110, {}, {}}, 110 + 51), CameraStatus::kLate);
}

TEST(CameraMonitor, TimeStampsRiseAndAreNotOfTheFuture) {
  CameraMonitor watch(*panel_slit().camera, 0.004);
  EXPECT_EQ(watch.judge_time({100, {}, {}}, 130), CameraStatus::kNone);
  EXPECT_EQ(watch.judge_time({100, {}, {}}, 140), CameraStatus::kTimeStamp);
  EXPECT_EQ(watch.judge_time({90, {}, {}}, 140), CameraStatus::kTimeStamp);
  EXPECT_EQ(watch.judge_time({141, {}, {}}, 140), CameraStatus::kTimeStamp);
  EXPECT_EQ(watch.judge_time({110, {}, {}}, 141), CameraStatus::kNone);
}

TEST(CameraMonitor, EveryTroubleHasItsName) {
  EXPECT_STREQ(trouble_name(CameraStatus::kNone), "none");
  EXPECT_STREQ(trouble_name(CameraStatus::kNoPicture), "no picture");
  EXPECT_STREQ(trouble_name(CameraStatus::kTimeStamp), "time stamp");
  EXPECT_STREQ(trouble_name(CameraStatus::kLate), "late");
  EXPECT_STREQ(trouble_name(CameraStatus::kFrozen), "frozen");
  EXPECT_STREQ(trouble_name(CameraStatus::kMirrored), "mirrored");
  EXPECT_STREQ(trouble_name(CameraStatus::kJumped), "jumped");
}

}  // namespace
}  // namespace liana::clearance_bound
