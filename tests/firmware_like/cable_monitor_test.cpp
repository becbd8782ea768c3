#include "firmware_like/cable/arm/cable_monitor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "firmware_like/cable/arm/cables.hpp"
#include "firmware_like/math/convert.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::cable {
namespace {

// Fifteen cables with steady readings until a test says otherwise.
class CableWatch : public ::testing::Test {
 protected:
  explicit CableWatch(double mu = 0.0) : robot_(zhu2022::table(mu)) {
    const CableLayout layout = cable_layout(robot_);
    for (std::size_t c = 0; c < zhu2022::kCables; ++c) {
      zero_payout_m_[c] = payout_m_[c] = layout.zero_length_m[c] + robot_.lead_m;
      path_m_[c] = layout.zero_length_m[c];
      tension_N_[c] = 40.0;
    }
    limits_ = make_cable_watch_limits(robot_, zero_payout_m_);
    run(10);
    EXPECT_EQ(faults_.count, 0);
  }

  void run(int ticks, bool usable = true) {
    for (int i = 0; i < ticks; ++i) {
      const CableReadings now{payout_m_, tension_N_, path_m_, residual_m_};
      watch_cables(robot_, limits_, now, usable && faults_.count == 0, ++tick_, state_, faults_);
    }
  }
  double jump_N() const { return robot_.cable_monitor.jump_N; }
  // The only fault there is.
  void expect_fault(FaultNumber number, std::int16_t index) {
    ASSERT_EQ(faults_.count, 1);
    EXPECT_EQ(faults_.fault[0].number, number);
    EXPECT_EQ(faults_.fault[0].index, index);
  }

