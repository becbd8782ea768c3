// What the drives' line makes of frames: reports, and who else speaks under a drive's identifiers.
#include "host/control/realtime/drive_channel.hpp"

#include <gtest/gtest.h>

#include <array>
#include <utility>
#include <vector>

#include "firmware_like/safety/drive_link_monitor.hpp"
#include "tests/host/drives/bus/quiet_bus.hpp"
#include "tests/message.hpp"

namespace liana::realtime {
namespace {

// Gives the frames that a test lays into it; what is sent is lost.
class FrameSource final : public test::QuietBus {
 public:
  FrameSource() : QuietBus(1) {}
  bool receive(bus::ReceivedFrame& received) noexcept override {
    if (at >= frames.size()) return false;
    received = {0, frames[at++]};
    return true;
  }

  std::vector<bus::CanFrame> frames;
  std::size_t at = 0;
};

bus::CanFrame report(std::uint8_t position) { return {0x182, 8, {0x27, 0, position, 0, 0, 0, 0, 0}, 0}; }
const bus::CanFrame kForeignTarget{0x202, 6, {0x0F, 0, 0, 0, 0, 0}, 0};

class TwoVoices : public ::testing::Test {
 protected:
  TwoVoices() : line_(drives(), buses(), bus_) {}

  static config::BusesConfig buses() {
    config::BusesConfig buses;
    buses.rate_hz = 250.0;
    buses.heartbeat_ms = 100;
    buses.buses = {{"can0", 1000000, {1, 2}}};
    return buses;
  }
  static std::vector<canopen::ExpectedDrive> drives() {
    std::vector<canopen::ExpectedDrive> drives(2);
    drives[0].node = 1;
    drives[1].node = 2;
    return drives;
  }
  std::uint32_t mask_after(const std::vector<bus::CanFrame>& frames, std::uint32_t lost_ticks = 0) {
    bus_.frames = frames;
    bus_.at = 0;
    line_.collect({++tick_, 0, lost_ticks, false}, inputs_);
    return inputs_.twice_mask;
  }

  FrameSource bus_;
  DriveChannel line_;
  CycleInputs inputs_;
  std::uint64_t tick_ = 0;
};

TEST_F(TwoVoices, AreNamedAfterEightTicksInARowWithReportsThatDiffer) {
  for (int i = 1; i < kTwiceTicks; ++i) EXPECT_EQ(mask_after({report(1), report(2)}), 0U) << i;
  EXPECT_EQ(mask_after({report(1), report(2)}), 2U);
  EXPECT_EQ(mask_after({report(1)}), 0U) << "gone as soon as one is silent";
}

TEST_F(TwoVoices, ACommandThatIsNotOursIsOne) {
  for (int i = 1; i < kTwiceTicks; ++i) EXPECT_EQ(mask_after({report(1), kForeignTarget}), 0U);
  EXPECT_EQ(mask_after({report(1), kForeignTarget}), 2U);
}

TEST_F(TwoVoices, FramesThatTheBusDoublesOrDelaysAreNone) {
  for (int i = 0; i < 50; ++i) EXPECT_EQ(mask_after({report(1), report(1)}), 0U) << "the same twice";
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(mask_after({}), 0U);
    EXPECT_EQ(mask_after({report(1), report(2)}), 0U) << "late, with the next one";
  }
  for (int i = 0; i < 50; ++i) EXPECT_EQ(mask_after({report(1), report(2)}, 1), 0U) << "after a tick that was lost";
}

// Frames of each bus; remembers what is sent, and shows the states that a test sets.
class ThreeBuses final : public test::QuietBus {
 public:
  ThreeBuses() : QuietBus(3) {}
  bool receive(bus::ReceivedFrame& received) noexcept override {
    if (frames.empty()) return false;
    received = frames.front();
    frames.erase(frames.begin());
    return true;
  }
  bus::SendResult send(int bus, const bus::CanFrame& frame) noexcept override {
    sent.push_back({bus, frame});
    return bus::SendResult::kOk;
  }
  const bus::DriveBusStats& stats(int bus) const noexcept override { return shown[static_cast<std::size_t>(bus)]; }

  std::vector<bus::ReceivedFrame> frames, sent;
  std::array<bus::DriveBusStats, 3> shown{};
};

// Drive 1, a torque drive, and 2, which reports no torque, on the first bus; 3, a torque drive, on the second; none on
// the third. A load cell of the first cable on the second bus.
class DrivesOnTwoBuses : public ::testing::Test {
 protected:
  DrivesOnTwoBuses() : line_(drives(), buses(), bus_) {}

