// Heartbeats both ways, emergencies, frame routing, and what is expected of the drives of a table.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "host/drives/canopen/cob_id.hpp"
#include "host/drives/canopen/emergency.hpp"
#include "host/drives/canopen/heartbeat.hpp"
#include "host/drives/canopen/master.hpp"
#include "host/drives/canopen/mode_monitor.hpp"
#include "tests/host/drives/bus/quiet_bus.hpp"
#include "tests/message.hpp"

namespace liana::canopen {
namespace {

// Keeps what is sent.
class RecordingBus final : public test::QuietBus {
 public:
  RecordingBus() : QuietBus(2) {}
  bus::SendResult send(int bus, const bus::CanFrame& frame) noexcept override {
    sent.push_back({bus, frame});
    return bus::SendResult::kOk;
  }
  std::vector<bus::ReceivedFrame> sent;
};

TEST(Heartbeat, TheMasterSendsOnEveryBusEvery100Milliseconds) {
  RecordingBus bus;
  HeartbeatProducer producer(100, 250);
  std::vector<int> ticks;
  for (int tick = 0; tick < 80; ++tick) {
    const std::size_t before = bus.sent.size();
    producer.step(bus);
    if (bus.sent.size() == before) continue;
    ASSERT_EQ(bus.sent.size(), before + 2);
    EXPECT_EQ(bus.sent[before].bus, 0);
    EXPECT_EQ(bus.sent[before + 1].bus, 1);
    EXPECT_EQ(bus.sent[before].frame.id, 0x77FU);
    EXPECT_EQ(bus.sent[before].frame.length, 1);
    EXPECT_EQ(bus.sent[before].frame.data[0], 0x05);
    ticks.push_back(tick);
  }
  EXPECT_EQ(ticks, (std::vector<int>{0, 25, 50, 75}));
}

TEST(Heartbeat, ADriveIsLostWhenItsLastHeartbeatIsOlderThanTheLimit) {
  HeartbeatMonitor monitor(300, 250);
  EXPECT_TRUE(monitor.lost(1)) << "never heard";
  monitor.on_heartbeat(1, 0x05);
  EXPECT_EQ(monitor.state(1), 0x05);
  for (int tick = 0; tick < 75; ++tick) monitor.step();
  EXPECT_EQ(monitor.age_ticks(1), 75U);
  EXPECT_FALSE(monitor.lost(1));
  monitor.step();
  EXPECT_TRUE(monitor.lost(1));
  monitor.on_heartbeat(1, 0x05);
  EXPECT_FALSE(monitor.lost(1));
  EXPECT_TRUE(monitor.lost(2));
}

TEST(Heartbeat, BootUpMessagesAreCountedSoThatARestartShows) {
  HeartbeatMonitor monitor(300, 250);
  monitor.on_heartbeat(4, 0x00);
  monitor.on_heartbeat(4, 0x05);
  monitor.on_heartbeat(4, 0x00);
  EXPECT_EQ(monitor.boot_ups(4), 2U);
  EXPECT_EQ(monitor.boot_ups(5), 0U);
}

bus::CanFrame emergency_frame(std::uint16_t code) {
  return {0x083, 8, {static_cast<std::uint8_t>(code), static_cast<std::uint8_t>(code >> 8), 0x11, 1, 2, 3, 4, 5}, 0};
}

TEST(Emergencies, AreKeptInOrderWithCodeRegisterAndVendorBytes) {
  EmergencyLog log;
  log.on_frame(1, 3, emergency_frame(0x8130), 70);
  log.on_frame(1, 3, emergency_frame(0x0000), 80);
  Emergency emergency;
  ASSERT_TRUE(log.take(emergency));
  EXPECT_EQ(emergency.bus, 1);
  EXPECT_EQ(emergency.node, 3);
  EXPECT_EQ(emergency.code, 0x8130);
  EXPECT_EQ(emergency.error_register, 0x11);
  EXPECT_EQ(emergency.vendor, (std::array<std::uint8_t, 5>{1, 2, 3, 4, 5}));
  EXPECT_EQ(emergency.tick, 70U);
  ASSERT_TRUE(log.take(emergency));
  EXPECT_EQ(emergency.code, 0);
  EXPECT_FALSE(log.take(emergency));
  EXPECT_EQ(log.last_code(3), 0);
}

TEST(Emergencies, TheOldestIsDroppedAndCountedWhenNobodyFetchesThem) {
  EmergencyLog log;
  for (std::uint16_t i = 0; i < 70; ++i) log.on_frame(0, 1, emergency_frame(i), i);
  EXPECT_EQ(log.dropped(), 6U);
  Emergency emergency;
  ASSERT_TRUE(log.take(emergency));
  EXPECT_EQ(emergency.tick, 6U);
  EXPECT_EQ(log.last_code(1), 69);
  for (std::uint64_t tick = 7; tick < 70; ++tick) {
    ASSERT_TRUE(log.take(emergency));
    EXPECT_EQ(emergency.tick, tick);
  }
  EXPECT_FALSE(log.take(emergency));
}

TEST(Emergencies, HaveATextForTheCodeOrItsClass) {
  EXPECT_TRUE(names(emergency_text(0x8130), {"heartbeat", "lost"}));
  EXPECT_TRUE(names(emergency_text(0x8250), {"RPDO", "deadline"}));
  EXPECT_STREQ(emergency_text(0x3210), "voltage");
  EXPECT_STREQ(emergency_text(0xFF01), "device specific");
  EXPECT_STREQ(emergency_text(0), "no error");
  EXPECT_STREQ(emergency_text(0xA000), "unknown");
}

TEST(Routing, EveryIdentifierOfThePredefinedSetFindsItsKindAndNode) {
  const auto check = [](std::uint32_t id, FrameKind kind, int node) {
    EXPECT_EQ(route(id).kind, kind) << std::hex << id;
    EXPECT_EQ(route(id).node, node) << std::hex << id;
  };
  check(0x000, FrameKind::kNmt, 0);
  check(0x080, FrameKind::kSync, 0);
  check(0x08F, FrameKind::kEmergency, 15);
  check(0x181, FrameKind::kTpdo1, 1);
  check(0x20F, FrameKind::kRpdo1, 15);
  check(0x381, FrameKind::kTpdo1, 1);
  check(0x40F, FrameKind::kRpdo1, 15);
  EXPECT_EQ(route(0x181).axis, 1);
  EXPECT_EQ(route(0x381).axis, 2);
  EXPECT_EQ(route(0x40F).axis, 2);
  check(0x582, FrameKind::kSdoResponse, 2);
  check(0x602, FrameKind::kSdoRequest, 2);
  check(0x77F, FrameKind::kHeartbeat, 127);
  check(0x100, FrameKind::kOther, 0);
  check(0x281, FrameKind::kOther, 0);
  check(0x180, FrameKind::kOther, 0);
  check(0x181 | bus::kCanExtendedFlag, FrameKind::kOther, 0);
  check(0x181 | bus::kCanRemoteFlag, FrameKind::kOther, 0);
}

config::BusesConfig buses_at(double rate_hz) {
  config::BusesConfig buses;
  buses.name = "test";
  buses.rate_hz = rate_hz;
  buses.heartbeat_ms = 100;
  buses.buses = {{"can0", 1000000, {1, 3}}, {"can1", 1000000, {2}}};
  return buses;
}

config::RobotConfig robot_with_three_cables() {
  config::RobotConfig robot;
  robot.name = "test";
  robot.table.segment_count = 1;
  robot.table.segment[0].cables = 3;
  robot.table.cable_EA_N = 1e5;
  robot.table.tick_s = 0.004;
  robot.table.limits.cable_speed_m_s = 0.01;
  for (auto& drive : robot.table.drive) drive.metres_per_count = 1e-6;
  robot.identity = {0x4C49, 1, 2};
  robot.rated_torque_Nm = 9;
  robot.counts_per_turn = 65536;
  robot.gear = 4.5;
  robot.drive_serials = {1001, 1002, 1003};
  return robot;
}

TEST(Expectations, FollowFromRobotAndBusTable) {
  const auto drives = drive_expectations(robot_with_three_cables(), buses_at(250));
  ASSERT_EQ(drives.size(), 3U);
  EXPECT_EQ(drives[1].node, 2);
  EXPECT_EQ(drives[1].bus, 1);
  EXPECT_EQ(drives[2].bus, 0);
  EXPECT_EQ(drives[2].serial, 1003U);
  config::RobotConfig unknown = robot_with_three_cables();
  unknown.drive_serials.clear();
  EXPECT_EQ(drive_expectations(unknown, buses_at(250))[2].serial, std::nullopt);
  EXPECT_EQ(drives[0].rated_torque_mNm, 2000U) << "of the motor, before the gear";
  EXPECT_EQ(drives[0].gear_motor_turns, 9U);
  EXPECT_EQ(drives[0].gear_drum_turns, 2U);
  EXPECT_EQ(drives[0].rpdo_deadline_ms, 12);
  EXPECT_EQ(drives[0].master_timeout_ms, 300);
  EXPECT_EQ(drives[0].following_window_counts, 5000U);
  EXPECT_EQ(drives[0].period.value, 4);
  EXPECT_EQ(drives[0].period.exponent, -3);
  EXPECT_NEAR(drives[0].demand.counts_per_s, 10000, 1e-6);
  EXPECT_EQ(drive_expectations(robot_with_three_cables(), buses_at(800))[0].rpdo_deadline_ms, 4)
      << "3.75 ms, rounded up";
}

TEST(Expectations, ADriveOnNoBusIsNamed) {
  config::BusesConfig buses = buses_at(250);
  buses.buses.pop_back();
  try {
    drive_expectations(robot_with_three_cables(), buses);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("node 2"), std::string::npos);
  }
}

TEST(Master, TakesItsOwnFramesAndLeavesProcessDataToTheCaller) {
  Master master(drive_expectations(robot_with_three_cables(), buses_at(250)), buses_at(250));
  EXPECT_TRUE(master.on_frame(0, bus::CanFrame{0x701, 1, {0x05}, 0}, 1));
  EXPECT_TRUE(master.on_frame(0, bus::CanFrame{0x581, 8, {}, 0}, 1));
  EXPECT_TRUE(master.on_frame(0, emergency_frame(0x8130), 1));
  EXPECT_FALSE(master.on_frame(0, bus::CanFrame{0x181, 8, {}, 0}, 1));
  EXPECT_EQ(master.heartbeats().state(1), 0x05);
  EXPECT_EQ(master.emergencies().last_code(3), 0x8130);
}

TEST(Master, AHeartbeatMayBeMissedTwiceButNotThreeTimes) {
  RecordingBus bus;
  Master master(drive_expectations(robot_with_three_cables(), buses_at(250)), buses_at(250));
  master.on_frame(0, bus::CanFrame{0x701, 1, {0x05}, 0}, 1);
  for (int tick = 0; tick < 75; ++tick) master.step(bus);
  EXPECT_FALSE(master.heartbeats().lost(1));
  master.step(bus);
  EXPECT_TRUE(master.heartbeats().lost(1));
  const auto own = [](const bus::ReceivedFrame& sent) { return sent.frame.id == 0x77F && sent.bus == 1; };
  EXPECT_EQ(std::count_if(bus.sent.begin(), bus.sent.end(), own), 4) << "its own in ticks 0, 25, 50 and 75";
}

TEST(Master, CommandsAllDrivesOfAllBuses) {
  RecordingBus bus;
  Master::command_all(bus, kNmtStop);
  ASSERT_EQ(bus.sent.size(), 2U);
  EXPECT_EQ(bus.sent[1].bus, 1);
  EXPECT_EQ(bus.sent[1].frame.id, 0U);
  EXPECT_EQ(bus.sent[1].frame.data[0], kNmtStop);
  EXPECT_EQ(bus.sent[1].frame.data[1], 0);
}

// Drives that answer for 6061 in the next tick, on one bus at 250 Hz.
struct ModeBench {
  explicit ModeBench(int count, double max_load = 1.0) : shown(static_cast<std::size_t>(count), 8) {
    buses.rate_hz = 250.0;
    buses.heartbeat_ms = 100;
    buses.max_load = max_load;
    buses.buses = {{"can0", 1000000, {}}};
    for (int i = 0; i < count; ++i) {
      buses.buses[0].nodes.push_back(i + 1);
      drives.emplace_back();
      drives.back().node = static_cast<std::uint8_t>(i + 1);
    }
    monitor.emplace(drives, buses);
  }
  void tick(std::uint32_t in_operation) {
    for (const bus::ReceivedFrame& sent : std::exchange(bus.sent, {})) {
      const std::size_t i = (sent.frame.id & 0x7F) - 1;
      if (sent.frame.data[0] != 0x40) continue;
      ++asked;
      bus::CanFrame answer{0x580U + static_cast<std::uint32_t>(i + 1), 8, {0x4F, 0x61, 0x60, 0}, 0};
      answer.data[4] = static_cast<std::uint8_t>(shown[i]);
      if (has_none) answer.data = {0x80, 0x61, 0x60, 0, 0, 0, refusal, 0x06};
      monitor->on_frame(answers_on.value_or(sent.bus), answer);
    }
    monitor->step(bus, in_operation);
  }

