#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "host/apps/report/run_report.hpp"
#include "host/apps/report/truth.hpp"
#include "host/base/json/json.hpp"
#include "tests/message.hpp"

namespace liana::report {
namespace {

// A directory that goes away with the test.
class RunReport : public testing::Test {
 protected:
  RunReport() {
    directory_ = testing::TempDir() + "liana-report-" +
                 std::to_string(::testing::UnitTest::GetInstance()->random_seed()) + "-" +
                 testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(directory_);
  }
  ~RunReport() override { std::filesystem::remove_all(directory_); }

  std::string file(const std::string& name) const { return directory_ + "/" + name; }
  void write(const std::string& name, const std::string& text) const { std::ofstream(file(name)) << text; }

  // One row per slot 0..9; the tip moves along x, clearance falls by 1 mm a slot. The tip is in the slit in slots 3 to
  // 5; the arm rests from slot 8 on.
  void write_truth() const {
    std::ofstream out(file("truth.bin"), std::ios::binary);
    const Json columns = {"slot",
                          "theta_deg_1",
                          "theta_deg_2",
                          "tip_x_m",
                          "tip_y_m",
                          "tip_z_m",
                          "tip_qw",
                          "tip_qx",
                          "tip_qy",
                          "tip_qz",
                          "clearance_m",
                          "slit_clearance_m",
                          "sphere_clearance_m",
                          "contact_force_N",
                          "rod_force_N",
                          "tension_min_N",
                          "tension_motor_min_N",
                          "tension_motor_max_N",
                          "tip_speed_m_s",
                          "fastest_deg_s",
                          "slit_depth_m"};
    out << Json{{"columns", columns}}.dump() << '\n';
    for (int slot = 0; slot < 10; ++slot) {
      const double s = slot;
      const double row[] = {s,
                            1 + s,
                            2 + s,
                            0.1 * s,
                            0,
                            0,
                            1,
                            0,
                            0,
                            0,
                            0.02 - 0.001 * s,
                            0.03 - 0.001 * s,
                            0.5,
                            s,
                            0.5,
                            20 - s,
                            30 - s,
                            40 + s,
                            0.01 * s,
                            slot < 8 ? 1.0 : 0.05,
                            slot >= 3 && slot <= 5 ? 0.1 : -0.1};
      out.write(reinterpret_cast<const char*>(row), sizeof row);
    }
    out.write("cut", 3);
  }

  ReportSources sources() const {
    ReportSources sources;
    sources.time_mode = "fast";
    sources.truth_file = file("truth.bin");
    sources.mission_report_file = file("mission.json");
    sources.bus_stats_file = file("stats.json");
    sources.states = {{0, {}}, {5, {{0.49, 0.0, 0.0}, {1, 0, 0, 0}}}, {9, {{0.9, 0.0, 0.0}, {1, 0, 0, 0}}}};
    sources.rod = {{0.5, 0.003, 0.0}, {std::cos(0.001), std::sin(0.001), 0.0, 0.0}};
    sources.has_slit = true;
    return sources;
  }

 private:
  std::string directory_;
};

constexpr const char* kMission = R"({"outcome":"success","repair_tick":5,"steps":[
  {"name":"prepare","device":"none","held_theta":[],"duration_s":0.008,"outcome":"done","start_tick":2,"end_tick":4},
  {"name":"go","device":"hand","held_theta":[9],"duration_s":0.004,"outcome":"done","start_tick":4,"end_tick":5}]})";

TEST_F(RunReport, WhatTheOperatorToldIsTakenInAndToldInWords) {
  write("mission.json", kMission);
  write("operator.json", R"({"hand_to_tip_lag_s":{"commanded":{"median":0.5,"worst":0.75},"measured":null},
    "peak_hand_force_N":1.5,"min_port_energy_J":-0.01})");
  ReportSources all = sources();
  all.operator_file = file("operator.json");
  const Json report = make_report(all);
  EXPECT_DOUBLE_EQ(report["hand_to_tip_lag_s"]["commanded"]["worst"], 0.75);
  EXPECT_DOUBLE_EQ(report["min_port_energy_J"], -0.01);
  const std::string text = report_text(report);
  EXPECT_TRUE(names(text, {"0.50 s", "0.75 s"}));
  EXPECT_TRUE(names(text, {"energy", "-0.010 J"}));
}