  static config::BusesConfig buses() {
    config::BusesConfig buses;
    buses.rate_hz = 250.0;
    buses.heartbeat_ms = 100;
    buses.buses = {{"can0", 1000000, {1, 2}}, {"can1", 1000000, {3}}, {"can2", 1000000, {}}};
    buses.buses[1].load_cells = {{0x28, {0}, {0.0}}};
    return buses;
  }
  static std::vector<canopen::ExpectedDrive> drives() {
    std::vector<canopen::ExpectedDrive> drives(3);
    for (std::size_t i = 0; i < 3; ++i) {
      drives[i].index = i;
      drives[i].node = static_cast<std::uint8_t>(i + 1);
    }
    drives[1].type.has_torque = false;
    drives[0].type.is_cst = drives[2].type.is_cst = true;
    drives[2].bus = 1;
    return drives;
  }
  static bus::CanFrame report_of(std::uint32_t node) {
    const auto byte = static_cast<std::uint8_t>(node);
    return {0x180 + node, static_cast<std::uint8_t>(node == 2 ? 6 : 8), {0x37, 0x12, byte, 0, 0, 0, byte, 0}, 0};
  }
  void tick(std::vector<bus::ReceivedFrame> frames, std::uint32_t lost_ticks = 0) {
    bus_.frames = std::move(frames);
    line_.collect({++tick_, 0, lost_ticks, false}, inputs_);
    line_.step_master();
  }
  const DriveFeedback& of(std::size_t drive) const { return inputs_.drive[drive]; }

  ThreeBuses bus_;
  DriveChannel line_;
  CycleInputs inputs_;
  std::uint64_t tick_ = 0;
};

TEST_F(DrivesOnTwoBuses, ReportsGoToTheDriveOfTheirNodeAndBus) {
  inputs_.request = Request::kClear;
  tick({{0, report_of(1)}, {0, report_of(2)}, {1, report_of(3)}}, 2);
  EXPECT_EQ(inputs_.tick, 1U);
  EXPECT_EQ(inputs_.lost_ticks, 2U);
  EXPECT_EQ(inputs_.request, Request::kNone);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(of(i).statusword, 0x1237);
    EXPECT_EQ(of(i).position_counts, static_cast<std::int32_t>(i + 1));
    EXPECT_EQ(of(i).torque_permille, i == 1 ? 0 : static_cast<std::int16_t>(i + 1));
    EXPECT_EQ(of(i).feedback_age_ticks, 0);
  }
  tick({{1, report_of(1)}, {1, report_of(2)}, {0, report_of(3)}, {2, report_of(1)}});
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(of(i).feedback_age_ticks, 1) << "on the wrong bus";
}

TEST_F(DrivesOnTwoBuses, WhatDoesNotComeGrowsOlderByLostTicksToo) {
  EXPECT_EQ(of(0).feedback_age_ticks, 0xFFFF);
  for (std::size_t silent = 0; silent < 3; ++silent) {
    tick({{0, report_of(1)}, {0, report_of(2)}, {1, report_of(3)}});
    for (const std::uint32_t lost : {0U, 3U}) {
      std::vector<bus::ReceivedFrame> frames{{0, report_of(1)}, {0, report_of(2)}, {1, report_of(3)}};
      frames.erase(frames.begin() + static_cast<std::ptrdiff_t>(silent));
      tick(frames, lost);
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(of(i).feedback_age_ticks, i != silent ? 0 : lost == 0 ? 1 : 5) << silent << " " << i;
    }
  }
}

TEST_F(DrivesOnTwoBuses, RatesAreTakenFromTorqueDrivesOnly) {
  const auto rate = [](std::uint32_t id) { return bus::CanFrame{id, 4, {7, 0, 0, 0}, 0}; };
  tick({{0, rate(0x282)}, {0, rate(0x283)}, {1, rate(0x281)}, {1, rate(0x280)}, {1, rate(0x300)}});
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(of(i).rate_counts_s, 0);
  tick({{1, rate(0x283)}});
  EXPECT_EQ(of(2).rate_counts_s, 7);
  EXPECT_EQ(of(0).rate_counts_s, 0);
  tick({{0, rate(0x281)}});
  EXPECT_EQ(of(0).rate_counts_s, 7);
}

TEST_F(DrivesOnTwoBuses, SensorsHearTheSameFramesAndGrowOlderToo) {
  tick({{1, {0x1A8, 2, {5, 0}, 0}}});
  EXPECT_EQ(line_.sensor_channel().load_cells().steps[0], 5);
  EXPECT_EQ(line_.sensor_channel().load_cells().age_ticks[0], 0);
  tick({}, 2);
  EXPECT_EQ(line_.sensor_channel().load_cells().age_ticks[0], 3);
}