  config::BusesConfig buses;
  std::vector<ExpectedDrive> drives;
  std::optional<ModeMonitor> monitor;
  RecordingBus bus;
  std::vector<int> shown;
  int asked = 0;
  bool has_none = false;
  std::uint8_t refusal = 0x02;      // of 0x0602'0000: the object does not exist
  std::optional<int> answers_on{};  // instead of the bus on which it was asked
};

TEST(ModeMonitor, SeesAnotherModeOfAnyDriveWithinTenTicksHoweverManyThereAre) {
  for (const int count : {1, 3, 8, 9, 15, 32}) {
    const std::uint32_t all = count == 32 ? ~0U : (1U << count) - 1U;
    for (const int drive : {0, count / 2, count - 1}) {
      for (int phase = 0; phase < 8; ++phase) {
        ModeBench bench(count, 1e9);
        for (int i = 0; i < 40 + phase; ++i) bench.tick(all);
        ASSERT_EQ(bench.monitor->other_mode(), 0U);
        bench.shown[static_cast<std::size_t>(drive)] = -1;
        int ticks = 0;
        while (bench.monitor->other_mode() == 0 && ticks < 50) {
          bench.tick(all);
          ++ticks;
        }
        EXPECT_EQ(bench.monitor->other_mode(), 1U << drive);
        EXPECT_LE(ticks, 10) << count << " drives, " << drive << ", " << phase;
        bench.shown[static_cast<std::size_t>(drive)] = 8;
        for (int i = 0; i < 10; ++i) bench.tick(all);
        EXPECT_EQ(bench.monitor->other_mode(), 0U);
      }
    }
  }
}

// Two axes of one node, whose server answers after so many ticks.
TEST(ModeMonitor, AsksTheAxesOfANodeInTurnAndSeesWhichOneHasAnotherMode) {
  for (const int delay : {1, 7, 20}) {
    ModeBench bench(2);
    for (ExpectedDrive& drive : bench.drives) drive.node = 1;
    bench.drives[1].axis = 2;
    bench.monitor.emplace(bench.drives, bench.buses);
    int open = 0, left = 0;
    std::array<int, 2> asked{};
    bus::CanFrame answer;
    for (int i = 0; i < 400; ++i) {
      for (const bus::ReceivedFrame& sent : std::exchange(bench.bus.sent, {})) {
        ASSERT_EQ(sent.frame.data[0], 0x40) << "nothing is given up";
        ASSERT_EQ(++open, 1) << "one request at a time";
        const bool second = sent.frame.data[2] == 0x68;
        ++asked[second ? 1 : 0];
        answer = {0x581, 8, {0x4F, 0x61, sent.frame.data[2], 0, static_cast<std::uint8_t>(second ? 3 : 8)}, 0};
        left = delay;
      }
      if (left > 0 && --left == 0) {
        --open;
        bench.monitor->on_frame(0, answer);
      }
      bench.monitor->step(bench.bus, 3);
    }
    EXPECT_GE(asked[0], 8) << delay;
    EXPECT_GE(asked[1], 8) << delay;
    EXPECT_EQ(bench.monitor->other_mode(), 2U);
  }
}

TEST(ModeMonitor, AsksOnlyInOperationAndForgetsWhatWasShownBefore) {
  ModeBench bench(2);
  bench.shown = {0, 0};
  for (int i = 0; i < 50; ++i) bench.tick(0);
  EXPECT_EQ(bench.asked, 0);
  for (int i = 0; i < 20; ++i) bench.tick(2);
  EXPECT_EQ(bench.monitor->other_mode(), 2U);
  bench.tick(0);
  EXPECT_EQ(bench.monitor->other_mode(), 0U);
}

TEST(ModeMonitor, ADriveIsAskedFromItsThirdTickInOperationOn) {
  for (int ticks = 1; ticks <= 4; ++ticks) {
    ModeBench bench(8);  // one of them is asked in every tick
    for (int i = 0; i < 8; ++i) bench.tick(0xFF);
    bench.tick(0);
    bench.tick(0);
    bench.asked = 0;
    for (int i = 0; i < ticks; ++i) bench.tick(0xFF);
    bench.tick(0);
    EXPECT_EQ(bench.asked, std::max(0, ticks - 2)) << ticks;
  }
}

// A csp and a cst drive, each on a bus of its own.
struct TwoBusModes : ModeBench {
  TwoBusModes() : ModeBench(2) {
    buses.buses = {{"can0", 1000000, {1}}, {"can1", 1000000, {2}}};
    drives[1].bus = 1;
    drives[1].type.is_cst = true;
    shown = {8, 10};
    monitor.emplace(drives, buses);
  }
  std::uint32_t after(int ticks) {
    for (int i = 0; i < ticks; ++i) tick(3);
    return monitor->other_mode();
  }
};

TEST(ModeMonitor, EachDriveHasItsOwnModeAndBus) {
  TwoBusModes bench;
  EXPECT_EQ(bench.after(40), 0U);
  bench.shown = {10, 8};
  EXPECT_EQ(bench.after(20), 3U);
  bench.shown = {10, 10};
  EXPECT_EQ(bench.after(20), 1U);
  bench.answers_on = 0;
  bench.shown = {8, 8};
  EXPECT_EQ(bench.after(20), 0U) << "what the second one says on the first bus is not its answer";
  for (const std::size_t full : {0U, 1U}) {
    TwoBusModes narrow;
    narrow.buses.buses[full].bitrate = 10000;
    narrow.monitor.emplace(narrow.drives, narrow.buses);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(narrow.monitor->bus_is_full(i), i == full);
      EXPECT_EQ(narrow.monitor->is_asked(i), i != full);
    }
  }
}