// req:A53
TEST_F(RunReport, TruthIsTakenFromStepOneToTheRepairCommand) {
  write_truth();
  write("mission.json", kMission);
  const Json welcome = {{"config_hash", "abc"}, {"period_s", 0.004}};
  ReportSources all = sources();
  all.welcome = &welcome;
  const Json report = make_report(all);
  EXPECT_EQ(report["outcome"], "success");
  EXPECT_EQ(report["ticks"], 3);
  EXPECT_DOUBLE_EQ(report["duration_s"], 0.012);
  EXPECT_DOUBLE_EQ(report["min_clearance_m"], 0.015);
  EXPECT_DOUBLE_EQ(report["min_slit_clearance_m"], 0.025);
  EXPECT_DOUBLE_EQ(report["max_contact_force_N"], 5.0);
  EXPECT_DOUBLE_EQ(report["peak_force_N"], 5.0);
  EXPECT_EQ(report["contacts"], 1);
  EXPECT_DOUBLE_EQ(report["cable_tension_N"]["min"], 15.0);
  EXPECT_DOUBLE_EQ(report["cable_tension_N"]["min_motor"], 25.0);
  EXPECT_DOUBLE_EQ(report["cable_tension_N"]["max"], 45.0);
  EXPECT_EQ(report["final_theta_deg"], Json({6.0, 7.0}));
  EXPECT_EQ(report["steps"][1]["held_theta"], Json({9}));
}

TEST_F(RunReport, TheNearestBodyIsNamedWhateverItsKind) {
  write_truth();
  write("mission.json", kMission);
  ReportSources all = sources();
  all.body_at = [](const std::vector<double>&) { return Json{{"body", "drum"}, {"link", 3}}; };
  const Json report = make_report(all);
  EXPECT_EQ(report["nearest"], (Json{{"body", "drum"}, {"link", 3}, {"clearance_m", 0.015}}));
  EXPECT_NE(report_text(report).find(", least 15.0 mm to drum\n"), std::string::npos) << report_text(report);
}

TEST_F(RunReport, ErrorsCompareTheTrueTipWithTheRodAndWithWhatWasCommanded) {
  write_truth();
  write("mission.json", kMission);
  const Json report = make_report(sources());
  EXPECT_NEAR(report["tip_error_m"], 0.003, 1e-12);
  EXPECT_NEAR(report["tip_attitude_error_rad"], 0.002, 1e-12);
  EXPECT_NEAR(report["open_loop_tip_error_m"], 0.01, 1e-12);
}

TEST_F(RunReport, ABodyThatWasTouchedIsNamedAndBoxesAreNoSlitWhereThereIsNone) {
  write_truth();
  write("mission.json", kMission);
  const Json welcome = {{"period_s", 0.004}};
  ReportSources all = sources();
  all.welcome = &welcome;
  all.has_slit = false;
  all.body_at = [](const std::vector<double>& theta_deg) {
    return Json{{"body", "crate at " + std::to_string(static_cast<int>(theta_deg.front()))}, {"link", 7}};
  };
  const Json report = make_report(all);
  EXPECT_EQ(report["contact"]["body"], "crate at 6") << "where the contact is hardest";
  EXPECT_EQ(report["contact"]["link"], 7);
  EXPECT_DOUBLE_EQ(report["contact"]["force_N"], 5.0);
  EXPECT_FALSE(report.contains("min_slit_clearance_m"));
  EXPECT_DOUBLE_EQ(report["min_box_clearance_m"], 0.025);
  const std::string text = report_text(report);
  EXPECT_TRUE(names(text, {"touched", "link 7", "crate at 6", "5.00 N"}));
  EXPECT_TRUE(names(text, {"clearance", "boxes", "25.0 mm"}));
  Json failed = Json::parse(kMission);
  failed["outcome"] = "failed", failed["reason"] = "too slow";
  write("mission.json", failed.dump());
  const std::string reason = make_report(all)["reason"];
  EXPECT_TRUE(names(reason, {"too slow", "touched", "link 7", "crate at 10", "9.00 N"})) << "of the whole run";
}

