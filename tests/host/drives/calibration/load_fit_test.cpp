// Weight and springs from tensions at rest, the poses where they show, and their place in the calibration file.
#include "host/drives/calibration/load_fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "firmware_like/cable/arm/static_load.hpp"
#include "firmware_like/math/trig.hpp"
#include "host/base/random/random.hpp"
#include "host/drives/calibration/calibration.hpp"
#include "host/drives/calibration/load_poses.hpp"
#include "host/model/config/sha256.hpp"
#include "tests/host/drives/calibration/day.hpp"
#include "tests/host/drives/calibration/lab_arm.hpp"
#include "tests/host/model/config/tables.hpp"

namespace liana::calibration {

using namespace cable;
namespace {

// An arm whose load is one prior deviation off the table's, up and down by turns.
RobotParams off_by_one_deviation(const RobotParams& table) {
  RobotParams out = table;
  double sign = 0.5;
  for (const TableField& parameter : load_fields(table)) {
    *parameter.slot(out, parameter.index) += sign * parameter.known_sd;
    sign = -sign;
  }
  out.gravity_m_s2 = scale(out.gravity_m_s2, norm(table.gravity_m_s2) / norm(out.gravity_m_s2));
  return out;
}

// What drives with gains off by up to 1 % read there; friction takes 3 % one way and then the other.
LoadResult found(const RobotParams& table, const RobotParams& truth, const std::vector<LoadPose>& poses) {
  LoadFit fit(table);
  simulated::RandomStream random(1, 5);
  for (const LoadPose& pose : poses) {
    std::array<LoadReading, 2> sides{LoadReading{pose.theta_rad, {}}, LoadReading{pose.theta_rad, {}}};
    const CableVector tension_N = plan_at_rest(truth, cable_layout(truth), pose.theta_rad).motor_N;
    for (std::size_t c = 0; c < static_cast<std::size_t>(table.cable_count()); ++c) {
      const double gained_N = tension_N[c] * (1.0 + 0.01 * std::sin(7.0 * static_cast<double>(c)));
      const double friction = 0.03 * random.uniform(-1.0, 1.0);
      sides[0].tension_N[c] = gained_N * (1.0 + friction);
      sides[1].tension_N[c] = gained_N * (1.0 - friction);
    }
    fit.add(sides);
  }
  return fit.solve();
}

TEST(LoadFit, MassesCentersSpringsAndGravityAreFoundWithTheirUncertainty) {
  const RobotParams table = lab_1g(2.0).table, truth = off_by_one_deviation(table);
  const LoadResult result = found(table, truth, load_poses(table));
  const std::vector<TableField> parameters = load_fields(table);
  ASSERT_EQ(result.values.size(), parameters.size());
  int known = 0;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    RobotParams copy = truth;
    const double is = *parameters[i].slot(copy, parameters[i].index);
    EXPECT_EQ(result.values[i].field, parameters[i].field);
    EXPECT_NEAR(result.values[i].value, is, 3.5 * result.values[i].sd) << parameters[i].field;
    EXPECT_LE(result.values[i].sd, parameters[i].known_sd);
    known += result.values[i].sd < 0.5 * parameters[i].known_sd;
  }
  EXPECT_GE(known, 8) << "of 16: three stiffnesses, gravity, and the heavy ones";
  EXPECT_LT(result.after.torque_Nm, 0.4 * result.before.torque_Nm);
  EXPECT_TRUE(result.problems.empty());
}

TEST(LoadFit, WhatThePosesCannotTellApartIsNamed) {
  const RobotParams table = lab_1g().table;
  const std::vector<LoadPose> straight(6, load_pose(table, {}));
  const LoadResult result = found(table, table, straight);
  bool is_named = false;
  for (const std::vector<std::string>& fields : result.not_told_apart)
    is_named |= std::ranges::find(fields, "tool.center_m[1]") != fields.end();
  EXPECT_TRUE(is_named) << "a lying straight arm turns about no axis by it";
  EXPECT_GT(result.not_told_apart.size(), found(table, table, load_poses(table)).not_told_apart.size());
}

TEST(LoadFit, AnArmThatWeighsFarMoreThanItsTableIsAProblemOfTheFieldThatDoes) {
  const RobotParams table = lab_1g().table;
  RobotParams truth = table;
  truth.segment[0].module_mass_kg *= 2.0;
  truth.segment[1].module_mass_kg *= 2.0;
  truth.segment[2].module_mass_kg *= 2.0;
  const LoadResult result = found(table, truth, load_poses(table));
  ASSERT_FALSE(result.problems.empty());
  EXPECT_NE(result.problems.front().find("module_mass_kg"), std::string::npos) << result.problems.front();
}

TEST(LoadFit, ChosenPosesKeepLimitsAndTensionsOnTheirWayFromBothSides) {
  const RobotParams table = lab_1g().table;
  const std::vector<LoadPose> poses = load_poses(table);
  ASSERT_EQ(poses.size(), kLoadPoses);
  const CableLayout layout = cable_layout(table);
  for (const LoadPose& pose : poses) {
    for (const double side : {-1.0, 0.0, 1.0}) {
      const ThetaVector theta_rad = pose.beside_rad(side);
      for (std::size_t k = 0; k < 6; ++k) EXPECT_LT(std::fabs(theta_rad[k]), table.segment[k / 2].theta_limit_rad);
      const CableVector tension_N = plan_at_rest(table, layout, theta_rad).motor_N;
      EXPECT_LE(*std::max_element(tension_N.begin(), tension_N.begin() + table.cable_count()),
                table.tension.ceiling_free_N);
    }
  }
}

TEST(LoadFit, AWeightlessArmTooFewPosesAndAPoseAtALimitAreRefused) {
  const RobotParams weightless = config::nominal_zhu2022().table, table = lab_1g().table;
  EXPECT_THROW(load_poses(weightless), std::runtime_error);
  EXPECT_THROW(LoadFit(weightless).solve(), std::runtime_error);
  EXPECT_THROW(LoadFit(table).solve(), std::runtime_error);
  ThetaVector bent_rad{};
  bent_rad[3] = table.segment[1].theta_limit_rad;
  EXPECT_THROW(load_pose(table, bent_rad), std::runtime_error);
}

TEST(LoadFit, ACalibrationKeepsTheLoadTheArmIsGivenItAndAnImplausibleOneIsRefused) {
  config::RobotConfig arm = lab_1g(2.0);
  const RobotParams table = arm.table, truth = off_by_one_deviation(table);
  Calibration calibration{arm.name, config::sha256_hex(arm.canonical_json), kDay, {}};
  for (std::size_t i = 0; i < static_cast<std::size_t>(arm.table.cable_count()); ++i)
    calibration.cables.push_back({static_cast<std::uint32_t>(i + 1), 1, 500000, arm.drum_radius_m, 30.0, 0.0});
  calibration.fields = found(table, truth, load_poses(table)).values;
  const Calibration read = parse_calibration(calibration_json(calibration), "arm.json", arm, kDay);
  EXPECT_EQ(calibration_json(read), calibration_json(calibration));
  apply(read, arm);
  for (const TableField& parameter : load_fields(table)) {
    const auto one = std::ranges::find(calibration.fields, parameter.field, &FieldValue::field);
    EXPECT_EQ(*parameter.slot(arm.table, parameter.index), one->value) << parameter.field;
  }
  calibration.fields.front().value *= 2.0;
  EXPECT_THROW(parse_calibration(calibration_json(calibration), "arm.json", lab_1g(2.0), kDay), std::runtime_error);
  calibration.fields.front() = calibration.fields.back();
  EXPECT_THROW(parse_calibration(calibration_json(calibration), "arm.json", lab_1g(2.0), kDay), std::runtime_error);
}

}  // namespace
}  // namespace liana::calibration
