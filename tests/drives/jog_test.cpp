// A jog with a drive of the bench: by how much it moves, between which bounds, and that it ends disabled whatever
// happens.
#include "host/drives/commissioning/jog.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "firmware_like/drive/pdo.hpp"
#include "tests/drives/drive_channel.hpp"

namespace liana {
namespace {

using commissioning::JogResult;

constexpr double kRate_hz = 250.0, kBy = 6000.0, kSpeed = 8000.0, kRamp_s = 0.25;
constexpr std::int32_t kStart = 1000;  // BootedDrive's

canopen::ExpectedDrive jogged_drive() {
  canopen::ExpectedDrive drive;
  drive.vendor = 0x4C49;
  drive.product = drive.revision = drive.serial.emplace(1);
  drive.counts_per_turn = 65536;
  drive.rated_torque_mNm = 9000;
  drive.period = {4, -3};
  drive.rpdo_deadline_ms = 100;
  drive.following_window_counts = 3000;
  return drive;
}

bench::DriveSettings settings() {
  bench::DriveSettings drive;
  drive.vendor = 0x4C49;
  drive.product = drive.revision = drive.serial = 1;
  return drive;
}

// A booted drive, and a jog that is stepped with what it reports.
class JogLine : public ::testing::Test {
 protected:
  JogLine() : line(jogged_drive(), settings()) {
    line.run_boot();
    EXPECT_EQ(line.boot.state(), canopen::BootState::kOperational) << line.refusals();
  }

  static commissioning::JogRequest request(double by = kBy) {
    commissioning::JogRequest out;
    out.by_counts = by;
    out.counts_per_s = kSpeed;
    out.ramp_s = kRamp_s;
    out.window_counts = 1500.0;
    out.settled_counts = 20.0;
    return out;
  }

  // To its end; `each` may do something at every tick.
  void carry_out(
      commissioning::Jog& jog, const std::function<void(int)>& each = [](int) {}) {
    for (int tick = 0; tick < 5000 && !jog.is_over(); ++tick) {
      each(tick);
      const DriveCommand told = jog.step(seen());
      if (jog.was_enabled()) targets.push_back(told.target_counts);
      line.report.reset();
      line.cycle(told.controlword, told.target_counts);
    }
    ASSERT_TRUE(jog.is_over());
  }

  DriveFeedback seen() {
    DriveFeedback out = last_;
    out.feedback_age_ticks = static_cast<std::uint16_t>(std::min(out.feedback_age_ticks + 1, 0xFFFF));
    if (line.report) {
      Tpdo1 report;
      EXPECT_TRUE(decode_tpdo1({line.report->data.data(), line.report->length}, report));
      out = {report.statusword, report.torque_permille, report.position_counts, 0, 0, 0, 0, 1};
    }
    out.heartbeat_age_ticks = heartbeat_age_ticks;
    out.operational = operational;
    return last_ = out;
  }

  double moved() const { return line.drive.motor().position_counts() - kStart; }
  void expect_disabled() {
    EXPECT_EQ(line.drive.motor().mode(), bench::MotorMode::kBraked);
    EXPECT_NE(line.drive.power_state(), bench::PowerState::kOperationEnabled);
  }

  test::BootedDrive line;
  std::vector<std::int32_t> targets;
  std::uint16_t heartbeat_age_ticks = 0;
  std::uint8_t operational = 1;

