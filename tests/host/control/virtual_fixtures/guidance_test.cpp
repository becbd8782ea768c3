// Which plane guides, when, and which yaws it leaves.
#include "host/control/virtual_fixtures/guidance.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "firmware_like/math/trig.hpp"
#include "host/model/config/config.hpp"
#include "host/model/inverse_kinematics/dof_split.hpp"
#include "tests/firmware_like/zhu2022.hpp"
#include "tests/host/control/virtual_fixtures/interval.hpp"
#include "tests/host/model/config/tables.hpp"

namespace liana::virtual_fixtures {
namespace {

constexpr std::uint32_t kX5 = 1u << 8, kX4X5 = kX5 | 1u << 6;

class InTheSlit : public testing::Test {
 protected:
  InTheSlit() {
    scene_ = config::parse_scene(config::good_table("scene", "panel_slit").dump(), "s");
    guidance_ = Guidance(robot_, scene_.fixtures, 0.03);
    now_.theta_rad = zhu2022::radians(zhu2022::kPressRod_deg);
    now_.tip_in_base = forward_kinematics(robot_, now_.theta_rad).tip_in_base;
    now_.held_mask = kX4X5;
    normal_ = scene_.slit->normal;
  }
  // The tip, moved along the normal.
  Pose beside(double off_m) const {
    Pose out = now_.tip_in_base;
    out.position_m = add(out.position_m, scale(normal_, off_m));
    return out;
  }
  double off_m(const Pose& pose) const { return dot(normal_, pose.position_m) - scene_.slit->offset_m; }
  void settle() {
    for (int i = 0; i < 1000; ++i) guidance_.guide(now_.tip_in_base, now_, kInterval_s);
  }

  RobotParams robot_ = zhu2022::table();
  config::SceneConfig scene_;
  Guidance guidance_;
  Commanded now_;
  Vec3 normal_{};
};

TEST_F(InTheSlit, AHandIsGuidedInThePlanarModesAlone) {
  struct Row {
    const char* what;
    std::uint32_t held_mask;
    bool is_guided;
  };
  for (const Row& row :
       {Row{"10+0", 0, false}, Row{"9+1", kX5, true}, Row{"8+2", kX4X5, true}, Row{"X4 alone", 1u << 6, false}}) {
    now_.held_mask = row.held_mask;
    guidance_.guide(now_.tip_in_base, now_, kInterval_s);
    EXPECT_EQ(guidance_.plane_name(), row.is_guided ? "slit_plane" : "") << row.what;
  }
}

TEST_F(InTheSlit, OnlyInTheSlitAndALittleBeforeItWithSomeRoomOnTheWayOut) {
  const Vec3 u = scene_.slit->u_axis;
  const double depth_m = dot(u, now_.tip_in_base.position_m) - scene_.slit->mouth_u_m;
  Commanded moved = now_;
  const auto name_at = [&](double u_m) {
    moved.tip_in_base.position_m = add(now_.tip_in_base.position_m, scale(u, u_m - depth_m));
    guidance_.guide(moved.tip_in_base, moved, kInterval_s);
    return guidance_.plane_name();
  };
  EXPECT_EQ(name_at(-0.21), "");
  EXPECT_EQ(name_at(-0.19), "slit_plane");
  EXPECT_EQ(name_at(-0.21), "slit_plane");
  EXPECT_EQ(name_at(-0.23), "");
}

TEST_F(InTheSlit, AHandThatPushesOutOfThePlaneIsToldHowFarAndMovesNothing) {
  settle();
  const Pose led = guidance_.guide(beside(0.05), now_, kInterval_s);
  EXPECT_NEAR(off_m(led), 0.0, 1e-9);
  EXPECT_NEAR(guidance_.taken_away_m(), 0.05, 1e-9);
}

// The tip stands 8 mm beside its command: the command goes 8 mm to the other side, slowly.
TEST_F(InTheSlit, ThePlaneIsThatOfTheTipAsItIsBelievedToBe) {
  for (int i = 0; i < 1500; ++i) {
    const Vec3 off = i == 0 ? Vec3{} : scale(normal_, 0.008);
    const double before_m = guidance_.plane() ? off_plane_m(*guidance_.plane(), now_.tip_in_base.position_m) : 0.0;
    guidance_.see({{}, off, {}}, kInterval_s);
    guidance_.guide(now_.tip_in_base, now_, kInterval_s);
    if (i > 0) {
      ASSERT_LE(std::fabs(off_plane_m(*guidance_.plane(), now_.tip_in_base.position_m) - before_m), 0.00011) << i;
    }
  }
  EXPECT_NEAR(off_m(guidance_.guide(now_.tip_in_base, now_, kInterval_s)), -0.008, 1e-4);
}

TEST_F(InTheSlit, FixturesThatAreNotChosenDoNotGuide) {
  guidance_.choose(std::vector<std::string>{"slit_walls"});
  EXPECT_FALSE(guidance_.is_chosen("slit_plane"));
  const Pose led = guidance_.guide(beside(0.05), now_, kInterval_s);
  EXPECT_NEAR(off_m(led), 0.05, 1e-9);
  guidance_.choose(std::nullopt);
  guidance_.guide(beside(0.05), now_, kInterval_s);
  EXPECT_EQ(guidance_.plane_name(), "slit_plane");
}

// req:A39
TEST_F(InTheSlit, TheTipTurnsOnlyAsFarAsTheRootOfThePlanarPartStaysInReach) {
  settle();
  const Vec3 n = normal_;
  for (const double turn : {0.02, -0.02, 0.9, -0.9}) {
    Pose goal = now_.tip_in_base;
    goal.quaternion = normalize(multiply(quaternion_of(scale(n, turn)), goal.quaternion));
    const Pose led = guidance_.guide(goal, now_, kInterval_s);
    const inverse_kinematics::SlitMouth mouth{guidance_.plane()->frame_in_base, 2.15, 0.02, 100.0};
    EXPECT_TRUE(inverse_kinematics::some_yaw_fits(robot_, {2, led, now_.theta_rad}, mouth)) << turn;
    const double came = norm(rotation_vector(multiply(led.quaternion, conjugate(now_.tip_in_base.quaternion))));
    EXPECT_EQ(guidance_.is_yaw_limited(), came < std::fabs(turn) - 1e-6) << turn;
    if (std::fabs(turn) < 0.1) {
      EXPECT_NEAR(came, std::fabs(turn), 1e-6) << "small turns are free";
    }
  }
}

TEST_F(InTheSlit, OfAHandThatLetsGoNothingIsKept) {
  guidance_.guide(beside(0.02), now_, kInterval_s);
  guidance_.stop();
  EXPECT_EQ(guidance_.plane_name(), "");
  const Pose led = guidance_.guide(beside(0.01), now_, kInterval_s);
  EXPECT_NEAR(off_m(led), 0.01, 2e-4) << "begins where the hand grips";
}

}  // namespace
}  // namespace liana::virtual_fixtures
