// What becomes of the frames of wrist sensor, adapter and load cells, and what they are told. req:B19 req:A10
#include "host/control/realtime/sensor_channel.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/host/drives/bus/quiet_bus.hpp"

namespace liana::realtime {
namespace {

constexpr int kBus = 1;

config::BusesConfig buses() {
  config::BusesConfig buses;
  buses.buses.resize(2);
  buses.buses[kBus].wrist_sensor = 0x20;
  buses.buses[kBus].adapter = 0x30;
  return buses;
}

bus::CanFrame force(std::uint8_t sequence, std::uint8_t status = 0) {
  return {0x1A0, 8, {50, 0, 0, 0, 0, 0, sequence, status}, 0};  // 1 N along x
}
bus::CanFrame torque(std::uint8_t sequence, std::uint8_t status = 0) {
  return {0x2A0, 8, {0, 0, 100, 0, 0, 0, sequence, status}, 0};  // 1 N m about y
}

// Remembers what is sent.
class Listener final : public test::QuietBus {
 public:
  Listener() : QuietBus(2) {}
  bus::SendResult send(int bus, const bus::CanFrame& frame) noexcept override {
    EXPECT_EQ(bus, kBus);
    sent.push_back(frame);
    return bus::SendResult::kOk;
  }
  std::vector<bus::CanFrame> sent;
};

TEST(SensorChannel, ASampleIsTakenWhenBothItsHalvesHaveComeInWhicheverOrder) {
  SensorChannel line(buses());
  EXPECT_EQ(line.sensors().wrist.age_ticks, serial::kNeverHeard);
  line.on_frame(kBus, force(1));
  EXPECT_EQ(line.sensors().wrist.age_ticks, serial::kNeverHeard);
  line.on_frame(kBus, torque(1));
  EXPECT_EQ(line.sensors().wrist.age_ticks, 0);
  EXPECT_DOUBLE_EQ(line.sensors().wrist.on_arm.force_N[0], 1.0);
  EXPECT_DOUBLE_EQ(line.sensors().wrist.on_arm.torque_Nm[1], 1.0);
  line.begin_tick(0);
  line.on_frame(kBus, torque(2));
  line.on_frame(kBus, force(3));  // the second half of 2 was lost
  EXPECT_EQ(line.sensors().wrist.sequence, 1);
  line.on_frame(kBus, torque(3));
  EXPECT_EQ(line.sensors().wrist.sequence, 3);
  EXPECT_EQ(line.sensors().wrist.age_ticks, 0);
}

TEST(SensorChannel, TheWorseStatusOfBothHalvesCountsAndOtherBusesDoNot) {
  SensorChannel line(buses());
  line.on_frame(0, force(1));
  line.on_frame(0, torque(1));
  EXPECT_EQ(line.sensors().wrist.age_ticks, serial::kNeverHeard);
  line.on_frame(kBus, force(1));
  line.on_frame(kBus, torque(1, 1));
  EXPECT_EQ(line.sensors().wrist.status, serial::WristStatus::kSaturated);
}

TEST(SensorChannel, WhatDoesNotComeGrowsOlderByLostTicksToo) {
  SensorChannel line(buses());
  line.on_frame(kBus, {0x1B0, 8, {4, 1, 2, 0, 200, 201, 202, 0}, 0});
  EXPECT_EQ(line.sensors().adapter.captured, 1);
  line.begin_tick(0);
  EXPECT_EQ(line.sensors().adapter.age_ticks, 1);
  line.begin_tick(3);
  EXPECT_EQ(line.sensors().adapter.age_ticks, 5);
  EXPECT_EQ(line.sensors().wrist.age_ticks, serial::kNeverHeard);
  line.on_frame(kBus, force(1));
  line.on_frame(kBus, torque(1));
  line.begin_tick(0);
  line.on_frame(kBus, torque(1));
  EXPECT_EQ(line.sensors().wrist.age_ticks, 1) << "half a sample is none";
  line.begin_tick(3);
  EXPECT_EQ(line.sensors().wrist.age_ticks, 5);
}

TEST(SensorChannel, EachNodeIsStartedByItsOwnHeartbeatOnItsOwnBus) {
  config::BusesConfig tables = buses();
  tables.buses[kBus].load_cells = {{0x28, {0}, {0.0}}, {0x29, {1}, {0.0}}};
  SensorChannel line(tables);
  Listener bus;
  for (const std::uint32_t node : {0x20U, 0x28U, 0x29U, 0x30U}) {
    line.on_frame(0, {0x700U + node, 1, {0x7F}, 0});
    line.on_frame(kBus, {0x700U + node, 2, {0x7F}, 0});
    line.step(bus, 1, serial::AdapterCommand::kNone, 0);
    EXPECT_TRUE(bus.sent.empty()) << "another bus, another length";
    line.on_frame(kBus, {0x700U + node, 1, {0x7F}, 0});
    line.step(bus, 1, serial::AdapterCommand::kNone, 0);
    ASSERT_EQ(bus.sent.size(), 1U);
    EXPECT_EQ(bus.sent[0].data[1], node);
    bus.sent.clear();
  }
}

// Two nodes: cables 1 and 3 on one bus, cable 32 on the other.
TEST(SensorChannel, ReadingsOfLoadCellsGoToTheirCablesAndGrowOlder) {
  config::BusesConfig buses;
  buses.buses.resize(2);
  buses.buses[0].load_cells = {{0x28, {0, 2}, {0.0, 0.0}}};
  buses.buses[1].load_cells = {{0x29, {31}, {0.0}}};
  SensorChannel line(buses);
  line.begin_tick(0);
  EXPECT_EQ(line.load_cells().age_ticks[0], cable::kNeverRead);
  line.on_frame(0, {0x1A8, 4, {0xD0, 0x07, 0x30, 0xF8}, 0});
  line.on_frame(0, {0x1A9, 2, {1, 0}, 0});        // on the wrong bus
  line.on_frame(1, {0x1A9, 4, {1, 0, 0, 0}, 0});  // of a wrong length
  EXPECT_EQ(line.load_cells().steps[0], 2000);
  EXPECT_EQ(line.load_cells().steps[2], -2000);
  EXPECT_EQ(line.load_cells().age_ticks[31], cable::kNeverRead);
  line.begin_tick(2);
  line.on_frame(1, {0x1A9, 2, {0xFF, 0x7F}, 0});
  EXPECT_EQ(line.load_cells().age_ticks[2], 3);
  EXPECT_EQ(line.load_cells().age_ticks[1], cable::kNeverRead);
  EXPECT_EQ(line.load_cells().steps[31], cable::kOverRange);
  EXPECT_EQ(line.load_cells().age_ticks[31], 0);
}

TEST(SensorChannel, ANodeThatIsNotOperationalIsStartedOncePerHeartbeatAndTheAdapterToldEveryFourthTick) {
  SensorChannel line(buses());
  Listener bus;
  line.step(bus, 4, serial::AdapterCommand::kNone, 0);
  EXPECT_TRUE(bus.sent.empty());
  line.on_frame(kBus, {0x720, 1, {0x7F}, 0});
  for (std::uint64_t tick = 5; tick < 8; ++tick) line.step(bus, tick, serial::AdapterCommand::kNone, 0);
  ASSERT_EQ(bus.sent.size(), 1u);
  EXPECT_EQ(bus.sent[0].id, 0u);
  EXPECT_EQ(bus.sent[0].data[0], 1);
  EXPECT_EQ(bus.sent[0].data[1], 0x20);
  line.on_frame(kBus, {0x720, 1, {0x05}, 0});
  for (std::uint64_t tick = 8; tick < 16; ++tick) line.step(bus, tick, serial::AdapterCommand::kLock, 7);
  ASSERT_EQ(bus.sent.size(), 3u);
  EXPECT_EQ(bus.sent[2].id, 0x230u);
  EXPECT_EQ(bus.sent[2].length, 2);
  EXPECT_EQ(bus.sent[2].data[0], 1);
  EXPECT_EQ(bus.sent[2].data[1], 7);
}

}  // namespace
}  // namespace liana::realtime
