// What both verification ends refuse of a serial arm: just outside each limit, and not just inside it.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "firmware_like/math/braking.hpp"
#include "host/control/verification/verify.hpp"
#include "tests/firmware_like/micro_arm.hpp"
#include "tests/message.hpp"

namespace liana::verification {
namespace {

using serial::SerialArm;
using Change = std::function<void(serial::Outputs&)>;

// Its third joint's range is not symmetric, so that a limit on the angle alone would be the wrong one.
serial::RobotParams uneven_table() {
  serial::RobotParams table = serial::micro::table();
  table.joint[2].low_rad = -0.2;
  table.joint[2].high_rad = 1.0;
  table.torque.most_travel_m = 0.2;
  table.torque.most_aside_m = 0.03;
  table.torque.most_force_N = 60.0;
  return table;
}
const serial::RobotParams kUnevenTable = uneven_table();

struct JudgedTwice {
  Refusal execution, simulation;
  std::string text;
};

// A prediction of five quiet ticks and a stop of three, with one tick changed.
JudgedTwice judge_twice(const Change& change, std::size_t at) {
  IssueStep<SerialArm> release;
  serial::Setpoint setpoint;
  setpoint.kind = CommandKind::kTip;
  const Candidate<SerialArm> candidate = release.candidate(setpoint, 1, 100, 5);
  Prediction<SerialArm> prediction;
  prediction.command_ticks = 5;
  prediction.comes_to_rest = true;
  prediction.ticks.resize(8);
  for (serial::Outputs& outputs : prediction.ticks) outputs.active_sequence = candidate.sequence();
  change(prediction.ticks[at]);
  const ExecutionVerdict execution = judge_execution<SerialArm>(kUnevenTable, candidate, prediction);
  const SimulationVerdict simulation = judge_motion<SerialArm>(kUnevenTable, candidate, prediction);
  return {execution.code, simulation.code, execution.text + simulation.text};
}

constexpr double kOver = 1.00001;  // more than rounding is granted
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

struct Row {
  const char* why;
  Change refused, passed;  // just outside and just inside
  Refusal code;
  Facts facts;  // that the refusal names
};

const double kRate = kUnevenTable.joint[4].rate_rad_s, kWay = kTargetSpeedMargin * kRate * kUnevenTable.tick_s;

// Changes a tick to one of a push.
Change pushing(const std::function<void(serial::InsertStatus&)>& change) {
  return [change](serial::Outputs& outputs) {
    outputs.push.phase = serial::InsertPhase::kPressing;
    change(outputs.push);
  };
}

const Row kRows[] = {
    {"214: a push too far",
     pushing([](serial::InsertStatus& p) { p.travel_m = -0.2011; }),
     pushing([](serial::InsertStatus& p) { p.travel_m = 0.2009; }),
     Refusal::kPushTube,
     {"push", "axis", "-201.1 mm", "201 mm"}},
    {"214: beside it",
     pushing([](serial::InsertStatus& p) { p.aside_m = 0.0311; }),
     pushing([](serial::InsertStatus& p) { p.aside_m = 0.0309; }),
     Refusal::kPushTube,
     {"push", "beside"}},
    {"214: with more force",
     pushing([](serial::InsertStatus& p) { p.set_N = 60.0 * kOver; }),
     pushing([](serial::InsertStatus& p) { p.set_N = 60.0; }),
     Refusal::kPushTube,
     {"push", "force", "60"}},
    {"107: a joint beyond the gate",
     [](serial::Outputs& o) { o.joint_command_rad[4] = kWay * kOver; },
     [](serial::Outputs& o) { o.joint_command_rad[4] = kWay; },
     Refusal::kJointTravel,
     {"travel", "joint 5"}},
    {"107: backwards, too",
     [](serial::Outputs& o) { o.joint_command_rad[4] = -kWay * kOver; },
     [](serial::Outputs& o) { o.joint_command_rad[4] = -kWay; },
     Refusal::kJointTravel,
     {"travel", "joint 5"}},
    {"202: a joint beyond its rate",
     [](serial::Outputs& o) { o.joint_rate_rad_s[4] = -kRate * kOver; },
     [](serial::Outputs& o) { o.joint_rate_rad_s[4] = -kRate; },
     Refusal::kJointRate,
     {"rate", "joint 5"}},
    {"203: a slow tip near a station",
     [](serial::Outputs& o) { o.tip_speed_m_s = 1.06 * kUnevenTable.tip.speed_m_s; },
     [](serial::Outputs& o) { o.tip_speed_m_s = 1.04 * kUnevenTable.tip.speed_m_s; },
     Refusal::kTipSpeed,
     {"tip speed"}},
    {"203: and turns slowly",
     [](serial::Outputs& o) { o.tip_rate_rad_s = 1.06 * kUnevenTable.tip.rate_rad_s; },
     [](serial::Outputs& o) { o.tip_rate_rad_s = 1.04 * kUnevenTable.tip.rate_rad_s; },
     Refusal::kTipSpeed,
     {"turn rate"}},
    {"205: what is no number",
     [](serial::Outputs& o) { o.tip_speed_m_s = kNone; },
     [](serial::Outputs&) {},
     Refusal::kNotFinite,
     {"finite"}},
    {"205: of a joint as well",
     [](serial::Outputs& o) { o.joint_rate_rad_s[6] = kNone; },
     [](serial::Outputs&) {},
     Refusal::kNotFinite,
     {"joint 7"}},
    {"206: a tip behind its target",
     [](serial::Outputs& o) { o.ik_position_error_m = 0.0051; },
     [](serial::Outputs& o) { o.ik_position_error_m = 0.0049; },
     Refusal::kUnreachable,
     {"distance"}},
    {"206: an attitude that is off",
     [](serial::Outputs& o) { o.ik_attitude_error_rad = 0.0101; },
     [](serial::Outputs& o) { o.ik_attitude_error_rad = 0.0099; },
     Refusal::kUnreachable,
     {"angle"}},
};

// req:C8
TEST(VerifyASerialArm, EveryLimitRefusesWhatIsJustOutsideAndPassesWhatIsJustInside) {
  for (const Row& row : kRows) {
    const JudgedTwice out = judge_twice(row.refused, 2), in = judge_twice(row.passed, 2);
    EXPECT_EQ(row.code, out.execution != Refusal::kNone ? out.execution : out.simulation) << row.why;
    EXPECT_TRUE(names(out.text, row.facts)) << row.why;
    EXPECT_EQ(in.execution, Refusal::kNone) << row.why << ": " << in.text;
    EXPECT_EQ(in.simulation, Refusal::kNone) << row.why << ": " << in.text;
  }
}

TEST(VerifyASerialArm, TheStopAfterTheCommandIsJudgedByTheSameLimits) {
  for (const Row& row : kRows) {
    const JudgedTwice out = judge_twice(row.refused, 7);
    EXPECT_EQ(row.code, out.execution != Refusal::kNone ? out.execution : out.simulation) << row.why;
  }
}

// 201: where a range is not symmetric, both its ends count, not the larger one.
TEST(VerifyASerialArm, AJointStaysBetweenTheTwoEndsOfItsRange) {
  const auto at = [](double joint_rad) {
    return judge_twice([&](serial::Outputs& o) { o.joint_command_rad[2] = joint_rad; }, 2).simulation;
  };
  EXPECT_EQ(at(1.0), Refusal::kNone);
  EXPECT_EQ(at(1.0 + 1e-5), Refusal::kJointAngle);
  EXPECT_EQ(at(-0.2), Refusal::kNone);
  EXPECT_EQ(at(-0.2 - 1e-5), Refusal::kJointAngle);
  EXPECT_EQ(at(-0.9), Refusal::kJointAngle) << "inside the larger end's distance from zero";
}

TEST(VerifyASerialArm, AJointThatTheArmHasNotIsNotJudged) {
  EXPECT_EQ(judge_twice([](serial::Outputs& o) { o.joint_command_rad[7] = 100.0; }, 2).simulation, Refusal::kNone);
}

}  // namespace
}  // namespace liana::verification