TEST_F(RunReport, SpeedInTheSlitIsThatOfTheTrueTipBetweenThePlates) {
  write_truth();
  write("mission.json", kMission);
  const Json report = make_report(sources());
  EXPECT_DOUBLE_EQ(report["max_tip_speed_slit_m_s"], 0.05);
  EXPECT_DOUBLE_EQ(report["max_tip_speed_m_s"], 0.05);
  EXPECT_FALSE(report.contains("after_failure_s")) << "nothing failed";
}

TEST_F(RunReport, AMissionThatFailedShowsAllThatCameAfterItToo) {
  write_truth();
  write(
      "mission.json",
      R"({"outcome":"failed","reason":"fault 5006","steps":[{"name":"go","outcome":"failed","start_tick":2,"end_tick":4}]})");
  const Json welcome = {{"period_s", 0.004}};
  ReportSources all = sources();
  all.welcome = &welcome;
  const Json report = make_report(all);
  EXPECT_EQ(report["reason"], "fault 5006");
  EXPECT_DOUBLE_EQ(report["max_contact_force_N"], 9.0) << "of the last row";
  EXPECT_DOUBLE_EQ(report["min_slit_clearance_m"], 0.021);
  EXPECT_DOUBLE_EQ(report["cable_tension_N"]["min"], 11.0);
  EXPECT_DOUBLE_EQ(report["after_failure_s"], 3 * 0.004) << "it moves until slot 7";
  EXPECT_EQ(report["ends_at_rest"], true);
  EXPECT_DOUBLE_EQ(report["duration_s"], 2 * 0.004) << "of the mission itself";
}

TEST_F(RunReport, ASuccessHasToKeepTensionAndSpeedAndNamesTheFirstThatItDidNot) {
  write_truth();
  write("mission.json", kMission);
  ReportSources all = sources();
  all.criteria = {25.0, 15.0, 0.05, {}};
  Json report = make_report(all);
  EXPECT_EQ(report["outcome"], "success") << "each at its limit";
  ASSERT_EQ(report["criteria"].size(), 3u);
  EXPECT_EQ(report["criteria"][0],
            Json({{"name", "tension_at_motor"}, {"value", 25.0}, {"limit", 25.0}, {"met", true}}));
  struct Case {
    Criteria criteria;
    Facts facts;
  };
  for (const Case& test : {Case{{25.1, 1.0, 1.0, {}}, {"25 N", "25.1", "tension_at_motor"}},
                           Case{{1.0, 15.1, 1.0, {}}, {"15 N", "15.1", "tension_anywhere"}},
                           Case{{1.0, 1.0, 0.049, {}}, {"0.05 m/s", "0.049", "tip_speed_in_slit"}},
                           Case{{{}, {}, {}, 0.5}, {"m", "0.5", "touches_nothing"}}}) {
    all.criteria = test.criteria;
    report = make_report(all);
    EXPECT_EQ(report["outcome"], "failed");
    EXPECT_TRUE(names(report["reason"].text(), test.facts));
  }
}

TEST_F(RunReport, CriteriaAreTheTablesTheMotorsOnlyWhereCablesAreAsPlannedWith) {
  const Json robot =
      Json::parse(R"({"tension":{"floor_motor_N":15,"floor_anywhere_N":1},"limits":{"tip_speed_slit_m_s":0.03}})");
  EXPECT_EQ(criteria_of(robot, "nominal").min_motor_tension_N, 15.0);
  EXPECT_FALSE(criteria_of(robot, "worn").min_motor_tension_N);
  EXPECT_EQ(criteria_of(robot, "worn").least_tension_N, 1.0);
  EXPECT_DOUBLE_EQ(*criteria_of(robot, "worn").max_slit_speed_m_s, 0.0315) << "it swings about the 0.03 that are asked";
  const Criteria serial = criteria_of(Json::parse(R"({"kind":"serial"})"), "nominal");
  EXPECT_FALSE(serial.least_tension_N);
  EXPECT_EQ(serial.required_clearance_m, 0.0);
}