TEST_F(DrivesOnTwoBuses, ABusIsLostInTheThirdTickInWhichNoneOfItsDrivesReports) {
  for (const int silent : {0, 1}) {
    tick({{0, report_of(1)}, {0, report_of(2)}, {1, report_of(3)}});
    for (int i = 1; i <= 3; ++i) {
      EXPECT_EQ(inputs_.lost_bus_mask, 0U) << i;
      tick(silent == 0 ? std::vector<bus::ReceivedFrame>{{1, report_of(3)}}
                       : std::vector<bus::ReceivedFrame>{{0, report_of(2)}});
    }
    EXPECT_EQ(inputs_.lost_bus_mask, 1U << silent) << "nobody is missed on the third bus";
  }
  for (std::size_t b = 0; b < 3; ++b) {
    for (const bus::BusState state : {bus::BusState::kDown, bus::BusState::kBusOff}) {
      bus_.shown[b].state = state;
      tick({{0, report_of(1)}, {1, report_of(3)}});
      EXPECT_EQ(inputs_.lost_bus_mask, 1U << b);
      bus_.shown[b].state = bus::BusState::kActive;
    }
  }
}

TEST_F(DrivesOnTwoBuses, AnEmergencyIsOfOneTickAndOfItsDrive) {
  const auto emergency = [](std::uint32_t node) { return bus::CanFrame{0x080 + node, 8, {0x30, 0x81}, 0}; };
  for (std::uint32_t node = 1; node <= 3; ++node) {
    tick({{node == 3 ? 1 : 0, emergency(node)}});
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(of(i).emergency_code, i + 1 == node ? 0x8130 : 0);
    tick({{node == 3 ? 0 : 1, emergency(node)}});
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(of(i).emergency_code, 0);
  }
}

TEST_F(DrivesOnTwoBuses, HeartbeatsSayWhoIsOperationalAndSinceWhen) {
  for (std::uint32_t node = 1; node <= 3; ++node) {
    tick({{node == 3 ? 1 : 0, {0x700 + node, 1, {0x05}, 0}}});
    EXPECT_EQ(of(node - 1).operational, 1);
    EXPECT_EQ(of(node - 1).heartbeat_age_ticks, 0);
    EXPECT_EQ(inputs_.drive[node].operational, 0) << "not heard yet";
  }
  EXPECT_EQ(of(0).heartbeat_age_ticks, 2);
  tick({{0, {0x701, 1, {0x7F}, 0}}});
  EXPECT_EQ(of(0).operational, 0);
  EXPECT_EQ(of(2).operational, 1);
}

TEST_F(DrivesOnTwoBuses, ASilentBusGetsItsCommandsFor25TicksAndTheOtherOnesGoOn) {
  tick({{0, report_of(1)}, {1, report_of(3)}});
  for (int i = 1; i <= 26; ++i) {
    tick({{1, report_of(3)}});
    bus_.sent.clear();
    line_.command({DriveCommand{0x11}, DriveCommand{0x22}, DriveCommand{0x33}});
    ASSERT_EQ(bus_.sent.size(), i <= 25 ? 3U : 1U) << i;
    EXPECT_EQ(bus_.sent.back().bus, 1);
    EXPECT_EQ(bus_.sent.back().frame.id, 0x203U);
    EXPECT_EQ(bus_.sent.back().frame.length, 8) << "a torque drive's";
    EXPECT_EQ(bus_.sent.back().frame.data[0], 0x33);
    if (i > 25) continue;
    EXPECT_EQ(bus_.sent[1].bus, 0);
    EXPECT_EQ(bus_.sent[1].frame.id, 0x202U);
    EXPECT_EQ(bus_.sent[1].frame.length, 6);
    EXPECT_EQ(bus_.sent[1].frame.data[0], 0x22);
  }
}

TEST_F(DrivesOnTwoBuses, AnotherVoiceIsNamedWithItsDriveTheFirstAndTheLast) {
  for (const std::uint32_t node : {1U, 3U}) {
    bus::CanFrame other = report_of(node);
    ++other.data[2];
    const int bus = node == 3 ? 1 : 0;
    for (int i = 1; i < kTwiceTicks; ++i) {
      tick({{bus, report_of(node)}, {bus, other}});
      EXPECT_EQ(inputs_.twice_mask, 0U);
    }
    tick({{bus, report_of(node)}, {bus, other}});
    EXPECT_EQ(inputs_.twice_mask, 1U << (node - 1));
  }
}