TEST(ModeMonitor, ARefusalForAnotherReasonOrALostAnswerIsAskedAgain) {
  ModeBench refused(2);
  refused.has_none = true;
  refused.refusal = 0x01;
  for (int i = 0; i < 40; ++i) refused.tick(3);
  EXPECT_GT(refused.asked, 4);
  TwoBusModes lost;
  lost.answers_on = 2;
  lost.after(20);
  const int before = lost.asked;
  EXPECT_EQ(before, 2) << "each waits half a second for its answer";
  lost.after(150);
  EXPECT_EQ(lost.asked, 4);
}

TEST(ModeMonitor, AnAnswerToAQuestionFromBeforeAPauseDoesNotCount) {
  ModeBench bench(1);
  const auto answer = [&](int mode) {
    bus::CanFrame frame{0x581, 8, {0x4F, 0x61, 0x60, 0, static_cast<std::uint8_t>(mode)}, 0};
    bench.monitor->on_frame(0, frame);
  };
  for (int i = 0; i < 20 && bench.bus.sent.empty(); ++i) bench.monitor->step(bench.bus, 1);
  ASSERT_FALSE(bench.bus.sent.empty());
  bench.monitor->step(bench.bus, 0);
  answer(0);
  EXPECT_EQ(bench.monitor->other_mode(), 0U);
}

TEST(ModeMonitor, ADriveWithout6061OrABusWithoutRoomIsNotAsked) {
  ModeBench none(2);
  none.has_none = true;
  for (int i = 0; i < 40; ++i) none.tick(3);
  EXPECT_EQ(none.asked, 2) << "each once";
  EXPECT_FALSE(none.monitor->is_asked(0));
  EXPECT_EQ(none.monitor->other_mode(), 0U);
  ModeBench full(2, 0.001);
  for (int i = 0; i < 40; ++i) full.tick(3);
  EXPECT_EQ(full.asked, 0);
  EXPECT_TRUE(full.monitor->bus_is_full(0));
}

}  // namespace
}  // namespace liana::canopen
