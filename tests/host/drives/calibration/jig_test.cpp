#include "host/drives/calibration/jig.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "host/model/config/drive_names.hpp"
#include "tests/host/model/config/tables.hpp"
#include "tests/message.hpp"

namespace liana::calibration {

using namespace cable;
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

// The arm in its fixture; every drive reports its own cable.
class Fixture : public ::testing::Test {
 protected:
  Fixture() {
    robot_ = config::nominal_zhu2022();
    tension_N_.fill(30.0);
    reported_m_ = beyond_zero_m(robot_.table, named_pose_rad(robot_, "jig"), tension_N_);
  }
  std::string said() const { return contradiction(robot_, "jig", reported_m_, tension_N_); }
  std::string refusal(const std::string& pose) const {
    try {
      check_tells_apart(robot_, pose);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  config::RobotConfig robot_;
  CableVector tension_N_{}, reported_m_{};
};

TEST_F(Fixture, AnArmThatLiesInItContradictsNothing) { EXPECT_EQ(said(), ""); }

TEST_F(Fixture, EveryPairOfExchangedCablesIsNamed) {
  const config::DriveNames of_arm(robot_.table);
  for (std::size_t a = 0; a < 15; ++a) {
    for (std::size_t b = a + 1; b < 15; ++b) {
      std::swap(reported_m_[a], reported_m_[b]);
      EXPECT_TRUE(names(said(), {of_arm.drive(a) + " and " + of_arm.drive(b), "other"}));
      std::swap(reported_m_[a], reported_m_[b]);
    }
  }
}

// Fixtures are never exact: 0.05 degrees at every angle alarm nobody, and hide no exchange.
TEST_F(Fixture, APoseThatIsALittleOffAlarmsNobodyAndHidesNoPair) {
  ThetaVector theta_rad = named_pose_rad(robot_, "jig");
  for (std::size_t i = 0; i < 10; ++i) theta_rad[i] += (i % 3 == 0 ? -0.05 : 0.05) * kDegree;
  reported_m_ = beyond_zero_m(robot_.table, theta_rad, tension_N_);
  EXPECT_EQ(said(), "");
  for (std::size_t a = 0; a < 15; ++a) {
    for (std::size_t b = a + 1; b < 15; ++b) {
      std::swap(reported_m_[a], reported_m_[b]);
      EXPECT_NE(said(), "") << a << " and " << b;
      std::swap(reported_m_[a], reported_m_[b]);
    }
  }
}

TEST_F(Fixture, ACableThatIsOffByMoreThanTheToleranceIsNamedAndAccusesNoOther) {
  reported_m_[6] += 0.9 * kFixtureTolerance_m;
  EXPECT_EQ(said(), "");
  reported_m_[6] += 0.2 * kFixtureTolerance_m;
  EXPECT_TRUE(names(said(), {"drive 7 (node 7, segment 3)", "3.3 mm", "3 mm"}));
  EXPECT_EQ(said().find("exchanged"), std::string::npos) << said();
}

TEST_F(Fixture, AnotherPoseIsRefusedWithTheFarthestThree) {
  reported_m_ = beyond_zero_m(robot_.table, named_pose_rad(robot_, "prepare"), tension_N_);
  const std::string text = said();
  EXPECT_TRUE(names(text, {"pose jig"}));
  EXPECT_EQ(std::count(text.begin(), text.end(), '('), 3) << text;
  EXPECT_NE(text.find(" and 12 more"), std::string::npos) << text;
}

TEST_F(Fixture, APoseInWhichAnExchangeWouldGoUnnoticedIsRefused) {
  EXPECT_EQ(refusal("jig"), "");
  EXPECT_TRUE(names(refusal("zero"), {"zero", "cable 1 (segment 1) and cable 2 (segment 1)", "0.0 mm"}))
      << refusal("zero");
  EXPECT_TRUE(names(refusal("prepare"), {"prepare", "cable 2 (segment 1) and cable 3 (segment 1)"}))
      << refusal("prepare");
  EXPECT_TRUE(names(refusal("nowhere"), {"nowhere", "zhu2022"}));
}

}  // namespace
}  // namespace liana::calibration
