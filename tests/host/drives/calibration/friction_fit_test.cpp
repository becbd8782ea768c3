// Friction from slow motions, and its place in the calibration file.
#include "host/drives/calibration/friction_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "firmware_like/cable/arm/tension.hpp"
#include "firmware_like/math/trig.hpp"
#include "host/drives/calibration/jig.hpp"
#include "host/model/config/sha256.hpp"
#include "tests/host/drives/calibration/day.hpp"
#include "tests/host/model/config/tables.hpp"

namespace liana::calibration {

using namespace cable;
namespace {

// Readings of an arm with this friction and torque gains off by up to 1 %, that turns one segment after the other.
FrictionFit measured(double true_mu, double time_s) {
  const config::RobotConfig arm = config::nominal_zhu2022();
  RobotParams truth = arm.table;
  truth.friction_mu = true_mu;
  const CableLayout layout = cable_layout(truth);
  const ThetaVector start_rad = named_pose_rad(arm, "prepare");
  FrictionFit fit(arm.table);
  SlipState slip;
  const double interval_s = truth.interval_ticks * truth.tick_s;
  for (int i = 0; i * interval_s < time_s; ++i) {
    ThetaVector theta_rad = start_rad;
    const auto j = static_cast<std::size_t>(i * interval_s / 16.0) % 5;
    theta_rad[2 * j] += 3.0 * kDegree * std::sin(2.0 * kPi / 16.0 * i * interval_s);
    theta_rad[2 * j + 1] += 3.0 * kDegree * std::sin(2.0 * kPi / 8.0 * i * interval_s);
    const ArmTrig trig = arm_trig(truth, theta_rad);
    const CableGeometry geometry = cable_geometry(truth, layout, trig);
    if (i == 0) reset_slip(geometry, slip);
    advance_slip(layout, geometry, slip);
    const TensionRatio ratio = tension_ratio(truth, layout, trig, slip);
    CableVector tension_N = plan_tension(truth, geometry, ratio, SegmentVector{}).motor_N;
    for (std::size_t c = 0; c < 15; ++c) tension_N[c] *= 1.0 + 0.01 * std::sin(7.0 * static_cast<double>(c));
    fit.add(theta_rad, tension_N, true);
  }
  return fit;
}

TEST(FrictionFit, TheArmsFrictionIsFoundToAFewPerCentWithItsUncertainty) {
  for (const double mu : {0.0, 0.05, 0.11}) {
    const Friction found = measured(mu, 160.0).solve();
    EXPECT_NEAR(found.arm.mu, mu, 0.05 * mu + 0.002) << mu;
    EXPECT_LT(std::fabs(found.arm.mu - mu), 3.0 * found.arm.sd) << mu;
    EXPECT_LT(found.arm.sd, 0.01) << mu;
  }
}

TEST(FrictionFit, ASegmentIsToldApartOrNotAtAll) {
  const Friction found = measured(0.05, 160.0).solve();
  ASSERT_EQ(found.segment.size(), 5u);
  int known = 0;
  for (const std::optional<FrictionOf>& segment : found.segment) {
    if (!segment) continue;
    ++known;
    EXPECT_NEAR(segment->mu, 0.05, 3.0 * segment->sd);
  }
  EXPECT_GE(known, 1);
  EXPECT_LT(known, 5) << "the last segment's friction scales its own three cables alike";
}

TEST(FrictionFit, LessThanTenSecondsOfMotionAreRefused) {
  EXPECT_THROW(measured(0.05, 5.0).solve(), std::runtime_error);
}

TEST(FrictionFit, ACalibrationKeepsItAndTheArmIsToldIt) {
  config::RobotConfig arm = config::nominal_zhu2022();
  Calibration calibration{arm.name, config::sha256_hex(arm.canonical_json), kDay, {}};
  for (std::size_t i = 0; i < 15; ++i) {
    calibration.cables.push_back({static_cast<std::uint32_t>(i + 1), 1, 1000000, arm.drum_radius_m, 40.0, 0.0});
  }
  calibration.friction = Friction{{0.08, 0.002}, {FrictionOf{0.07, 0.01}, {}, {}, {}, {}}};
  const Calibration read = parse_calibration(calibration_json(calibration), "arm.json", arm, kDay);
  EXPECT_EQ(calibration_json(read), calibration_json(calibration));
  ASSERT_TRUE(read.friction);
  EXPECT_FALSE(read.friction->segment[1]);
  apply(read, arm);
  EXPECT_EQ(arm.table.friction_mu, 0.08);
}

}  // namespace
}  // namespace liana::calibration