TEST_F(DrivesOnTwoBuses, WhoeverWaitsForLostDrivesWaitsFiveSecondsAndAnewAfterAPause) {
  for (int round = 0; round < 2; ++round) {
    inputs_.tick += 2;  // nobody asked in the tick before
    for (int i = 1; i < 1250; ++i, ++inputs_.tick) ASSERT_FALSE(line_.reboot_lost_drives(inputs_)) << i;
    EXPECT_TRUE(line_.reboot_lost_drives(inputs_));
  }
}

// Drives 1 and 2 are the axes of node 1, drive 3 is node 2.
class TwoAxes : public ::testing::Test {
 protected:
  TwoAxes() : line_(drives(), buses(), bus_) {}

  static config::BusesConfig buses() {
    config::BusesConfig buses;
    buses.rate_hz = 250.0;
    buses.heartbeat_ms = 100;
    buses.buses = {{"can0", 1000000, {{1, 1}, {1, 2}, {2, 1}}}};
    return buses;
  }
  static std::vector<canopen::ExpectedDrive> drives() {
    std::vector<canopen::ExpectedDrive> drives(3);
    for (std::size_t i = 0; i < 3; ++i) drives[i].index = i;
    drives[1].axis = 2;
    drives[2].node = 2;
    for (canopen::ExpectedDrive& drive : drives) drive.type.is_cst = true;
    return drives;
  }
  void tick(const std::vector<bus::CanFrame>& frames) {
    for (const bus::CanFrame& frame : frames) bus_.frames.push_back({0, frame});
    line_.collect({++tick_, 0, 0, false}, inputs_);
    line_.step_master();
  }
  static bus::CanFrame report(std::uint32_t id, std::uint8_t position) {
    return {id, 8, {0x37, 0x12, position, 0, 0, 0, 0, 0}, 0};
  }

  ThreeBuses bus_;
  DriveChannel line_;
  CycleInputs inputs_;
  std::uint64_t tick_ = 0;
};

TEST_F(TwoAxes, HaveReportsRatesAndCommandsOfTheirOwn) {
  tick({report(0x181, 10), report(0x381, 20), report(0x182, 30), {0x481, 4, {7, 0, 0, 0}, 0}});
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(inputs_.drive[i].position_counts, static_cast<int>(10 * (i + 1)));
  EXPECT_EQ(inputs_.drive[0].rate_counts_s, 0);
  EXPECT_EQ(inputs_.drive[1].rate_counts_s, 7);
  tick({report(0x181, 10), report(0x382, 40)});
  EXPECT_EQ(inputs_.drive[0].feedback_age_ticks, 0);
  EXPECT_EQ(inputs_.drive[1].feedback_age_ticks, 1);
  EXPECT_EQ(inputs_.drive[2].feedback_age_ticks, 1) << "node 2 has no axis 2";
  bus_.sent.clear();
  line_.command({});
  ASSERT_EQ(bus_.sent.size(), 3U);
  EXPECT_EQ(bus_.sent[0].frame.id, 0x201U);
  EXPECT_EQ(bus_.sent[1].frame.id, 0x401U);
  EXPECT_EQ(bus_.sent[2].frame.id, 0x202U);
}

TEST_F(TwoAxes, ShareHeartbeatAndEmergenciesOfTheirNode) {
  tick({{0x701, 1, {0x05}, 0}, {0x081, 8, {0x10, 0x23, 0x01}, 0}});
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(inputs_.drive[i].emergency_code, i < 2 ? 0x2310 : 0);
    EXPECT_EQ(inputs_.drive[i].operational, i < 2 ? 1 : 0);
  }
  for (int i = 0; i < 50; ++i) tick({});
  EXPECT_EQ(inputs_.drive[0].heartbeat_age_ticks, 50);
  EXPECT_EQ(inputs_.drive[1].heartbeat_age_ticks, 50);
}

TEST_F(TwoAxes, OfANodeThatIsMissingAreOneProblemThatNamesBoth) {
  for (int i = 0; i < 10 * 250 + 10; ++i) tick({});
  const std::vector<BootProblem> problems = line_.boot_problems();
  ASSERT_EQ(problems.size(), 2U);
  EXPECT_EQ(problems[0].drive, 0);
  EXPECT_EQ(problems[0].number, FaultNumber::kDriveMissing);
  EXPECT_TRUE(names(problems[0].text, {"drive 1 (node 1)", "drive 2 (node 1, axis 2)", "can0"})) << problems[0].text;
  EXPECT_EQ(problems[1].drive, 2);
}

}  // namespace
}  // namespace liana::realtime
