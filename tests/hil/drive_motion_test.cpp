// The drive as a CiA 402 axis: states, SYNC timing, supervision, brake.
#include <cmath>

#include "drive_harness.hpp"

namespace liana::bench {
namespace {

TEST(Cia402Table, HasTheTransitionsOfTheStandardAndNoOthers) {
  using enum PowerState;
  struct Case {
    PowerState from;
    std::uint16_t controlword;
    PowerState to;
    const char* number;
  };
  const Case cases[] = {
      {kSwitchOnDisabled, 0x06, kReadyToSwitchOn, "2"},
      {kReadyToSwitchOn, 0x07, kSwitchedOn, "3"},
      {kSwitchedOn, 0x0F, kOperationEnabled, "4"},
      {kOperationEnabled, 0x07, kSwitchedOn, "5"},
      {kSwitchedOn, 0x06, kReadyToSwitchOn, "6"},
      {kReadyToSwitchOn, 0x00, kSwitchOnDisabled, "7"},
      {kOperationEnabled, 0x06, kReadyToSwitchOn, "8"},
      {kOperationEnabled, 0x00, kSwitchOnDisabled, "9"},
      {kSwitchedOn, 0x00, kSwitchOnDisabled, "10"},
      {kOperationEnabled, 0x02, kQuickStopActive, "11"},
      {kQuickStopActive, 0x00, kSwitchOnDisabled, "12"},
      {kSwitchOnDisabled, 0x0F, kSwitchOnDisabled, "no jump to enabled"},
      {kSwitchOnDisabled, 0x07, kSwitchOnDisabled, "-"},
      {kQuickStopActive, 0x0F, kQuickStopActive, "16 is not offered"},
      {kFault, 0x0F, kFault, "fault stays"},
      {kFaultReactionActive, 0x06, kFaultReactionActive, "-"},
  };
  for (const auto& test : cases)
    EXPECT_EQ(next_state(test.from, decode_command(test.controlword)), test.to) << test.number;
}

TEST(Cia402Table, StatuswordsDecodeToTheirStateWithTheMasksOfTheStandard) {
  const std::pair<PowerState, std::pair<unsigned, unsigned>> cases[] = {
      {PowerState::kSwitchOnDisabled, {0x4F, 0x40}},
      {PowerState::kReadyToSwitchOn, {0x6F, 0x21}},
      {PowerState::kSwitchedOn, {0x6F, 0x23}},
      {PowerState::kOperationEnabled, {0x6F, 0x27}},
      {PowerState::kQuickStopActive, {0x6F, 0x07}},
      {PowerState::kFaultReactionActive, {0x4F, 0x0F}},
      {PowerState::kFault, {0x4F, 0x08}}};
  for (const auto& [state, bits] : cases) EXPECT_EQ(state_bits(state) & bits.first, bits.second);
}

TEST(ServoMotorLag, IsFirstOrder) {
  ServoMotor motor(0.03, -1, 0.0);
  motor.set_target(1000.0);
  motor.step(0.001, 0.0, 1000.0);
  EXPECT_EQ(motor.position_counts(), 0.0) << "the brake holds";
  motor.set_mode(MotorMode::kFollow);
  for (int i = 0; i < 30; ++i) motor.step(0.001, 0.0, 1000.0);
  EXPECT_NEAR(motor.position_counts(), 1000.0 * (1.0 - std::exp(-1.0)), 1e-6);
}

TEST(ServoMotorLag, AtTheTorqueLimitItPaysOutButDoesNotWindUp) {
  ServoMotor motor(0.03, -1, 0.0);
  motor.set_mode(MotorMode::kFollow);
  motor.set_target(-1000.0);
  motor.step(0.001, 1000.0, 1000.0);
  EXPECT_EQ(motor.position_counts(), 0.0);
  EXPECT_TRUE(motor.at_torque_limit());
  motor.set_target(1000.0);
  motor.step(0.001, 1000.0, 1000.0);
  EXPECT_GT(motor.position_counts(), 0.0);
}

class DriveMotion : public DriveHarness {
 protected:
  DriveMotion() {
    boot();
    configure();
  }
  void keep_alive() { give(0x77F, {0x05}); }
};

TEST_F(DriveMotion, ReachesOperationEnabledThroughPdosAndReleasesTheBrakeOnlyThere) {
  EXPECT_EQ(drive_.motor().mode(), MotorMode::kBraked);
  enable();
  EXPECT_EQ(drive_.motor().mode(), MotorMode::kFollow);
  const auto tpdo = find(cycle(0x0F, 1000), 0x180 + kNode);
  ASSERT_TRUE(tpdo);
  EXPECT_EQ(tpdo->length, 8);
  EXPECT_EQ(get_little_endian(tpdo->data.data(), 2) & 0x6F, 0x27U);
  EXPECT_EQ(get_little_endian(tpdo->data.data(), 2) & 0x1200, 0x1200U) << "remote, follows the target";
  EXPECT_EQ(get_little_endian(&tpdo->data[2], 4), 1000U);
}

TEST_F(DriveMotion, ActsOnATargetAtTheSyncAfterItsArrival) {
  enable();
  command(0x0F, 2000);
  for (int i = 0; i < 4; ++i) drive_.move(0.001, 50.0);
  EXPECT_EQ(drive_.motor().position_counts(), 1000.0) << "no SYNC yet";
  cycle(0x0F, 2000);
  const double after_one = drive_.motor().position_counts();
  EXPECT_NEAR(after_one, 1000.0 + 1000.0 * (1.0 - std::exp(-4.0 / 30.0)), 0.01);
  const auto tpdo = find(cycle(0x0F, 2000), 0x180 + kNode);
  EXPECT_EQ(static_cast<double>(get_little_endian(&tpdo->data[2], 4)), std::round(after_one))
      << "sampled at SYNC, before moving on";
}

TEST_F(DriveMotion, StopsByItselfWhenTargetsStopComing) {
  enable();
  for (int i = 0; i < 10; ++i) cycle(0x0F, 1000 + 100 * i);
  FrameList all;
  for (int i = 0; i < 3; ++i)
    for (const auto& frame : cycle(std::nullopt, 0)) all.push_back(frame);
  EXPECT_EQ(emergency(all), -1) << "12 ms are allowed";
  EXPECT_EQ(drive_.power_state(), PowerState::kOperationEnabled);
  EXPECT_EQ(emergency(cycle(std::nullopt, 0)), 0x8250);
  EXPECT_EQ(drive_.power_state(), PowerState::kQuickStopActive);
  for (int i = 0; i < 40; ++i) cycle(std::nullopt, 0);
  EXPECT_EQ(drive_.power_state(), PowerState::kSwitchOnDisabled);
  EXPECT_EQ(drive_.motor().mode(), MotorMode::kBraked);
  command(0x06, 1000);
  EXPECT_EQ(drive_.counts().quick_stops, 1U);
}

TEST_F(DriveMotion, StopsByItselfWhenTheMasterDies) {
  enable();
  keep_alive();
  bool lost = false;
  int cycles = 0;
  while (!lost && cycles < 200) {
    lost = emergency(cycle(0x0F, 1000)) == 0x8130;
    ++cycles;
  }
  EXPECT_EQ(cycles, 76) << "the first check later than 300 ms";
  cycle(0x0F, 1000);
  cycle(0x0F, 1000);
  EXPECT_EQ(drive_.power_state(), PowerState::kSwitchOnDisabled);
  EXPECT_EQ(emergency(give(0x77F, {0x05})), 0) << "the error is taken back";
}

TEST_F(DriveMotion, WithoutItsMasterItGoesWhereObject1029Says) {
  const std::pair<std::uint32_t, NmtState> behaviours[] = {
      {0, NmtState::kPreOperational}, {1, NmtState::kOperational}, {2, NmtState::kStopped}};
  for (const auto& [behaviour, state] : behaviours) {
    give(0x000, {0x82, kNode});
    configure(0);
    EXPECT_EQ(write(0x1029, 1, 1, behaviour), 0U);
    keep_alive();
    for (int i = 0; i < 70; ++i) cycle(std::nullopt, 0);
    EXPECT_EQ(drive_.nmt_state(), NmtState::kOperational);
    for (int i = 0; i < 10; ++i) cycle(std::nullopt, 0);
    EXPECT_EQ(drive_.nmt_state(), state) << behaviour;
    keep_alive();
    cycle(std::nullopt, 0);
    EXPECT_EQ(drive_.nmt_state(), state) << "the heartbeat alone does not start it again";
  }
}

TEST_F(DriveMotion, AnEmergencyHasBit0OfTheErrorRegisterUntilTheErrorIsGone) {
  enable();
  keep_alive();
  std::optional<CanFrame> lost;
  for (int i = 0; i < 100 && !lost; ++i) lost = find(cycle(0x0F, 1000), 0x080 + kNode);
  ASSERT_TRUE(lost);
  EXPECT_EQ(lost->data[2], 0x11);
  EXPECT_EQ(read(0x1001, 0), 0x11U);
  const auto back = find(give(0x77F, {0x05}), 0x080 + kNode);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->data[2], 0);
  EXPECT_EQ(read(0x1001, 0), 0U);
}

TEST_F(DriveMotion, ATpdoOfType0ComesAtASyncOnlyWhenSomethingHasChanged) {
  give(0x000, {0x80, kNode});
  EXPECT_EQ(write(0x1800, 1, 4, 0x80000180U + kNode), 0U);
  EXPECT_EQ(write(0x1800, 2, 1, 0), 0U);
  EXPECT_EQ(write(0x1800, 1, 4, 0x180U + kNode), 0U);
  give(0x000, {0x01, kNode});
  const auto reports = [&] { return find(cycle(std::nullopt, 0), 0x180 + kNode).has_value(); };
  EXPECT_TRUE(reports()) << "the first one";
  cycle(std::nullopt, 0);
  EXPECT_FALSE(reports());
  drive_.set_measured(77.0);
  EXPECT_TRUE(reports());
  EXPECT_FALSE(reports());
}

TEST_F(DriveMotion, ResetNodeRestoresApplicationObjectsAndResetCommunicationDoesNot) {
  EXPECT_EQ(write(0x6072, 0, 2, 500), 0U);
  give(0x000, {0x82, kNode});
  EXPECT_EQ(read(0x6072, 0), 500U);
  EXPECT_EQ(read(0x1400, 2), 1U);
  const FrameList out = give(0x000, {0x81, kNode});
  EXPECT_TRUE(find(out, 0x700 + kNode));
  EXPECT_EQ(read(0x6072, 0), 1000U);
  EXPECT_EQ(read(0x6060, 0), 0U);
}

TEST_F(DriveMotion, RampsDownOnQuickStop) {
  enable();
  write(0x6085, 0, 4, 100000);
  for (int i = 0; i < 100; ++i) cycle(0x0F, 1000 + 40 * i);  // about 10 000 counts/s
  cycle(0x02, 5000);
  const double speed = drive_.motor().velocity_counts_per_s();
  ASSERT_GT(speed, 8000.0);
  const double from = drive_.motor().position_counts();
  double time_s = 0.0;
  while (drive_.power_state() != PowerState::kSwitchOnDisabled && time_s < 1.0) {
    cycle(0x02, 0);
    time_s += 0.004;
  }
  EXPECT_NEAR(time_s, speed / 100000.0, 0.012);
  EXPECT_NEAR(drive_.motor().position_counts() - from, speed * speed / (2.0 * 100000.0), 10.0);
}

TEST_F(DriveMotion, LeavesFaultOnARisingEdgeOnly) {
  enable();
  cycle(0x8F, 1000);  // the bit is already up when the fault comes
  cycle(0x8F, 1000);
  drive_.raise_fault(0x2310);
  EXPECT_EQ(emergency(cycle(0x8F, 1000)), 0x2310);
  cycle(0x8F, 1000);
  EXPECT_EQ(drive_.power_state(), PowerState::kFault);
  EXPECT_EQ(read(0x603F, 0), 0x2310U);
  EXPECT_EQ(read(0x1003, 1), 0x2310U);
  cycle(0x00, 1000);
  cycle(0x80, 1000);
  EXPECT_EQ(drive_.power_state(), PowerState::kFault);
  EXPECT_EQ(emergency(cycle(0x80, 1000)), 0);
  EXPECT_EQ(drive_.power_state(), PowerState::kSwitchOnDisabled);
  EXPECT_EQ(read(0x1001, 0), 0U);
}

TEST_F(DriveMotion, AFollowingErrorThatStaysIsAFault) {
  write(0x6065, 0, 4, 500);
  write(0x6066, 0, 2, 20);
  enable();
  int code = -1;
  for (int i = 0; i < 20 && code < 0; ++i) code = emergency(cycle(0x0F, 1000 + 2000 * i));
  EXPECT_EQ(code, 0x8611);
  cycle(0x0F, 0);
  EXPECT_NE(drive_.power_state(), PowerState::kOperationEnabled);
}

TEST_F(DriveMotion, WithSafeTorqueOffTheBrakeHoldsAndNothingEnables) {
  enable();
  drive_.set_safe_torque_off();
  EXPECT_EQ(emergency(cycle(0x06, 1000)), 0xFF01);
  for (const int controlword : {0x06, 0x07, 0x0F, 0x0F}) cycle(controlword, 1000);
  EXPECT_EQ(drive_.power_state(), PowerState::kSwitchOnDisabled);
  EXPECT_EQ(drive_.motor().mode(), MotorMode::kBraked);
  EXPECT_EQ(drive_.statusword() & 0x10, 0) << "no voltage";
}

TEST_F(DriveMotion, DoesNotEnableWithoutCsp) {
  DriveHarness::give(0x000, {0x81, kNode});
  Drive fresh(settings(), 0.0);
  FrameList out;
  fresh.tick(0, out);
  EXPECT_EQ(fresh.power_state(), PowerState::kSwitchOnDisabled);
  for (const int controlword : {0x06, 0x07, 0x0F, 0x0F}) {
    CanFrame request;
    request.id = 0x600 + kNode;
    request.length = 8;
    request.data = {0x2B, 0x40, 0x60, 0, static_cast<std::uint8_t>(controlword), 0, 0, 0};
    fresh.receive(request, out);
  }
  EXPECT_EQ(fresh.power_state(), PowerState::kSwitchedOn);
}

TEST_F(DriveMotion, AShortRpdoIsReportedAndNotUsed) {
  enable();
  EXPECT_EQ(emergency(give(0x200 + kNode, {0x0F, 0x00})), 0x8210);
  cycle(0x0F, 1000);
  EXPECT_EQ(drive_.power_state(), PowerState::kOperationEnabled);
}

TEST_F(DriveMotion, StopsWhenNmtTakesItOutOfOperational) {
  enable();
  give(0x000, {0x80, kNode});
  EXPECT_EQ(drive_.power_state(), PowerState::kQuickStopActive);
  tick(4000);
  EXPECT_EQ(drive_.power_state(), PowerState::kSwitchOnDisabled);
}

}  // namespace
}  // namespace liana::bench
