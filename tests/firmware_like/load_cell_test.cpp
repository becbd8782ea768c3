// Load cells: when a reading counts in place of the drive's torque, and what a bad one becomes. req:A10
#include "firmware_like/cable/arm/load_cell.hpp"

#include <gtest/gtest.h>

#include "tests/firmware_like/safety_bench.hpp"

namespace liana::cable {
namespace {

using safety_bench::has;

constexpr WatchScope kWithoutPower{false, false}, kWithPower{true, true};
constexpr std::size_t kFirstCable = 0, kLastCable = safety_bench::kDrives - 1;

// Cells of 0.02 N a step on all cables but the second, and what the arm makes of them tick by tick.
struct Cells {
  explicit Cells(bool goes_on = false) {
    for (std::size_t c = 0; c <= kLastCable; ++c) table.load_cell.newtons_per_step[c] = c == 1 ? 0.0 : 0.02;
    table.load_cell.range_N = 500.0;
    table.load_cell.agree_N = 20.0;
    table.load_cell.goes_on = goes_on ? 1 : 0;
  }
  // One tick in which the cell of `cable` says `cell_N`, `age` ticks ago, and the torque says `torque_N`.
  double tick(std::size_t cable, double cell_N, double torque_N, WatchScope scope = kWithPower, std::uint16_t age = 0) {
    readings.steps[cable] = steps_of(table, cable, cell_N);
    readings.age_ticks[cable] = age;
    return again(cable, torque_N, scope);
  }
  // One tick with the readings as they are.
  double again(std::size_t cable, double torque_N, WatchScope scope = kWithPower) {
    const double tension_N = believed_tension_N(table, readings, cable, torque_N, state);
    Watch out(++now, faults);
    watch_load_cell(table, scope, static_cast<std::int32_t>(cable), state, out);
    return tension_N;
  }

