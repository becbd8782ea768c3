#include "host/apps/report/payload_figures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "host/apps/report/timeline.hpp"
#include "host/apps/report/truth_figures.hpp"
#include "host/base/json/json.hpp"

namespace liana::report {
namespace {

constexpr double kPeriod_s = 0.01;
constexpr double kHalf = 0.70710678118654752;  // the tip looks along x, two metres before the base
constexpr double kBefore_m = 0.005;            // of the pins from the face, where the servo ends

// What the truth has in a slot; what is left out is 0.
struct Moment {
  double x_m = 0.0, y_m = 0.0, z_m = -kBefore_m, tilt_deg = 0.0;
  double pushed_N = 0.0, depth_m = 0.0, captured = 0.0, lock = 0.0, torque_Nm = 0.0, base_m = 0.0, joint_deg = 0.0;
};

// A truth of one joint, slot by slot.
TruthLog truth_of(const std::vector<Moment>& moments) {
  const std::string file =
      testing::TempDir() + "liana-payload-" + testing::UnitTest::GetInstance()->current_test_info()->name() + ".bin";
  const Json columns = {
      "slot",           "torque_Nm_1", "base_deflection_m", "contact_x_N", "contact_y_N",    "contact_z_N",
      "contact_peak_N", "plate_x_m",   "plate_y_m",         "plate_z_m",   "plate_tilt_deg", "depth_m_1",
      "depth_m_2",      "depth_m_3",   "captured",          "latch",       "lock",           "holder",
      "joint_deg_1",    "wrist_fx_N",  "wrist_fy_N",        "wrist_fz_N",  "wrist_tx_Nm",    "wrist_ty_Nm",
      "wrist_tz_Nm",    "tip_x_m",     "tip_y_m",           "tip_z_m",     "tip_qw",         "tip_qx",
      "tip_qy",         "tip_qz"};
  {
    std::ofstream out(file, std::ios::binary);
    out << Json{{"columns", columns}}.dump() << '\n';
    double slot = 0.0;
    for (const Moment& m : moments) {
      const double row[] = {
          slot++,      m.torque_Nm, m.base_m, 0.0,        0.0,         -m.pushed_N, std::fabs(m.pushed_N),
          m.x_m,       m.y_m,       m.z_m,    m.tilt_deg, m.depth_m,   m.depth_m,   m.depth_m,
          m.captured,  0.0,         m.lock,   1.0,        m.joint_deg, 0.0,         0.0,
          -m.pushed_N, 0.2,         -0.1,     0.0,        2.0,         0.0,         0.0,
          kHalf,       0.0,         kHalf,    0.0};
      out.write(reinterpret_cast<const char*>(row), sizeof row);
    }
  }
  TruthLog log = TruthLog::load(file);
  std::filesystem::remove(file);
  return log;
}

Stage stage(std::uint64_t tick, const std::string& servo, const std::string& push, const std::string& end = "none",
            double set_N = 0.0) {
  Stage out;
  out.tick = tick;
  out.servo = servo;
  out.target = "adapter";
  out.place = Pose{{0.0, 0.0, -kBefore_m}, {1.0, 0.0, 0.0, 0.0}};
  out.push = push;
  out.push_end = end;
  out.set_N = set_N;
  return out;
}

Json figures_of(const TruthLog& truth, const std::vector<Stage>& stages) {
  Json report = Json::object();
  add_payload_figures(report, {truth, stages, kPeriod_s});
  return report;
}

// req:B24 req:B28
TEST(PayloadFigures, AServoIsJudgedByTheTrueWayOfThePins) {
  std::vector<Moment> moments;
  for (int i = 0; i <= 100; ++i) {
    Moment m;
    m.x_m = 0.010 * (1.0 - i / 100.0) + 0.0004;  // within 1 mm in all from slot 96 on: 0.0008, and 0.0003 across it
    m.y_m = 0.0003;
    m.z_m = -kBefore_m - 0.5 * (1.0 - i / 100.0) * (i < 90 ? 1.0 : 0.0);
    m.tilt_deg = 0.2;
    moments.push_back(m);
  }
  moments[50].x_m += 0.004;  // swings out, from where it was nearest at slot 49
  const Json report = figures_of(
      truth_of(moments), {stage(0, "approaching", "none"), stage(80, "dwelling", "none"), stage(100, "done", "none")});
  EXPECT_NEAR(report["servo_error_m"], 0.0005, 1e-12);
  EXPECT_NEAR(report["servo_error_deg"], 0.2, 1e-12);
  EXPECT_NEAR(report["lateral_sway_m"], 0.0039, 1e-9);
  EXPECT_NEAR(report["settling_s"], 0.95, 1e-9);
  EXPECT_TRUE(report["force_N"].is_null());
}

TEST(PayloadFigures, AServoThatIsNotThereAtItsEndHasNotSettled) {
  std::vector<Moment> moments(101);
  moments[100].x_m = 0.0011;
  const Json report = figures_of(truth_of(moments), {stage(0, "approaching", "none"), stage(100, "done", "none")});
  EXPECT_NEAR(report["servo_error_m"], 0.0011, 1e-12);
  EXPECT_TRUE(report["settling_s"].is_null());
}

TEST(PayloadFigures, AServoThatWasLostOrHadAnotherTargetHasNone) {
  const TruthLog truth = truth_of(std::vector<Moment>(101));
  Stage grapple = stage(0, "approaching", "none"), there = stage(40, "done", "none");
  grapple.target = there.target = "grapple";
  const Json report = figures_of(truth, {grapple, there, stage(50, "approaching", "none"), stage(90, "lost", "none")});
  EXPECT_TRUE(report["servo_error_m"].is_null());
}

// A push from slot 100 on: contact from slot 200, captured in slot 900, contact gone from slot 1000 on, locking from
// slot 1500 on.
std::vector<Moment> insertion() {
  std::vector<Moment> moments(2000);
  for (std::size_t i = 0; i < moments.size(); ++i) {
    Moment& m = moments[i];
    if (i >= 200 && i < 900) m.pushed_N = 25.0 * static_cast<double>(i - 200) / 700.0;
    if (i >= 900 && i < 1000) m.pushed_N = 10.0;
    if (i >= 1000) m.pushed_N = 2.0;
    m.depth_m = i < 200 ? 0.0 : 0.0205 * std::min(1.0, static_cast<double>(i - 200) / 700.0);
    if (i >= 1500) m.depth_m = 0.0235;
    m.captured = i >= 900 ? 1.0 : 0.0;
    m.lock = i >= 1500 ? 1.0 : 0.0;
    m.torque_Nm = i < 100 || i > 1200 ? 90.0 : -40.0;
    m.base_m = i < 100 || i > 1200 ? 0.1 : 0.005;
  }
  return moments;
}

const std::vector<Stage> kPush{stage(100, "standby", "taring"), stage(150, "standby", "pressing", "none", 30.0),
                               stage(905, "standby", "unloading", "captured")};

// req:B22 req:B25 req:B28
TEST(PayloadFigures, APushIsJudgedFromItsBeginUntilTheContactIsGone) {
  const Json report = figures_of(truth_of(insertion()), kPush);
  EXPECT_NEAR(report["force_N"], 25.0 * 674.5 / 700.0, 0.01) << "a mean over 0.5 s";
  EXPECT_NEAR(report["force_rise_s"], 1.0 + 0.95 * 6.745 + 0.25, 0.02);
  EXPECT_NEAR(report["peak_force_N"], 25.0, 0.05);
  EXPECT_NEAR(report["insertion_m"], 0.0205, 1e-9) << "what the lock drive does is no insertion";
  EXPECT_NEAR(report["unload_s"], 1.0, 1e-9);
  EXPECT_NEAR(report["load_duration_s"], 8.0, 0.02);
  EXPECT_DOUBLE_EQ(report["peak_joint_torque_Nm"], 40.0) << "of the push alone, whatever the sign";
  EXPECT_DOUBLE_EQ(report["base_deflection_m"], 0.005);
}

// req:B25
TEST(PayloadFigures, APushTellsSixAxesAtEndAndBaseAndWhatItOvercame) {
  std::vector<Moment> moments = insertion();
  moments[50].pushed_N = 70.0;  // before the push: counts for nothing
  const Json report = figures_of(truth_of(moments), kPush);
  const double most_N = 25.0 * 699.0 / 700.0;
  EXPECT_NEAR(report["end_force_N"][2], most_N, 1e-9);
  EXPECT_NEAR(report["end_torque_Nm"][0], 0.2, 1e-9);
  EXPECT_NEAR(report["base_force_N"][0], most_N, 1e-9) << "the tip's z is the base's x";
  EXPECT_NEAR(report["base_force_N"][2], 0.0, 1e-9);
  EXPECT_NEAR(report["base_torque_Nm"][1], 0.1, 1e-9) << "the force goes through the base";
  EXPECT_NEAR(report["base_torque_Nm"][2], 0.2, 1e-9);
  EXPECT_NEAR(report["resisted_N"], 10.0, 1e-9) << "in the slot of the capture";
  EXPECT_NEAR(report["margin_N"], 20.0, 1e-9) << "of the 30 that were set";
}

TEST(PayloadFigures, AContactThatComesBackWithinASecondIsNotGone) {
  std::vector<Moment> moments = insertion();
  moments[1050].pushed_N = 6.0;
  EXPECT_NEAR(figures_of(truth_of(moments), kPush)["unload_s"], 1.51, 1e-9);
  for (std::size_t i = 900; i < moments.size(); i += 50) moments[i].pushed_N = 6.0;
  const Json never = figures_of(truth_of(moments), kPush);
  EXPECT_TRUE(never["unload_s"].is_null());
  EXPECT_TRUE(never["load_duration_s"].is_null());
  EXPECT_FALSE(never["force_N"].is_null());
}

TEST(PayloadFigures, ACaptureThatIsOnlyToldUnloadsNothing) {
  std::vector<Moment> moments = insertion();
  for (Moment& m : moments) m.captured = 0.0;
  const Json report = figures_of(truth_of(moments), kPush);
  EXPECT_TRUE(report["unload_s"].is_null());
  EXPECT_TRUE(report["margin_N"].is_null());
  EXPECT_NEAR(report["insertion_m"], 0.0205, 1e-3);
}

TEST(PayloadFigures, OfSeveralPushesTheLastCounts) {
  std::vector<Stage> stages{stage(1, "standby", "pressing", "none", 30.0), stage(50, "standby", "yielding", "aside")};
  stages.insert(stages.end(), kPush.begin(), kPush.end());
  EXPECT_EQ(figures_of(truth_of(insertion()), stages), figures_of(truth_of(insertion()), kPush));
}

// req:B19
TEST(PayloadFigures, ASuccessWhosePayloadIsNotTrulyCapturedIsNone) {
  Json lied = {{"truly_captured", false}}, true_one = {{"truly_captured", true}};
  EXPECT_NE(judge(lied, {}).find("truly_captured"), std::string::npos);
  EXPECT_EQ(judge(true_one, {}), "");
}

// req:B26
TEST(PayloadFigures, WhetherASerialArmStandsAtTheEndIsSeenByItsJoints) {
  std::vector<Moment> moments(100);
  for (std::size_t i = 0; i < moments.size(); ++i)
    moments[i].joint_deg = 0.002 * static_cast<double>(std::min<std::size_t>(i, 60));
  Json report = Json::object();
  add_aftermath(report, truth_of(moments), 20, kPeriod_s);
  EXPECT_NEAR(report["after_failure_s"], 0.4, 1e-9);
  EXPECT_TRUE(report["ends_at_rest"]);
  moments.resize(50);
  add_aftermath(report, truth_of(moments), 20, kPeriod_s);
  EXPECT_FALSE(report["ends_at_rest"]);
}

// req:B27
TEST(Timeline, HasStepsStagesTruthAndFaultsInTheirOrder) {
  const TruthLog truth = truth_of(insertion());
  const Json steps = {{{"name", "push"}, {"outcome", "success"}, {"start_tick", 100}, {"end_tick", 905}}};
  const Json faults = {{{"kind", "jam"}, {"begun_slot", 300}, {"ended_slot", nullptr}}};
  const Json timeline = timeline_of({truth, kPush, kPeriod_s}, steps, faults, 100);
  const Json expected = {{{"event", "push begins"}, {"time_s", 0.0}},
                         {{"event", "force control begins"}, {"time_s", 0.0}},
                         {{"event", "set force 30.0"}, {"time_s", 0.5}},
                         {{"event", "contact"}, {"time_s", 1.01}},
                         {{"event", "fault jam begins"}, {"time_s", 2.0}},
                         {{"event", "captured"}, {"time_s", 8.0}},
                         {{"event", "push ends: success"}, {"time_s", 8.05}},
                         {{"event", "force control ends: captured"}, {"time_s", 8.05}},
                         {{"event", "set force 0"}, {"time_s", 8.05}},
                         {{"event", "lock closing"}, {"time_s", 14.0}}};
  EXPECT_EQ(timeline, expected) << timeline.dump(1);
}

TEST(Stages, AreKeptWhereTheyChange) {
  std::vector<Stage> stages;
  Json state = {{"tick", 5},
                {"servo", {{"phase", "approaching"}, {"target", "adapter"}, {"place", {0, 0, -1, 1, 0, 0, 0}}}},
                {"insert", {{"phase", "none"}, {"end", "none"}, {"force_setpoint_N", 0.0}}},
                {"adapter", {{"captured", false}}}};
  keep_stage(stages, state);
  state["tick"] = 10;
  keep_stage(stages, state);
  state["tick"] = 15, state["servo"]["phase"] = "done";
  keep_stage(stages, state);
  ASSERT_EQ(stages.size(), 2u);
  EXPECT_EQ(stages[1].tick, 15u);
  const std::vector<Span> servos = servos_of(stages);
  ASSERT_EQ(servos.size(), 1u);
  EXPECT_EQ(servos[0].begin_tick, 5u);
  EXPECT_EQ(servos[0].end_tick, 15u);
  EXPECT_EQ(servos[0].end, "done");
  EXPECT_DOUBLE_EQ(servos[0].place->position_m[2], -1.0);
}

}  // namespace
}  // namespace liana::report