 private:
  DriveFeedback last_;
};

TEST_F(JogLine, MovesByWhatWasAskedOnABoundedRampAndEndsDisabled) {
  for (const double by : {kBy, -kBy, 700.0}) {
    const double from = line.drive.motor().position_counts();
    commissioning::Jog jog(request(by), kRate_hz);
    targets.clear();
    carry_out(jog);
    EXPECT_EQ(jog.end(), JogResult::kArrived);
    EXPECT_TRUE(jog.is_off());
    EXPECT_NEAR(line.drive.motor().position_counts() - from, by, 20.0);
    EXPECT_NEAR(jog.moved_counts(), by, 20.0);
    double speed = 0.0;
    for (std::size_t i = 1; i < targets.size(); ++i) {
      const double now = (targets[i] - targets[i - 1]) * kRate_hz;
      EXPECT_LE(std::fabs(now), kSpeed + kRate_hz) << i;  // rounding is a count a tick
      EXPECT_LE(std::fabs(now - speed), kSpeed / kRamp_s / kRate_hz + 2 * kRate_hz) << i;
      speed = now;
      EXPECT_LE(std::fabs(targets[i] - from), std::fabs(by) + 1.0) << i;
    }
    expect_disabled();
  }
}

TEST_F(JogLine, AnInterruptBringsItToRestOnTheWayAndDisablesIt) {
  commissioning::Jog jog(request(), kRate_hz);
  carry_out(jog, [&](int tick) {
    if (tick == 100) jog.interrupt();
  });
  EXPECT_EQ(jog.end(), JogResult::kInterrupted);
  EXPECT_TRUE(jog.is_off());
  EXPECT_GT(moved(), 500.0);
  EXPECT_LT(moved(), kBy - 500.0);
  expect_disabled();
}

TEST_F(JogLine, AnInterruptBeforeItIsEnabledLeavesItDisabled) {
  commissioning::Jog jog(request(), kRate_hz);
  carry_out(jog, [&](int tick) {
    if (tick == 2) jog.interrupt();
  });
  EXPECT_EQ(jog.end(), JogResult::kInterrupted);
  EXPECT_EQ(line.drive.counts().quick_stops, 0U);
  EXPECT_NEAR(moved(), 0.0, 1.0);
  expect_disabled();
}

TEST_F(JogLine, AFaultOfTheDriveEndsItThere) {
  commissioning::Jog jog(request(), kRate_hz);
  carry_out(jog, [&](int tick) {
    if (tick == 100) line.drive.raise_fault(0x7305);
  });
  EXPECT_EQ(jog.end(), JogResult::kFault);
  EXPECT_TRUE(jog.is_off());
  EXPECT_EQ(line.emergencies, std::vector<std::uint16_t>{0x7305});
  expect_disabled();
  commissioning::Jog again(request(), kRate_hz);
  carry_out(again);
  EXPECT_EQ(again.end(), JogResult::kFaultBefore);
  expect_disabled();
  commissioning::JogRequest clearing = request(-1000.0);
  clearing.clears_fault = true;
  commissioning::Jog cleared(clearing, kRate_hz);
  carry_out(cleared);
  EXPECT_EQ(cleared.end(), JogResult::kArrived);
}

TEST_F(JogLine, AMotorThatDoesNotFollowIsStopped) {
  commissioning::Jog jog(request(), kRate_hz);
  carry_out(jog, [&](int tick) {
    if (tick == 60) line.drive.defects().stuck = true;
  });
  EXPECT_EQ(jog.end(), JogResult::kRanAway);
  EXPECT_LT(moved(), kBy - 500.0);
  EXPECT_GT(line.drive.counts().quick_stops, 0U);
  expect_disabled();
}

// A drive that does not limit its torque by 6072, or has no such object.
TEST_F(JogLine, AMotorThatNeedsMoreTorqueThanItMayHaveIsStopped) {
  commissioning::JogRequest weak = request();
  weak.most_torque_permille = 100.0;
  commissioning::Jog light(weak, kRate_hz);
  line.drive.set_measured(120.0);
  carry_out(light);
  EXPECT_EQ(light.end(), JogResult::kArrived) << "less than a quarter above it";
  commissioning::Jog jog(weak, kRate_hz);
  carry_out(jog, [&](int tick) {
    if (tick == 60) line.drive.set_measured(-126.0);
  });
  EXPECT_EQ(jog.end(), JogResult::kTorque);
  EXPECT_LT(jog.moved_counts(), kBy - 500.0);
  expect_disabled();
}

TEST_F(JogLine, ADriveThatIsNotHeardAnyMoreIsStoppedAndNotTakenForDisabled) {
  commissioning::Jog jog(request(), kRate_hz);
  carry_out(jog, [&](int tick) {
    if (tick == 60) line.drive.defects().no_reports = true;
  });
  EXPECT_EQ(jog.end(), JogResult::kReportsLost);
  EXPECT_FALSE(jog.is_off()) << "nobody knows";
  expect_disabled();
}

TEST_F(JogLine, ALostHeartbeatStopsIt) {
  commissioning::Jog jog(request(), kRate_hz);
  carry_out(jog, [&](int tick) {
    if (tick >= 60) ++heartbeat_age_ticks;
  });
  EXPECT_EQ(jog.end(), JogResult::kHeartbeatLost);
  EXPECT_LT(moved(), kBy - 500.0);
  expect_disabled();
}

TEST_F(JogLine, ADriveThatLeavesItsModeIsStoppedAndNamed) {
  commissioning::Jog jog(request(), kRate_hz);
  carry_out(jog, [&](int tick) {
    if (tick == 60) operational = kInOtherMode;
  });
  EXPECT_EQ(jog.end(), JogResult::kOtherMode);
  EXPECT_LT(moved(), kBy - 500.0);
  expect_disabled();
}

TEST_F(JogLine, ADriveThatCannotBeEnabledIsGivenUp) {
  line.drive.set_safe_torque_off();
  commissioning::Jog jog(request(), kRate_hz);
  carry_out(jog);
  EXPECT_EQ(jog.end(), JogResult::kNotEnabled);
  EXPECT_FALSE(jog.was_enabled());
  expect_disabled();
}

TEST(JogBounds, LetOutWhatLiesBetweenStartAndGoalAndNotFartherThanAStep) {
  constexpr commissioning::JogBounds bounds{-50, 100, 10.0};
  for (const auto& [before, target, allowed] :
       {std::tuple{0, std::int64_t{10}, true}, std::tuple{0, std::int64_t{11}, false},
        std::tuple{0, std::int64_t{-10}, true}, std::tuple{0, std::int64_t{-11}, false},
        std::tuple{95, std::int64_t{100}, true}, std::tuple{95, std::int64_t{101}, false},
        std::tuple{-45, std::int64_t{-50}, true}, std::tuple{-45, std::int64_t{-51}, false},
        std::tuple{0, std::int64_t{1} << 32, false}})
    EXPECT_EQ(bounds.allows(before, target), allowed) << before << " to " << target;
}

// The zero of an encoder may be anywhere: at the end of what 607A can say nothing wraps.
TEST(JogBounds, AtTheEndOfTheNumbersItStops) {
  commissioning::JogRequest request;
  request.by_counts = 1000.0;
  request.counts_per_s = 5000.0;
  request.window_counts = 1e5;
  commissioning::Jog jog(request, kRate_hz);
  DriveFeedback seen{0x0637, 0, 2147483600, 0, 0, 0, 0, 1};
  std::int32_t most = 0;
  for (int i = 0; i < 1000 && !jog.is_over(); ++i) {
    const DriveCommand told = jog.step(seen);
    EXPECT_GE(told.target_counts, 2147483600);
    most = std::max(most, told.target_counts);
    if ((told.controlword & 0x0F) != 0x0F) seen.statusword = 0x0250;
  }
  EXPECT_EQ(jog.end(), JogResult::kBounds);
  EXPECT_GT(most, 2147483600);
}

}  // namespace
}  // namespace liana
