// Registration: what the camera tells of the scene and of the arm's cables, over seeded worlds.
#include "host/control/clearance_bound/registration.hpp"

#include <gtest/gtest.h>

#include "tests/host/control/clearance_bound/true_world.hpp"

namespace liana::clearance_bound {
namespace {

constexpr double kInterval_s = 0.04;  // of pictures

// Tip against slit as it is believed, less how it is: metres at the tip.
double tip_error_m(const Registration& registration, const TrueWorld& world, const ThetaVector& measured_rad) {
  const RobotParams table = zhu2022::table();
  const CableLayout layout = cable_layout(table);
  const ThetaVector believed_rad = changed(angles_of_lengths(table, layout, measured_rad), measured_rad,
                                           registration.length_error_m(), table.cable_count());
  const Pose drawn{panel_slit().slit->frame.position_m, panel_slit().slit->frame.quaternion_wxyz};
  const auto tip_in_slit = [&](const ThetaVector& theta_rad, const Pose& slit) {
    return compose(inverse(slit), tip_pose(table, arm_trig(table, theta_rad)));
  };
  const Pose believed = tip_in_slit(believed_rad, registration.registered(drawn));
  const Pose truth = tip_in_slit(world.true_rad(measured_rad), world.slit());
  return norm(subtract(believed.position_m, truth.position_m));
}

Registration after(double time_s, TrueWorld& world, const ThetaVector& measured_rad) {
  Registration registration(zhu2022::table(), panel_slit());
  registration.advance(1e4, measured_rad);
  for (double t_s = 0.0; t_s < time_s; t_s += kInterval_s) {
    registration.advance(kInterval_s, measured_rad);
    registration.take(world.picture(0, measured_rad), {measured_rad, {}});
  }
  return registration;
}

TEST(Registration, KnowsTheTipInTheSlitToAMillimetreThoughSceneAndCablesAreOff) {
  const ThetaVector measured_rad = zhu2022::radians(kInSlit_deg);
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    TrueWorld world(seed, {.length_m = 30e-6, .shift_m = 0.01, .turn_deg = 1.0});
    const Registration blind(zhu2022::table(), panel_slit());
    EXPECT_GT(tip_error_m(blind, world, measured_rad), 0.002) << seed;
    EXPECT_LT(tip_error_m(after(4.0, world, measured_rad), world, measured_rad), 0.001) << seed;
  }
}

TEST(Registration, IsNeverSurprisedByTheWorldsItIsMadeFor) {
  const ThetaVector measured_rad = zhu2022::radians(zhu2022::kPanelEdge_deg);
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    TrueWorld world(seed, {.length_m = 30e-6, .shift_m = 0.01, .turn_deg = 1.0});
    const Registration registration = after(1.0, world, measured_rad);
    EXPECT_LT(registration.surprise(world.picture(0, measured_rad), {measured_rad, {}}), 2.5) << seed;
  }
}

TEST(Registration, IsSurprisedByAJumpOfAllThatIsSeen) {
  const ThetaVector measured_rad = zhu2022::radians(kInSlit_deg);
  TrueWorld world(1, {.length_m = 30e-6});
  const Registration registration = after(4.0, world, measured_rad);
  Picture picture = world.picture(0, measured_rad);
  picture.slit_in_tip->position_m[1] += 0.01;
  picture.rod_in_tip->position_m[1] += 0.01;
  EXPECT_GT(registration.surprise(picture, {measured_rad, {}}), 12.0);
}

TEST(Registration, VarianceGrowsWithTimeAndShrinksWithPictures) {
  const ThetaVector measured_rad = zhu2022::radians(kInSlit_deg);
  TrueWorld world(2, {.length_m = 30e-6});
  CableVector last{};
  last[14] = 1.0;
  Registration registration(zhu2022::table(), panel_slit());
  registration.advance(1e4, measured_rad);
  const double before = registration.variance({}, {}, last);
  registration = after(4.0, world, measured_rad);
  const double with = registration.variance({}, {}, last);
  EXPECT_LT(with, 0.8 * before);
  double latest = with;
  for (int k = 0; k < 5; ++k) {
    registration.advance(1.0, measured_rad);
    const double later = registration.variance({}, {}, last);
    EXPECT_GT(later, latest);
    latest = later;
  }
  EXPECT_LT(latest, 1.001 * before);
}

TEST(Registration, DrawnUndoesRegistered) {
  const ThetaVector measured_rad = zhu2022::radians(kInSlit_deg);
  TrueWorld world(3, {.length_m = 30e-6, .shift_m = 0.01, .turn_deg = 1.0});
  const Registration registration = after(2.0, world, measured_rad);
  const Vec3 point_m{2.0, -0.7, 0.3};
  EXPECT_GT(norm(subtract(registration.registered(point_m), point_m)), 0.003);
  EXPECT_LT(norm(subtract(registration.drawn(registration.registered(point_m)), point_m)), 1e-12);
}

TEST(Registration, LearnsFromTheRodAloneAndFromTheSlitAlone) {
  const ThetaVector measured_rad = zhu2022::radians(kInSlit_deg);
  for (const bool slit : {true, false}) {
    TrueWorld world(4, {.length_m = 30e-6, .shift_m = 0.01, .turn_deg = 1.0});
    Registration registration(zhu2022::table(), panel_slit());
    registration.advance(1e4, measured_rad);
    for (int k = 0; k < 100; ++k) {
      Picture picture = world.picture(0, measured_rad);
      (slit ? picture.rod_in_tip : picture.slit_in_tip).reset();
      registration.advance(kInterval_s, measured_rad);
      registration.take(picture, {measured_rad, {}});
    }
    EXPECT_LT(tip_error_m(registration, world, measured_rad), 0.0015) << slit;
  }
}

TEST(Registration, ASceneWithoutSlitAndRodLearnsNothing) {
  config::SceneConfig scene = panel_slit();
  scene.slit.reset();
  scene.rod.reset();
  const ThetaVector measured_rad = zhu2022::radians(kInSlit_deg);
  TrueWorld world(5, {.length_m = 30e-6, .shift_m = 0.01});
  Registration registration(zhu2022::table(), scene);
  registration.take(world.picture(0, measured_rad), {measured_rad, {}});
  EXPECT_EQ(registration.shift_m(), Vec3{});
  EXPECT_EQ(registration.length_error_m(), CableVector{});
}

}  // namespace
}  // namespace liana::clearance_bound