TEST_F(RunReport, TheRodIsWhereTheBenchSaysItReallyIs) {
  write_truth();
  write("mission.json", kMission);
  write("summary.json", R"({"rod":[0.51,0.0,0.0,1.0,0.0,0.0,0.0]})");
  ReportSources all = sources();
  all.bench_summary_file = file("summary.json");
  EXPECT_NEAR(make_report(all)["tip_error_m"], 0.01, 1e-12);
}

TEST_F(RunReport, AnOutcomeOfTheRunGoesBeforeTheMissions) {
  write_truth();
  write("mission.json", kMission);
  ReportSources all = sources();
  all.outcome = "aborted";
  EXPECT_EQ(make_report(all)["outcome"], "aborted");
}

TEST_F(RunReport, SaysWhatRan) {
  ReportSources all = sources();
  all.robot = "zhu2022";
  all.mission = "my.lua";
  all.physics = "worn";
  all.seed = 9007199254740991;
  const Json report = make_report(all);
  EXPECT_EQ(report["robot"], "zhu2022");
  EXPECT_EQ(report["mission"], "my.lua");
  EXPECT_EQ(report["physics"], "worn");
  EXPECT_EQ(report["seed"], 9007199254740991u);
}

TEST_F(RunReport, StepsOfAMissionRunnerThatLeftNoReportLastAsLongAsTheyWereSeen) {
  const Json welcome = {{"period_s", 0.004}};
  ReportSources all = sources();
  all.welcome = &welcome;
  all.announced = {{1, "prepare", "none", 2, 5}, {2, "go", "hand", 5, 8}};
  const Json report = make_report(all);
  ASSERT_EQ(report["steps"].size(), 2u);
  EXPECT_EQ(report["steps"][0]["outcome"], "success");
  EXPECT_DOUBLE_EQ(report["steps"][0]["duration_s"], 0.012);
  EXPECT_EQ(report["steps"][1]["outcome"], "failed");
  EXPECT_EQ(report["steps"][1]["name"], "go");
  EXPECT_DOUBLE_EQ(report["steps"][1]["duration_s"], 0.012);
  EXPECT_DOUBLE_EQ(report["duration_s"], 0.024);
}

TEST_F(RunReport, WithoutAMissionReportTheOutcomeIsFailed) {
  const Json report = make_report(sources());
  EXPECT_EQ(report["outcome"], "failed");
  EXPECT_FALSE(report.contains("tip_error_m"));
}

TEST_F(RunReport, TheWiresOwnCountsGoBeforeTheDaemons) {
  const Json state = Json::parse(R"({"buses":[{"name":"can0","frames":1,"worst_load":0.5,"measured_load":0.1}]})");
  write("stats.json", R"({"buses":[{"name":"can0","frames":77,"load":0.4}]})");
  ReportSources all = sources();
  all.last_state = &state;
  const Json bus = make_report(all)["buses"][0];
  EXPECT_EQ(bus["frames"], 77);
  EXPECT_EQ(bus["worst_load"], 0.5);
  EXPECT_EQ(bus["measured_load"], 0.4);
}

TEST_F(RunReport, ATruthLogFindsTheRowOfASlotAndDropsACutRow) {
  write_truth();
  const TruthLog truth = TruthLog::load(file("truth.bin"));
  EXPECT_EQ(truth.row_count(), 10u);
  EXPECT_EQ(truth.row_of_slot(7), 7u);
  EXPECT_EQ(truth.row_of_slot(99), 9u);
  EXPECT_THROW(truth.at(0, "no_such_column"), std::runtime_error);
  EXPECT_THROW(TruthLog::load(file("nothing")), std::runtime_error);
}

}  // namespace
}  // namespace liana::report