  RobotParams table = safety_bench::table();
  LoadCells readings{};
  LoadCellState state{};
  FaultList faults{};
  std::uint64_t now = 0;
};

TEST(LoadCell, ItsReadingCountsFromTheFirstToTheLastCableLessItsZero) {
  for (const std::size_t cable : {kFirstCable, kLastCable}) {
    Cells cells;
    cells.table.load_cell.zero_N[cable] = 3.0;
    EXPECT_NEAR(cells.tick(cable, 40.0, 45.0), 40.0, 0.02) << cable;
    EXPECT_EQ(cells.state.believed, 1u << cable);
    EXPECT_EQ(cells.readings.steps[cable], 2150) << "40 N and a zero of 3 N";
  }
  EXPECT_FALSE(has_load_cell(Cells{}.table, 1));
  EXPECT_EQ(cables_with_cells(Cells{}.table), 0b111101u);
}

TEST(LoadCell, AReadingOfTwoTicksAgoCountsAndOneOfThreeDoesNot) {
  Cells cells;
  EXPECT_NEAR(cells.tick(kFirstCable, 40.0, 45.0, kWithPower, kLoadCellAgeTicks), 40.0, 0.02);
  EXPECT_EQ(cells.tick(kFirstCable, 40.0, 45.0, kWithPower, kLoadCellAgeTicks + 1), 45.0);
}

TEST(LoadCell, OverAndUnderRangeAndBeyondTheRangeOfTheTableCountAsNone) {
  for (const double wrong_N : {1e6, -1e6, 500.1, -500.1}) {
    Cells cells;
    EXPECT_EQ(cells.tick(kFirstCable, wrong_N, 45.0), 45.0) << wrong_N;
    EXPECT_EQ(cells.state.usable, 0U) << wrong_N;
  }
  Cells cells;
  EXPECT_NEAR(cells.tick(kFirstCable, 499.9, 495.0), 499.9, 0.02);
}

TEST(LoadCell, OneThatIsLostIsFault5010AfterTwentyFiveTicksUnlessTheTableGoesOnByTorque) {
  for (const bool goes_on : {false, true}) {
    Cells cells(goes_on);
    for (std::uint16_t i = 1; i < kLoadCellLostTicks; ++i) cells.tick(kLastCable, 40.0, 45.0, kWithPower, 100);
    EXPECT_EQ(cells.faults.count, 0);
    cells.tick(kLastCable, 40.0, 45.0, kWithPower, 100);
    EXPECT_EQ(has(cells.faults, FaultNumber::kLoadCellLost, kLastCable), !goes_on);
  }
}

TEST(LoadCell, OneReadingInTimeStartsTheCountAnew) {
  Cells cells;
  for (int i = 0; i < 10 * kLoadCellLostTicks; ++i)
    cells.tick(kFirstCable, 40.0, 45.0, kWithPower, i % kLoadCellLostTicks == 0 ? 0 : 100);
  EXPECT_EQ(cells.faults.count, 0);
}

// At the limit and a step beside it, on both sides; the tension is the torque's from the first tick on.
TEST(LoadCell, OneAtOddsWithTheTorqueIsNotBelievedAtOnceAndFault5011AfterFiveTicks) {
  for (const double sign : {1.0, -1.0}) {
    Cells fits;
    for (int i = 0; i < 100; ++i) EXPECT_NE(fits.tick(kFirstCable, 60.0 + sign * 19.98, 60.0), 60.0);
    EXPECT_EQ(fits.faults.count, 0) << sign;
    Cells odd;
    odd.tick(kFirstCable, 60.0, 60.0);
    for (int i = 1; i <= kLoadCellDoubtTicks; ++i) {
      EXPECT_EQ(odd.faults.count, 0) << sign;
      EXPECT_EQ(odd.tick(kFirstCable, 60.0 + sign * 20.04, 60.0), 60.0) << sign;
    }
    EXPECT_TRUE(has(odd.faults, FaultNumber::kLoadCellContradicts, kFirstCable)) << sign;
    EXPECT_EQ(odd.faults.category, StopCategory::kHold);
  }
}

// A drive without 6077: its cell alone counts, and is not to be lost, whatever the table says of torque.
TEST(LoadCell, WhereTheDriveReportsNoTorqueTheCellIsBelievedAndALostOneIsAFaultAlways) {
  for (const std::size_t cable : {kFirstCable, kLastCable}) {
    Cells cells(true);
    cells.table.no_torque = 1u << cable;
    for (int i = 0; i < 50; ++i) EXPECT_NEAR(cells.tick(cable, 40.0 + i, 400.0), 40.0 + i, 0.02);
    EXPECT_EQ(cells.faults.count, 0);
    for (int i = 0; i < kLoadCellLostTicks - 1; ++i) cells.tick(cable, 40.0, 400.0, kWithPower, 9);
    EXPECT_EQ(cells.faults.count, 0);
    cells.tick(cable, 40.0, 400.0, kWithPower, 9);
    EXPECT_TRUE(has(cells.faults, FaultNumber::kLoadCellLost, static_cast<std::int16_t>(cable)));
    const std::size_t other = cable == kFirstCable ? kLastCable : kFirstCable;
    EXPECT_TRUE(reports_torque(cells.table, other));
    EXPECT_FALSE(reports_torque(cells.table, cable));
  }
}

TEST(LoadCell, WithoutPowerTorqueSaysNothingAndTheCellCounts) {
  Cells cells;
  for (int i = 0; i < 100; ++i) EXPECT_NEAR(cells.tick(kFirstCable, 60.0, 0.0, kWithoutPower), 60.0, 0.02);
  EXPECT_EQ(cells.faults.count, 0);
}

TEST(LoadCell, OneThatStandsStillWhileTheTorqueGoesOnIsAtOddsUntilItMoves) {
  Cells cells;
  cells.tick(kFirstCable, 60.0, 60.0);
  EXPECT_NEAR(cells.again(kFirstCable, 64.9), 60.0, 0.02) << "a quarter of 20 N is left to noise";
  EXPECT_EQ(cells.again(kFirstCable, 65.1), 65.1);
  for (int i = 2; i <= kLoadCellDoubtTicks; ++i) EXPECT_EQ(cells.again(kFirstCable, 60.0), 60.0) << "once is enough";
  EXPECT_TRUE(has(cells.faults, FaultNumber::kLoadCellContradicts, kFirstCable));
  EXPECT_NEAR(cells.tick(kFirstCable, 61.0, 65.1), 61.0, 0.02);
}

}  // namespace
}  // namespace liana::cable
