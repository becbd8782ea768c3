// Each check of the execution end refuses what is just outside its limit and passes what is just inside.
#include "host/control/verification/verify.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "host/control/verification/model_watch.hpp"
#include "tests/firmware_like/zhu2022.hpp"
#include "tests/message.hpp"

namespace liana::verification {

namespace {

const cable::RobotParams kTable = cable::zhu2022::table();

struct Judged {
  Refusal execution;
  std::string text;
};

// A prediction of five quiet ticks and a stop, with `change` applied to one tick of the command (2) and one of the stop
// (6).
Judged judge(const std::function<void(cable::Outputs&)>& change, std::size_t at = 2, bool comes_to_rest = true) {
  IssueStep<cable::CableArm> release;
  cable::Setpoint setpoint;
  setpoint.kind = CommandKind::kTip;
  const Candidate<cable::CableArm> candidate = release.candidate(setpoint, 1, 100, 5);
  Prediction<cable::CableArm> prediction;
  prediction.command_ticks = 5;
  prediction.comes_to_rest = comes_to_rest;
  prediction.ticks.resize(8);
  for (cable::Outputs& outputs : prediction.ticks) {
    outputs.active_sequence = candidate.sequence();
    outputs.tension_plan_N.fill(40.0);
  }
  change(prediction.ticks[at]);
  const ExecutionVerdict execution = judge_execution<cable::CableArm>(kTable, candidate, prediction);
  return {execution.code, execution.text};
}

// req:C10
TEST(Verify, AQuietMotionPasses) {
  const Judged judged = judge([](cable::Outputs&) {});
  EXPECT_EQ(judged.execution, Refusal::kNone);
}

// A cable of the last segment that is so much tighter than planned.
Refusal model_refusal(double beyond_N, double bend_rad, double goal_rad, bool leads_back = false) {
  cable::Outputs now;
  now.state = OperatingState::kEnabled;
  now.friction.planned_mu = 0.05;
  now.tension_plan_N.fill(40.0);
  now.tension_measured_N = now.tension_plan_N;
  now.tension_measured_N[14] += beyond_N;
  now.theta_command_rad.fill(bend_rad);
  now.theta_measured_rad = now.theta_command_rad;
  cable::Outputs then = now;
  then.theta_command_rad.fill(goal_rad);
  ExecutionVerdict verdict;
  judge_model(kTable, now, then, leads_back, verdict);
  return verdict.code;
}

TEST(Verify, TheModelMayBeOffByTheFrictionOfTheWholeBendAndTheWayBackIsFree) {
  EXPECT_EQ(model_refusal(49.0, 0.0, 0.0), Refusal::kNone);
  EXPECT_EQ(model_refusal(51.0, 0.0, 0.0), Refusal::kModel);
  EXPECT_EQ(model_refusal(51.0, 0.34, 0.34), Refusal::kNone) << "friction may hold it";
  EXPECT_EQ(model_refusal(111.0, 0.34, 0.34), Refusal::kModel) << "not so much";
  EXPECT_EQ(model_refusal(111.0, 0.34, 0.33), Refusal::kNone) << "straighter";
  EXPECT_EQ(model_refusal(111.0, 0.34, 0.34, true), Refusal::kNone) << "back";
}

// A straight arm at its plan, with one thing changed.
Refusal model_refusal_of(const std::function<void(cable::Outputs&)>& change) {
  cable::Outputs now{};
  now.state = OperatingState::kEnabled;
  now.tension_plan_N.fill(40.0);
  now.tension_measured_N.fill(40.0);
  change(now);
  ExecutionVerdict verdict;
  judge_model(kTable, now, now, false, verdict);
  return verdict.code;
}

TEST(Verify, EveryCableAndJointOfTheModelIsComparedOnBothSides) {
  const double band_N = kModelTension_N + kModelTensionShare * 40.0;
  for (std::size_t c = 0; c < cable::zhu2022::kCables; ++c) {
    for (const double measured_N : {0.9, 1.1}) {
      EXPECT_EQ(model_refusal_of([&](auto& o) { o.tension_measured_N[c] += measured_N * band_N; }),
                measured_N < 1.0 ? Refusal::kNone : Refusal::kModel)
          << c;
    }
    const auto under = [c](double plan_N) {
      return model_refusal_of([&](auto& o) {
        o.tension_plan_N[c] = plan_N;
        o.tension_measured_N[c] = 40.0;
      });
    };
    EXPECT_EQ(under(139.0), Refusal::kNone) << c;
    EXPECT_EQ(under(141.0), Refusal::kModel) << c;
    const double floor_N = kTable.tension.floor_motor_N + 10.0 * kTable.tension.scale();
    for (const double beside_N : {-0.1, 0.1}) {
      const Refusal said = model_refusal_of([&](auto& o) {
        o.tension_plan_N[c] = 300.0;
        o.tension_measured_N[c] = floor_N + beside_N;
      });
      EXPECT_EQ(said, beside_N < 0.0 ? Refusal::kNone : Refusal::kModel) << c << ", near its floor";
    }
  }
  for (std::size_t k = 0; k < 10; ++k) {
    for (const double share : {0.99, -0.99, 1.01, -1.01}) {
      const Refusal said = model_refusal_of([&](auto& o) {
        o.theta_command_rad[k] = 0.05;
        o.theta_measured_rad[k] = 0.05 + share * kModelAngle_rad;
      });
      EXPECT_EQ(said, std::fabs(share) < 1.0 ? Refusal::kNone : Refusal::kModel) << k << " " << share;
    }
  }
  const auto far_off = [](auto& o) { o.theta_measured_rad[0] = 0.1; };
  for (const auto& unwatched :
       {std::function<void(cable::Outputs&)>([](auto& o) { o.state = OperatingState::kEnabling; }),
        std::function<void(cable::Outputs&)>([](auto& o) { o.faults.count = 1; })}) {
    EXPECT_EQ(model_refusal_of([&](auto& o) {
                far_off(o);
                unwatched(o);
              }),
              Refusal::kNone);
  }
}

// req:C8
TEST(Verify, ASpeedJustOverTheLimitIsRefusedAndJustUnderPasses) {
  const double rate = kTable.limits.theta_rate_rad_s;
  EXPECT_EQ(judge([&](cable::Outputs& o) { o.theta_rate_rad_s[4] = rate * 1.00001; }).execution, Refusal::kJointRate);
  EXPECT_EQ(judge([&](cable::Outputs& o) { o.theta_rate_rad_s[4] = -rate * 1.00001; }).execution, Refusal::kJointRate);
  EXPECT_EQ(judge([&](cable::Outputs& o) { o.theta_rate_rad_s[4] = rate; }).execution, Refusal::kNone);
  EXPECT_EQ(judge([&](cable::Outputs& o) { o.tip_speed_m_s = kTable.limits.tip_speed_m_s * 1.06; }).execution,
            Refusal::kTipSpeed);
  EXPECT_EQ(judge([&](cable::Outputs& o) { o.tip_speed_m_s = kTable.limits.tip_speed_m_s; }).execution, Refusal::kNone);
  EXPECT_EQ(judge([&](cable::Outputs& o) { o.tip_rate_rad_s = kTable.limits.tip_rate_rad_s * 1.06; }).execution,
            Refusal::kTipSpeed);
}

TEST(Verify, TheStopAfterTheCommandIsJudgedToo) {
  EXPECT_EQ(judge([&](cable::Outputs& o) { o.tip_speed_m_s = 1.0; }, 7).execution, Refusal::kTipSpeed);
  EXPECT_EQ(judge([](cable::Outputs& o) { o.limits = kLimitGate; }, 7).execution, Refusal::kGate);
  EXPECT_EQ(judge([](cable::Outputs&) {}, 2, false).execution, Refusal::kNoRest);
}

// req:C8
TEST(Verify, JointAnglesAreBounded) {
  const double limit = kTable.segment[4].theta_limit_rad;
  EXPECT_EQ(judge([&](cable::Outputs& o) { o.theta_command_rad[9] = limit + 1e-4; }).execution, Refusal::kJointAngle);
  EXPECT_EQ(judge([&](cable::Outputs& o) { o.theta_command_rad[9] = -limit; }).execution, Refusal::kNone);
}

// req:C11
TEST(Verify, WhatTheControllerWouldNotDoIsRefused) {
  EXPECT_EQ(judge([](cable::Outputs& o) { o.faults.count = 1; }).execution, Refusal::kTwinFault);
  EXPECT_EQ(judge([](cable::Outputs& o) { o.faults.dropped = 1; }).execution, Refusal::kTwinFault);
  EXPECT_EQ(judge([](cable::Outputs& o) { o.limits = kLimitGate; }).execution, Refusal::kGate);
  EXPECT_EQ(judge([](cable::Outputs& o) { o.active_sequence = 0; }).execution, Refusal::kNotAccepted);
  EXPECT_EQ(judge([](cable::Outputs& o) { o.active_sequence = 0; }, 6).execution, Refusal::kNone)
      << "after its expiry nothing need be in force";
  EXPECT_EQ(judge([](cable::Outputs& o) { o.limits = kLimitTipSpeed; }).execution, Refusal::kNone)
      << "limits that act are no refusal";
}

// req:C11
TEST(Verify, AFaultThatWouldBeLatchedIsNamedWithItsDrive) {
  const Judged judged = judge([](cable::Outputs& o) {
    o.faults.count = 1;
    o.faults.fault[0] = {.number = FaultNumber::kTensionScatters, .index = 3};
  });
  EXPECT_TRUE(names(judged.text, {"fault 5007", "tension_scatters", "4"}));
}

// req:C11
TEST(Verify, TensionAndCableSpeedStayWithinTheirLimits) {
  EXPECT_EQ(judge([](cable::Outputs& o) { o.tension_plan_N[7] = kTable.tension.ceiling_free_N + 0.1; }).execution,
            Refusal::kTension);
  EXPECT_EQ(judge([](cable::Outputs& o) { o.tension_plan_N[7] = kTable.tension.floor_motor_N - 0.1; }).execution,
            Refusal::kTension);
  EXPECT_EQ(judge([](cable::Outputs& o) { o.tension_plan_N[7] = kTable.tension.floor_motor_N; }).execution,
            Refusal::kNone);
  EXPECT_EQ(judge([](cable::Outputs& o) { o.tension_plan_N[20] = 0.0; }).execution, Refusal::kNone)
      << "there is no cable 21";
  const double most_m = kTable.limits.cable_speed_m_s * kTable.tick_s;
  EXPECT_EQ(judge([&](cable::Outputs& o) { o.payout_command_m[0] = most_m; }).execution, Refusal::kNone);
  EXPECT_EQ(judge([&](cable::Outputs& o) { o.payout_command_m[0] = 1.3 * most_m; }).execution, Refusal::kCableSpeed);
}

// An arm with weight that comes to rest with this torque about its first angle, from where it has another.
Refusal held(double from_Nm, double to_Nm, CommandKind kind = CommandKind::kTip, double gravity_m_s2 = 9.8) {
  cable::RobotParams table = kTable;
  table.gravity_m_s2[2] = -gravity_m_s2;
  IssueStep<cable::CableArm> release;
  cable::Setpoint setpoint;
  setpoint.kind = kind;
  const Candidate<cable::CableArm> candidate = release.candidate(setpoint, 1, 100, 5);
  Prediction<cable::CableArm> prediction;
  prediction.comes_to_rest = true;
  prediction.ticks.resize(2);
  for (cable::Outputs& outputs : prediction.ticks) outputs.tension_plan_N.fill(kTable.tension.ceiling_free_N);
  prediction.ticks[0].load_Nm[0] = from_Nm;
  prediction.ticks[1].load_Nm[0] = to_Nm;
  return judge_execution<cable::CableArm>(table, candidate, prediction).code;
}

// req:A4
TEST(Verify, ALoadThatTheCablesCannotHoldIsRefusedButForTheWayBack) {
  double holds_Nm = 0.0, beyond_Nm = 1000.0;
  while (beyond_Nm - holds_Nm > 1e-3) {
    const double middle_Nm = 0.5 * (holds_Nm + beyond_Nm);
    (held(0.0, middle_Nm) == Refusal::kNone ? holds_Nm : beyond_Nm) = middle_Nm;
  }
  // Two of three cables, eight joints each: a few times what one cable gives with its ceiling.
  EXPECT_GT(holds_Nm, 8 * kTable.segment[0].hole_radius_m * (kTable.tension.ceiling_free_N - kTable.tension.plan_N));
  EXPECT_LT(holds_Nm, 2 * 8 * kTable.segment[0].hole_radius_m * kTable.tension.ceiling_free_N);
  EXPECT_EQ(held(0.0, beyond_Nm), Refusal::kTension);
  EXPECT_EQ(held(beyond_Nm + 1.0, beyond_Nm), Refusal::kNone) << "less than before";
  EXPECT_EQ(held(beyond_Nm, beyond_Nm + 1.0), Refusal::kTension) << "more than before";
  EXPECT_EQ(held(0.0, beyond_Nm, CommandKind::kRetract), Refusal::kNone);
  EXPECT_EQ(held(0.0, beyond_Nm, CommandKind::kTip, 0.0), Refusal::kNone) << "inertia alone is for the simulation";
}

TEST(Verify, NotANumberNeverPasses) {
  EXPECT_EQ(judge([](cable::Outputs& o) { o.tip_speed_m_s = std::nan(""); }).execution, Refusal::kNotFinite);
  EXPECT_EQ(judge([](cable::Outputs& o) { o.theta_command_rad[0] = std::nan(""); }).execution, Refusal::kNotFinite);
  EXPECT_EQ(judge([](cable::Outputs& o) { o.tension_plan_N[0] = HUGE_VAL; }).execution, Refusal::kNotFinite);
}

TEST(Verify, ARefusalNamesWhatWhereAndTheLimit) {
  const std::string text = judge([](cable::Outputs& o) { o.theta_command_rad[9] = 1.0; }).text;
  EXPECT_NE(text.find("theta 10 = "), std::string::npos) << text;
  EXPECT_TRUE(names(text, {"theta 10", "20 deg"}));
}

// req:C11
TEST(Verify, AVerdictAfterTheIntervalBeganIsTooSlow) {
  IssueStep<cable::CableArm> release;
  const Candidate<cable::CableArm> candidate = release.candidate(cable::Setpoint{}, 1, 100, 5);
  ExecutionVerdict verdict;
  judge_time(candidate.first_tick(), 99, verdict);
  EXPECT_TRUE(verdict.passed());
  judge_time(candidate.first_tick(), 100, verdict);
  EXPECT_EQ(verdict.code, Refusal::kTooSlow);
}

}  // namespace
}  // namespace liana::verification
