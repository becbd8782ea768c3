#include "host/drives/calibration/calibrate.hpp"

#include "firmware_like/cable/arm/payout.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <sstream>
#include <utility>

#include "firmware_like/cable/arm/estimator.hpp"
#include "firmware_like/cable/arm/tension.hpp"
#include "firmware_like/cable_controller.hpp"
#include "firmware_like/math/convert.hpp"
#include "host/base/json/json.hpp"
#include "host/drives/calibration/jig.hpp"
#include "host/drives/calibration/jig_prompt.hpp"
#include "host/model/config/canonical.hpp"
#include "host/model/config/sha256.hpp"
#include "tests/host/drives/calibration/day.hpp"
#include "tests/host/model/config/tables.hpp"
#include "tests/message.hpp"

namespace liana::calibration {

using namespace cable;
namespace {

// What the drives of an arm report that is as its table says, but for cables exchanged, drives that count backwards,
// and drums.
struct Workshop {
  config::RobotConfig arm = config::nominal_zhu2022();
  std::vector<std::size_t> cable_of;  // on each drum
  CableVector factor{};               // of each report: -1 counts backwards, 1.01 a drum of 1 % less
  CableVector off_m{};                // of each zero
  std::array<std::uint32_t, kMaxCables> serial{};

  Workshop() {
    for (std::size_t i = 0; i < 15; ++i) {
      cable_of.push_back(i);
      serial[i] = static_cast<std::uint32_t>(70400 + 3 * i);
    }
    factor.fill(1.0);
  }
  std::vector<CalibrationReading> readings(const std::vector<std::string>& poses = {"zero", "jig", "prepare"}) const {
    std::vector<CalibrationReading> out;
    for (const std::string& name : poses) {
      CalibrationReading reading;
      reading.theta_rad = named_pose_rad(arm, name);
      reading.tension_N.fill(30.0);
      reading.serial = serial;
      const CableVector beyond_m = beyond_zero_m(arm.table, reading.theta_rad, reading.tension_N);
      for (std::size_t i = 0; i < 15; ++i)
        reading.position_m[i] = factor[i] * (beyond_m[cable_of[i]] + off_m[cable_of[i]]);
      out.push_back(reading);
    }
    return out;
  }
  CalibrationResult result() const { return calibrate(arm, readings(), kDay); }
};

TEST(Calibrate, AnArmAsItsTableSaysGetsItsTable) {
  const Workshop workshop;
  const CalibrationResult found = workshop.result();
  ASSERT_EQ(found.problems, std::vector<std::string>{});
  for (std::size_t i = 0; i < 15; ++i) {
    EXPECT_EQ(found.calibration.cables[i].zero_counts, workshop.arm.table.drive[i].zero_counts);
    EXPECT_EQ(found.calibration.cables[i].direction, workshop.arm.table.drive[i].direction);
    EXPECT_EQ(found.calibration.cables[i].serial, workshop.serial[i]);
    EXPECT_NEAR(found.calibration.cables[i].drum_radius_m, 0.015, 1e-9);
  }
}

TEST(Calibrate, ZerosAndDrumsAreFoundToAMicrometre) {
  Workshop workshop;
  for (std::size_t i = 0; i < 15; ++i) {
    workshop.off_m[i] = 1e-3 * (static_cast<double>(i) - 7.0);
    workshop.factor[i] = 1.0 + 0.001 * static_cast<double>(i % 3);
  }
  const CalibrationResult found = workshop.result();
  ASSERT_EQ(found.problems, std::vector<std::string>{});
  config::RobotConfig calibrated = workshop.arm;
  apply(found.calibration, calibrated);
  for (const CalibrationReading& reading : workshop.readings()) {
    const CableVector wanted_m = beyond_zero_m(workshop.arm.table, reading.theta_rad, reading.tension_N);
    for (std::size_t i = 0; i < 15; ++i) {
      const DriveParams& before = workshop.arm.table.drive[i];
      const double counts = before.zero_counts + reading.position_m[i] / (before.direction * before.metres_per_count);
      const auto whole = static_cast<std::int32_t>(std::lround(counts));
      EXPECT_NEAR(cable::payout_at_counts(calibrated.table.drive[i], 0.0, whole), wanted_m[i], 3e-6) << "cable " << i;
    }
  }
}

TEST(Calibrate, ADriveThatCountsBackwardsGetsTheOtherDirection) {
  for (std::size_t i = 0; i < 15; ++i) {
    Workshop workshop;
    workshop.factor[i] = -1.0;
    const CalibrationResult found = workshop.result();
    ASSERT_EQ(found.problems, std::vector<std::string>{});
    for (std::size_t k = 0; k < 15; ++k)
      EXPECT_EQ(found.calibration.cables[k].direction, (k == i ? -1 : 1) * workshop.arm.table.drive[k].direction);
  }
}

TEST(Calibrate, EveryPairOfExchangedCablesIsNamed) {
  for (std::size_t a = 0; a < 15; ++a) {
    for (std::size_t b = a + 1; b < 15; ++b) {
      Workshop workshop;
      std::swap(workshop.cable_of[a], workshop.cable_of[b]);
      const std::vector<std::string> problems = workshop.result().problems;
      ASSERT_EQ(problems.size(), 2u) << a << " and " << b;
      const std::string first = std::to_string(a + 1), second = std::to_string(b + 1);
      EXPECT_TRUE(names(problems[0], {"drive " + first, "cable " + second}));
      EXPECT_TRUE(names(problems[1], {"drive " + second, "cable " + first}));
    }
  }
}

TEST(Calibrate, ADrumThatIsTooFarOffAndACableThatIsInNoFixtureAreNamed) {
  Workshop drum;
  drum.factor[4] = 1.0 / 1.04;
  ASSERT_EQ(drum.result().problems.size(), 1u);
  EXPECT_TRUE(names(drum.result().problems[0], {"radius", "15.6000 mm"}));
  const Workshop workshop;
  std::vector<CalibrationReading> readings = workshop.readings();
  readings[1].position_m[6] += 0.01;
  const std::vector<std::string> problems = calibrate(workshop.arm, readings, kDay).problems;
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_TRUE(names(problems[0], {"drive 7 (node 7, segment 3)"}));
}

TEST(Calibrate, ADriveWithoutASerialNumberOfItsOwnIsNamed) {
  Workshop none;
  none.serial[2] = 0;
  ASSERT_EQ(none.result().problems.size(), 1u);
  EXPECT_TRUE(names(none.result().problems[0], {"drive 3 (node 3, segment 1)", "0x1018:4", "0", "1"}));
  Workshop twice;
  twice.serial[9] = twice.serial[4];
  const std::vector<std::string> problems = twice.result().problems;
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_TRUE(names(problems[0], {"drive 5 (node 5, segment 2)", "0x1018:4", "70412", "drive 10"}));
  const Workshop workshop;
  std::vector<CalibrationReading> readings = workshop.readings();
  readings[2].serial[7] = 99;
  const std::vector<std::string> changed = calibrate(workshop.arm, readings, kDay).problems;
  ASSERT_EQ(changed.size(), 1u);
  EXPECT_TRUE(names(changed[0], {"70421", "0x1018:4", "99"}));
}

TEST(FixturePrompt, WaitsForEnterAtEachFixture) {
  std::istringstream in("\nready\n");
  std::ostringstream out;
  wait_for_fixture(in, out, "zero", 1, 2);
  wait_for_fixture(in, out, "prepare", 2, 2);
  EXPECT_EQ(out.str(),
            "pose 1 of 2: put the arm into jig zero, then press Enter\npose 2 of 2: put the arm into jig "
            "prepare, then press Enter\n");
}

TEST(FixturePrompt, AnInputThatEndsIsNoConsent) {
  for (const char* input : {"", "yes"}) {
    std::istringstream in(input);
    std::ostringstream out;
    EXPECT_THROW(wait_for_fixture(in, out, "zero", 1, 2), std::runtime_error) << input;
  }
}

TEST(Calibrate, PosesThatDoNotTellEnoughAreRefused) {
  const config::RobotConfig arm = config::nominal_zhu2022();
  const auto message = [&](const std::vector<std::string>& names) -> std::string {
    std::vector<ThetaVector> poses;
    for (const std::string& name : names) poses.push_back(named_pose_rad(arm, name));
    try {
      check_poses(arm, poses);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message({"zero", "jig", "prepare"}), "");
  EXPECT_NE(message({"prepare"}).find("two or more"), std::string::npos);
  EXPECT_NE(message({"prepare", "prepare"}).find("cable 1 (segment 1)"), std::string::npos);
}

// The published arm, every length times `factor`.
config::RobotConfig scaled(double factor) {
  config::RobotConfig arm = config::nominal_zhu2022();
  RobotParams& table = arm.table;
  for (std::size_t j = 0; j < as_index(table.segment_count); ++j) {
    table.segment[j].module_length_m *= factor;
    table.segment[j].hole_radius_m *= factor;
    table.segment[j].face_offset_m *= factor;
  }
  table.lead_m *= factor;
  arm.drum_radius_m *= factor;
  for (std::size_t i = 0; i < 15; ++i) table.drive[i].metres_per_count *= factor;
  return arm;
}

// What is enough of a change, and what is too much of a misfit, goes with the arm's size.
TEST(Calibrate, ASmallArmAndALargeOneAreJudgedAsThePublishedOne) {
  EXPECT_EQ(min_change_m(config::nominal_zhu2022().table, 0), 4e-3);
  for (const double factor : {0.04, 0.25, 1.0, 4.0, 20.0}) {
    Workshop workshop;
    workshop.arm = scaled(factor);
    EXPECT_NEAR(min_change_m(workshop.arm.table, 4), factor * 4e-3, 1e-12);
    const auto poses = [&](double share) {
      std::vector<ThetaVector> out;
      for (const char* name : {"zero", "jig", "prepare"}) {
        out.push_back(named_pose_rad(workshop.arm, name));
        for (double& angle : out.back()) angle *= share;
      }
      return out;
    };
    EXPECT_NO_THROW(check_poses(workshop.arm, poses(1.0))) << factor;
    EXPECT_THROW(check_poses(workshop.arm, poses(0.1)), std::runtime_error) << factor << ": little bent";
    EXPECT_EQ(workshop.result().problems, std::vector<std::string>{}) << factor;
    for (const double off_mm : {0.3, 3.0}) {
      std::vector<CalibrationReading> readings = workshop.readings();
      readings[1].position_m[6] += 1e-3 * off_mm * factor;
      EXPECT_EQ(calibrate(workshop.arm, readings, kDay).problems.size(), off_mm > 1.0 ? 1u : 0u)
          << factor << ", " << off_mm;
    }
    std::swap(workshop.cable_of[3], workshop.cable_of[9]);
    EXPECT_EQ(workshop.result().problems.size(), 2u) << factor;
  }
}

// Homing itself, without fixtures: at prepare, an arm whose two cables are exchanged contradicts itself.
TEST(Calibrate, HomingAloneSeesExchangedCablesOfDifferentSegments) {
  const config::RobotConfig arm = config::nominal_zhu2022();
  const RobotParams& table = arm.table;
  const CableLayout layout = cable_layout(table);
  const ThetaVector truth = named_pose_rad(arm, "prepare");
  CableVector tension_N{};
  tension_N.fill(30.0);
  const CableVector beyond_m = beyond_zero_m(table, truth, tension_N);
  int seen = 0, inside_seen = 0;
  for (std::size_t a = 0; a < 15; ++a) {
    for (std::size_t b = a + 1; b < 15; ++b) {
      CableVector payout_m{};
      for (std::size_t c = 0; c < 15; ++c)
        payout_m[c] = beyond_m[c == a ? b : c == b ? a : c] + layout.zero_length_m[c] + table.lead_m;
      EstimatorState state;
      CableModel model;
      for (int i = 0; i < 60; ++i) {
        model.theta_rad = state.theta_rad;
        const ArmTrig trig = arm_trig(table, model.theta_rad);
        model.geometry = cable_geometry(table, layout, trig);
        update_cable_solver(table, model.geometry, model.solver);
        estimate(table, layout, model, tension_ratio(table, layout, trig, SlipState{}), payout_m, tension_N, state);
      }
      double largest_m = 0.0;
      for (const double left : state.residual_m) largest_m = std::fmax(largest_m, std::fabs(left));
      const bool found = largest_m >= kHomingResidual_m || !(state.largest_step_rad < kHomingStep_rad);
      seen += found ? 1 : 0;
      inside_seen += found && a / 3 == b / 3 ? 1 : 0;
    }
  }
  RecordProperty("pairs_seen_by_homing", seen);
  RecordProperty("of_them_within_a_segment", inside_seen);
  std::printf("  measured: homing at prepare sees %d of 105 pairs, %d of 15 within a segment\n", seen, inside_seen);
  EXPECT_GE(seen - inside_seen, 80);
}

// A good file, spoiled.
class CalibrationFile : public ::testing::Test {
 protected:
  std::string message(const std::function<void(Json&)>& spoil, bool sign = true,
                      const std::string& today = kDay) const {
    Json content = Json::parse(calibration_json(Workshop().result().calibration));
    spoil(content);
    try {
      parse_calibration(sign ? signed_again(content) : content.dump(), "arm.json", config::nominal_zhu2022(), today);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }
  static std::string signed_again(Json content) {
    content.erase("sha256");
    content["sha256"] = config::sha256_hex(config::canonical_json(content));
    return content.dump();
  }
};

TEST_F(CalibrationFile, IsReadAsItWasWritten) {
  const Calibration written = Workshop().result().calibration;
  const Calibration read = parse_calibration(calibration_json(written), "arm.json", config::nominal_zhu2022(), kDay);
  EXPECT_EQ(calibration_json(read), calibration_json(written));
  config::RobotConfig arm = config::nominal_zhu2022();
  apply(read, arm);
  EXPECT_EQ(arm.drive_serials[3], Workshop().serial[3]);
  EXPECT_EQ(arm.table.drive[3].zero_counts, written.cables[3].zero_counts);
}

TEST_F(CalibrationFile, IsRefusedWithFieldValueAllowedAndAdvice) {
  const auto nothing = [](Json&) {};
  EXPECT_EQ(message(nothing), "");
  const auto has = [](const std::string& text, const Facts& facts) { EXPECT_TRUE(names(text, facts)); };
  has(message([](Json& c) { c["cables"][2]["zero_counts"] = 5; }, false), {"arm.json", "sha256"});
  has(message([](Json& c) { c["robot"] = "other"; }), {"arm.json", "robot", "other", "zhu2022"});
  has(message([](Json& c) { c["robot_sha256"] = std::string(64, '0'); }), {"robot_sha256", "robot table"});
  has(message([](Json& c) { c["date"] = "2025-06-14"; }), {"date", "2025-06-14", "0", "365 days", "2026-06-15"});
  EXPECT_EQ(message([](Json& c) { c["date"] = "2025-06-15"; }), "");
  has(message([](Json& c) { c["date"] = "2026-06-16"; }), {"date", "2026-06-16", "clock"});
  has(message([](Json& c) { c["date"] = "2026-02-30"; }), {"date", "2026-02-30"});
  has(message([](Json& c) { c["cables"][2]["direction"] = 0; }), {"cables[3].direction", "0", "1", "-1"});
  has(message([](Json& c) { c["cables"][2]["drum_radius_m"] = 0.02; }), {"cables[3].drum_radius_m", "0.02"});
  has(message([](Json& c) { c["cables"].erase(0); }), {"cables", "14 entries"});
}

}  // namespace
}  // namespace liana::calibration