  RobotParams robot_;
  CableVector zero_payout_m_{}, payout_m_{}, tension_N_{}, path_m_{}, residual_m_{};
  CableWatchLimits limits_;
  CableMonitorState state_;
  FaultList faults_;
  std::uint64_t tick_ = 0;
};

TEST_F(CableWatch, TensionThatFallsWithoutLengthIsASlipAfterItsConfirmation) {
  tension_N_[7] -= 1.1 * jump_N();
  run(kJumpConfirmTicks - 1);
  EXPECT_EQ(faults_.count, 0);
  run(1);
  expect_fault(FaultNumber::kCableSlip, 7);
  EXPECT_NEAR(faults_.fault[0].detail, 1e6 * 1.1 * jump_N() * zero_payout_m_[7] / robot_.cable_EA_N, 1.0)
      << "micrometres";
}

TEST_F(CableWatch, TheFirstAndTheLastCableSlipEitherWay) {
  for (const std::size_t c : {std::size_t{0}, zhu2022::kCables - 1}) {
    for (const double way : {1.1, -1.1}) {
      faults_ = {};
      run(1, false);
      run(2);
      tension_N_[c] += way * jump_N();
      run(kJumpConfirmTicks);
      expect_fault(FaultNumber::kCableSlip, static_cast<std::int16_t>(c));
    }
  }
}

TEST_F(CableWatch, LengthThatJumpsWithoutTensionIsASlip) {
  payout_m_[14] += 1.1 * jump_N() / limits_.stiffness_N_m[14];
  run(kJumpConfirmTicks);
  expect_fault(FaultNumber::kCableSlip, 14);
}

TEST_F(CableWatch, TensionThatFollowsTheLengthIsNone) {
  for (int i = 0; i < 100; ++i) {
    payout_m_[3] += 40e-6;  // the speed limit
    tension_N_[3] -= 40e-6 * limits_.stiffness_N_m[3];
    run(1);
  }
  EXPECT_EQ(faults_.count, 0);
}

TEST_F(CableWatch, LengthThatFollowsThePlannedPathIsNone) {
  for (int i = 0; i < 100; ++i) {
    payout_m_[3] += 40e-6;
    path_m_[3] += 40e-6;
    run(1);
  }
  EXPECT_EQ(faults_.count, 0);
}

TEST_F(CableWatch, ChangesBelowTheLimitInEveryCableAtOnceAreNone) {
  for (std::size_t c = 0; c < zhu2022::kCables; ++c) tension_N_[c] -= 0.9 * jump_N();
  run(10);
  EXPECT_EQ(faults_.count, 0);
}

TEST_F(CableWatch, OneWrongSampleIsNone) {
  tension_N_[5] += 100.0;
  run(1);
  tension_N_[5] -= 100.0;
  run(200);
  EXPECT_EQ(faults_.count, 0);
}

TEST_F(CableWatch, SamplesThatJumpToAndFroScatter) {
  for (int i = 0; i < 10 && faults_.count == 0; ++i) {
    tension_N_[5] += i % 2 == 0 ? 30.0 : -30.0;
    run(1);
  }
  expect_fault(FaultNumber::kTensionScatters, 5);
}

TEST_F(CableWatch, TheThirdJumpBackIsTheOneThatScatters) {
  for (const double way : {30.0, -30.0, 30.0, -30.0}) {
    EXPECT_EQ(faults_.count, 0);
    tension_N_[0] += way;
    run(1);
  }
  expect_fault(FaultNumber::kTensionScatters, 0);
}

TEST_F(CableWatch, JumpsThatGoOnTheSameWayAreNoScatterButASlip) {
  for (int i = 0; i < 6; ++i) {
    tension_N_[5] += 30.0;
    run(1);
  }
  EXPECT_EQ(faults_.count, 0);
  run(kJumpConfirmTicks - 1);
  expect_fault(FaultNumber::kCableSlip, 5);
}

TEST_F(CableWatch, OneJumpBackIsForgottenInEvery64thTick) {
  for (const double way : {30.0, -30.0, 30.0}) {
    tension_N_[5] += way;
    run(1);
  }
  tension_N_[5] -= 30.0;  // where it was: a third one
  state_.reversals = 1;
  run(1);
  EXPECT_EQ(state_.reversals, 2);
  while (tick_ + 1 < kScatterForgetTicks) run(1);
  EXPECT_EQ(state_.reversals, 2);
  run(1);
  EXPECT_EQ(state_.reversals, 1);
  run(static_cast<int>(kScatterForgetTicks) - 1);
  EXPECT_EQ(state_.reversals, 1);
  run(1);
  EXPECT_EQ(state_.reversals, 0);
}

TEST_F(CableWatch, WrongSamplesFarApartAreForgotten) {
  for (int i = 0; i < 20; ++i) {
    tension_N_[5] += 30.0;
    run(1);
    tension_N_[5] -= 30.0;
    run(2 * static_cast<int>(kScatterForgetTicks));
  }
  EXPECT_EQ(faults_.count, 0);
}

TEST_F(CableWatch, AContradictionThatGrowsIsFoundInItsSegmentHoweverSlowly) {
  for (int i = 0; i < 1000 && faults_.count == 0; ++i) {
    for (const std::size_t c : {9u, 10u, 11u}) residual_m_[c] += 1e-6;
    run(1);
  }
  expect_fault(FaultNumber::kHomingImplausible, 9);
  EXPECT_NEAR(faults_.fault[0].detail, 1e6 * robot_.cable_monitor.contradiction_m, 10.0 + kContradictionTicks);
}

// Every cable, both ways: at its limit, one step beyond it, and after how many ticks.
TEST_F(CableWatch, AContradictionIsMeasuredFromWhenWatchingBeganOnBothSidesOfItsLimit) {
  for (std::size_t c = 0; c < zhu2022::kCables; ++c) {
    const double limit_m = limits_.contradiction_m[c] =
        robot_.cable_monitor.contradiction_m * (1.0 + 0.01 * static_cast<double>(c));
    for (const double side : {1.0, -1.0}) {
      faults_ = {};
      residual_m_[c] = 0.0;
      run(1, false);
      run(1);
      residual_m_[c] = side * limit_m;
      run(40);
      EXPECT_EQ(faults_.count, 0) << c;
      residual_m_[c] = std::nextafter(residual_m_[c], side);
      for (int i = 0; i < 5 && state_.contradicts_ticks == 0; ++i) run(1);  // its segment's turn
      run(kContradictionTicks - 2);
      EXPECT_EQ(faults_.count, 0) << c;
      run(1);
      expect_fault(FaultNumber::kHomingImplausible, static_cast<std::int16_t>(c / 3 * 3));
    }
    residual_m_[c] = 0.0;
  }
}

class RubbingCables : public CableWatch {
 protected:
  RubbingCables() : CableWatch(0.1) {}
};

TEST_F(RubbingCables, OnlyATighterCableOfItsOwnSegmentHidesMoreOfACable) {
  for (std::size_t c = 0; c < zhu2022::kCables; ++c) {
    const auto limit_m = [&](double tension_N) {
      return limits_.contradiction_m[c] + tension_N * robot_.friction_mu * limits_.hidden_m_N[c];
    };
    const std::size_t first = c / 3 * 3;
    struct Row {
      std::size_t tight;
      double tension_N, share;
      int faults;
    };
    for (const Row& row : {Row{first, 100.0, 0.99, 0}, Row{first + 2, 100.0, 0.99, 0}, Row{first, 100.0, 1.01, 1},
                           Row{(first + 3) % 15, robot_.tension.plan_N, 1.01, 1},
                           Row{(first + 12) % 15, robot_.tension.plan_N, 1.01, 1}}) {
      faults_ = {};
      tension_N_.fill(robot_.tension.plan_N);
      tension_N_[row.tight] = 100.0;
      residual_m_[c] = 0.0;
      run(1, false);
      run(1);
      residual_m_[c] = row.share * limit_m(row.tension_N);
      run(40);
      EXPECT_EQ(faults_.count, row.faults) << c << ", tight " << row.tight;
    }
    residual_m_[c] = 0.0;
  }
}

TEST_F(CableWatch, AContradictionThatWasThereWhenWatchingBeganIsNone) {
  run(1, false);
  for (std::size_t c = 0; c < zhu2022::kCables; ++c) residual_m_[c] = 1e-3 * static_cast<double>(c);
  run(20);
  EXPECT_EQ(faults_.count, 0);
}

TEST_F(CableWatch, AContradictionThatIsSoonGoneIsNone) {
  for (int i = 0; i < 10; ++i) {
    residual_m_[9] = 1e-3;
    run(kContradictionTicks - 1);
    residual_m_[9] = 0.0;
    run(10);
  }
  EXPECT_EQ(faults_.count, 0);
}

TEST_F(CableWatch, WhatHappensWhileReadingsAreUnusableIsNone) {
  run(1, false);
  tension_N_[5] += 100.0;
  run(20);
  EXPECT_EQ(faults_.count, 0);
}

TEST_F(CableWatch, AReadingThatIsNoNumberDoesNotPass) {
  tension_N_[2] = std::numeric_limits<double>::quiet_NaN();
  run(1);
  EXPECT_EQ(faults_.count, 0);  // slack says so
  tension_N_[2] = 40.0;
  run(20);
  EXPECT_EQ(faults_.count, 0);
}

TEST(CableWatchLimits, FrictionHidesMostOfTheStretchOfLongCables) {
  const RobotParams robot = zhu2022::table();
  CableVector zero_payout_m{};
  const CableLayout layout = cable_layout(robot);
  for (std::size_t c = 0; c < zhu2022::kCables; ++c) zero_payout_m[c] = layout.zero_length_m[c] + robot.lead_m;
  const CableWatchLimits limits = make_cable_watch_limits(robot, zero_payout_m);
  for (std::size_t c = 0; c < zhu2022::kCables; ++c) {
    EXPECT_DOUBLE_EQ(limits.contradiction_m[c], robot.cable_monitor.contradiction_m);
    EXPECT_GT(limits.hidden_m_N[c], 0.0);
  }
  EXPECT_GT(limits.hidden_m_N[14], 5.0 * limits.hidden_m_N[0]);
}

TEST(CableWatchLimits, EachCablesFollowFromItsOwnLengthAndTheSegmentsUpToItsOwn) {
  RobotParams robot = zhu2022::table();
  for (std::size_t j = 0; j < 5; ++j) {
    robot.segment[j].modules = 8 - static_cast<std::int32_t>(j);
    robot.segment[j].theta_limit_rad = 0.3 - 0.02 * static_cast<double>(j);
  }
  CableVector zero_payout_m{};
  for (std::size_t c = 0; c < zhu2022::kCables; ++c) zero_payout_m[c] = 1.0 + 0.1 * static_cast<double>(c);
  const CableWatchLimits limits = make_cable_watch_limits(robot, zero_payout_m);
  for (std::size_t c = 0; c < zhu2022::kCables; ++c) {
    double wrap_rad = 0.0;
    for (std::size_t j = 0; j <= c / 3; ++j) wrap_rad += robot.segment[j].modules * robot.segment[j].theta_limit_rad;
    EXPECT_DOUBLE_EQ(limits.stiffness_N_m[c], robot.cable_EA_N / zero_payout_m[c]);
    EXPECT_DOUBLE_EQ(limits.hidden_m_N[c], wrap_rad * zero_payout_m[c] / robot.cable_EA_N);
  }
}

TEST(CableWatchLimits, FourCablesInASegmentAreWatchedToo) {
  const RobotParams robot = zhu2022::uneven_table();
  CableVector zero_payout_m{};
  const CableLayout layout = cable_layout(robot);
  for (std::size_t c = 0; c < as_index(robot.cable_count()); ++c)
    zero_payout_m[c] = layout.zero_length_m[c] + robot.lead_m;
  const CableWatchLimits limits = make_cable_watch_limits(robot, zero_payout_m);
  for (std::size_t c = 0; c < as_index(robot.cable_count()); ++c) {
    CableMonitorState state;
    FaultList faults;
    CableVector tension_N{}, residual_m{};
    for (std::uint64_t tick = 1; tick < 60; ++tick) {
      if (tick == 10) residual_m[c] = 0.01;
      watch_cables(robot, limits, {zero_payout_m, tension_N, layout.zero_length_m, residual_m}, faults.count == 0, tick,
                   state, faults);
    }
    ASSERT_EQ(faults.count, 1) << "cable " << c;
    EXPECT_EQ(faults.fault[0].index, c < 4 ? 0 : c < 7 ? 4 : 7) << "the first of its segment";
  }
}

}  // namespace
}  // namespace liana::cable
