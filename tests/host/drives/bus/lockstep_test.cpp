// The embedded bus from end to end: DriveBus on one side, a plant on the other, virtual time between them.
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <map>
#include <random>

#include "host/drives/bus/frame_bits.hpp"
#include "tests/host/drives/bus/embedded_bench.hpp"

namespace liana::bus {
namespace {

using test::BusThread;
using test::PlantThread;
using test::small_table;

std::unique_ptr<DriveBus> open_patiently(const config::BusesConfig& table, timing::TimeMode mode,
                                         const std::string& path) {
  for (int attempt = 0;; ++attempt) {
    try {
      return open_drive_bus(table, mode, path);
    } catch (const std::runtime_error&) {
      if (attempt == 100) throw;
      usleep(10000);
    }
  }
}

// A drive per bus: answers SYNC with a TPDO whose data count the SYNCs, and remembers the RPDOs.
std::vector<wire::Frame> tpdos_for(const wire::Wake& wake) {
  std::vector<wire::Frame> out;
  for (std::size_t i = 0; i < wake.frame_count; ++i) {
    if (wake.frame[i].id != 0x080) continue;
    CanFrame tpdo{0x181U + wake.frame[i].bus,
                  8,
                  {static_cast<std::uint8_t>(wake.slot), static_cast<std::uint8_t>(wake.slot >> 8)},
                  0};
    out.push_back(wire::to_wire_frame(wake.frame[i].bus, tpdo));
  }
  return out;
}

CanFrame rpdo_of(int bus, std::uint64_t tick) {
  return {0x201U + static_cast<std::uint32_t>(bus),
          6,
          {static_cast<std::uint8_t>(tick * 7), static_cast<std::uint8_t>(tick)},
          0};
}

// One run of 300 ticks; participants dawdle at random when `jitter` is set. Returns the logs of both buses.
std::string logs_of_a_run(const std::string& name, unsigned jitter) {
  const std::string directory = test::fresh_directory(name);
  const auto dawdle = [jitter](std::mt19937& random) {
    if (jitter != 0 && random() % 20 == 0) usleep(static_cast<unsigned>(random() % 2000));
  };
  {
    BusThread bus_thread(small_table(), timing::TimeMode::kFast, directory);
    std::mt19937 plant_random(jitter);
    PlantThread plant(bus_thread.socket_path(), [&](const wire::Wake& wake) {
      dawdle(plant_random);
      return tpdos_for(wake);
    });
    auto bus = open_patiently(small_table(), timing::TimeMode::kFast, bus_thread.socket_path());
    std::mt19937 random(jitter + 1);
    for (std::uint64_t tick = 0; tick < 300; ++tick) {
      bus->begin_tick(tick);
      bus->write_sync();
      dawdle(random);
      bus->wait_feedback(2);
      for (int b = 0; b < 2; ++b) bus->send(b, rpdo_of(b, tick));
      bus->end_tick();
    }
    bus->begin_tick(300);
  }
  return test::read_file(directory + "/can0.log") + test::read_file(directory + "/can1.log");
}

TEST(Lockstep, TwoRunsWithDifferentTimingWriteTheSameLogs) {
  const std::string reference = logs_of_a_run("steady", 0);
  EXPECT_EQ(std::count(reference.begin(), reference.end(), '\n'), 300 * 3 * 2);
  EXPECT_EQ(logs_of_a_run("jittery", 7), reference);
  EXPECT_EQ(logs_of_a_run("otherwise", 99), reference);
}

TEST(Lockstep, EachTickGetsTheFeedbackOfItsOwnSyncAtTheTimesOfTheWire) {
  BusThread bus_thread(small_table(), timing::TimeMode::kFast);
  PlantThread plant(bus_thread.socket_path(), tpdos_for);
  auto bus = open_patiently(small_table(), timing::TimeMode::kFast, bus_thread.socket_path());
  ASSERT_EQ(bus->bus_count(), 2);
  const std::uint64_t sync_bits = frame_bits(CanFrame{0x080, 0, {}, 0});
  for (std::uint64_t tick = 0; tick < 50; ++tick) {
    const timing::TickStart start = bus->begin_tick(tick);
    EXPECT_EQ(start.tick, tick);
    EXPECT_EQ(start.lost_ticks, 0U);
    EXPECT_FALSE(start.ended);
    EXPECT_EQ(bus->now_us(), tick * 4000);
    EXPECT_EQ(bus->write_sync(), SendResult::kOk);
    bus->wait_feedback(2);
    EXPECT_EQ(bus->now_us(), tick * 4000 + 2000);
    ReceivedFrame received;
    int count = 0;
    for (; bus->receive(received); ++count) {
      EXPECT_EQ(received.frame.data[0], static_cast<std::uint8_t>(tick));
      // The plant runs when SYNC has ended on both buses: can1 has half the bit rate.
      const std::uint64_t bit_us = received.bus == 0 ? 1 : 2;
      EXPECT_EQ(received.frame.time_us, tick * 4000 + 2 * sync_bits + bit_us * frame_bits(received.frame));
    }
    EXPECT_EQ(count, 2);
    bus->end_tick();
  }
  EXPECT_EQ(bus->stats(0).sent, 50U);
  EXPECT_EQ(bus->stats(0).received, 50U);
  EXPECT_EQ(bus->stats(0).refused, 0U);
}

TEST(Lockstep, BothEndsCountTheSameFramesAndBits) {
  BusThread bus_thread(small_table(), timing::TimeMode::kFast);
  DriveBusStats stats;
  {
    PlantThread plant(bus_thread.socket_path(), tpdos_for);
    auto bus = open_patiently(small_table(), timing::TimeMode::kFast, bus_thread.socket_path());
    for (std::uint64_t tick = 0; tick < 20; ++tick) {
      bus->begin_tick(tick);
      bus->write_sync();
      bus->wait_feedback(2);
      bus->end_tick();
    }
    bus->begin_tick(20);
    stats = bus->stats(1);
    EXPECT_NEAR(bus->measured_load(1, 500000), static_cast<double>(stats.bits) / 500000 / 0.08, 1e-12);
    bus.reset();
  }
  EXPECT_EQ(bus_thread.outcome().stats[1].frames, stats.sent + stats.received);
  EXPECT_EQ(bus_thread.outcome().stats[1].bits, stats.bits);
  EXPECT_EQ(bus_thread.outcome().end_reason, program_invocation_short_name + std::string(" left"));
}

TEST(Lockstep, AScriptedPauseCostsTheControllerItsDeadlinesAndTheBusGoesOn) {
  BusThread bus_thread(small_table(), timing::TimeMode::kFast, "",
                       bus_simulator::FaultScript({{bus_simulator::BusAction::kPause, 0, 3, 5}}));
  PlantThread plant(bus_thread.socket_path(), tpdos_for);
  auto bus = open_patiently(small_table(), timing::TimeMode::kFast, bus_thread.socket_path());
  for (std::uint64_t tick = 0; tick < 10; ++tick) {
    const timing::TickStart start = bus->begin_tick(tick);
    EXPECT_EQ(start.lost_ticks, tick == 3 ? 3U : 0U);
    EXPECT_EQ(start.tick, tick + start.lost_ticks);
    EXPECT_EQ(bus->now_us(), start.tick * 4000);
    tick = start.tick;
    bus->write_sync();
    bus->wait_feedback(2);
    bus->end_tick();
  }
}

TEST(Lockstep, TheControllersInterfaceSaysWhatSocketCanWouldSay) {
  BusThread bus_thread(small_table(), timing::TimeMode::kFast, "",
                       bus_simulator::FaultScript({{bus_simulator::BusAction::kDown, 0, 2, 3},
                                                   {bus_simulator::BusAction::kDisturb, 1, 2, 3},
                                                   {bus_simulator::BusAction::kRestart, 1, 6, 6}}));
  PlantThread plant(bus_thread.socket_path(), tpdos_for);
  auto bus = open_patiently(small_table(), timing::TimeMode::kFast, bus_thread.socket_path());
  std::vector<BusState> down, off;
  for (std::uint64_t tick = 0; tick < 9; ++tick) {
    bus->begin_tick(tick);
    const SendResult sent = bus->write_sync();
    EXPECT_EQ(sent == SendResult::kDown, !down.empty() && down.back() == BusState::kDown) << tick;
    bus->wait_feedback(2);
    down.push_back(bus->stats(0).state);
    off.push_back(bus->stats(1).state);
    bus->end_tick();
  }
  using enum BusState;
  EXPECT_EQ(down, (std::vector<BusState>{kActive, kActive, kDown, kDown, kActive, kActive, kActive, kActive, kActive}));
  EXPECT_EQ(off[1], kActive);
  EXPECT_EQ(off[5], kBusOff);
  EXPECT_EQ(off[7], kActive);
  EXPECT_EQ(bus->stats(1).errors, 4U) << "warning, passive, bus-off, restarted";
}

TEST(Lockstep, AScriptedLossReachesTheControllerAsAMissingTpdo) {
  BusThread bus_thread(small_table(), timing::TimeMode::kFast, "",
                       bus_simulator::FaultScript({{bus_simulator::BusAction::kDrop, 0, 3, 4, 0x181}}));
  PlantThread plant(bus_thread.socket_path(), tpdos_for);
  auto bus = open_patiently(small_table(), timing::TimeMode::kFast, bus_thread.socket_path());
  for (std::uint64_t tick = 0; tick < 8; ++tick) {
    bus->begin_tick(tick);
    bus->write_sync();
    bus->wait_feedback(2);
    std::map<int, int> count;
    for (ReceivedFrame received; bus->receive(received);) ++count[received.bus];
    EXPECT_EQ(count[0], tick == 3 || tick == 4 ? 0 : 1) << tick;
    EXPECT_EQ(count[1], 1) << tick;
    bus->end_tick();
  }
}

TEST(Lockstep, ThePlantStillRunsWhenNoSyncComes) {
  std::atomic<int> wakes = 0;
  BusThread bus_thread(small_table(), timing::TimeMode::kFast);
  {
    PlantThread plant(bus_thread.socket_path(), [&](const wire::Wake&) {
      ++wakes;
      return std::vector<wire::Frame>{};
    });
    auto bus = open_patiently(small_table(), timing::TimeMode::kFast, bus_thread.socket_path());
    for (std::uint64_t tick = 0; tick < 20; ++tick) {
      bus->begin_tick(tick);
      bus->wait_feedback(0);
      bus->end_tick();
    }
    bus.reset();
  }
  EXPECT_GE(wakes, 10);
}

TEST(Lockstep, TheSyncFrameThatGetsLostOnOneBusStillLetsTheOtherRun) {
  BusThread bus_thread(small_table(), timing::TimeMode::kFast, "",
                       bus_simulator::FaultScript({{bus_simulator::BusAction::kDrop, 1, 0, 100, 0x080}}));
  PlantThread plant(bus_thread.socket_path(), tpdos_for);
  auto bus = open_patiently(small_table(), timing::TimeMode::kFast, bus_thread.socket_path());
  for (std::uint64_t tick = 0; tick < 5; ++tick) {
    bus->begin_tick(tick);
    bus->write_sync();
    bus->wait_feedback(1);
    ReceivedFrame received;
    ASSERT_TRUE(bus->receive(received));
    EXPECT_EQ(received.bus, 0);
    EXPECT_FALSE(bus->receive(received));
    bus->end_tick();
  }
}

TEST(Lockstep, AFullTransmitQueueRefusesAndCounts) {
  BusThread bus_thread(small_table(), timing::TimeMode::kFast);
  PlantThread plant(bus_thread.socket_path(), tpdos_for);
  auto bus = open_patiently(small_table(), timing::TimeMode::kFast, bus_thread.socket_path());
  bus->begin_tick(0);
  for (int i = 0; i < 64; ++i) EXPECT_EQ(bus->send(0, rpdo_of(0, 0)), SendResult::kOk);
  EXPECT_EQ(bus->send(0, rpdo_of(0, 0)), SendResult::kQueueFull);
  bus->wait_feedback(0);  // about 20 of them have gone
  for (int i = 0; i < 64; ++i) EXPECT_EQ(bus->send(0, rpdo_of(0, 0)), SendResult::kOk) << "only the bus knows";
  bus->end_tick();
  bus->begin_tick(1);
  EXPECT_GT(bus->stats(0).refused, 30U);
  EXPECT_EQ(bus->stats(0).sent + bus->stats(0).refused, 129U);
  EXPECT_EQ(bus->stats(1).refused, 0U);
}

TEST(Lockstep, TheControllerLearnsThatThePlantHasLeft) {
  BusThread bus_thread(small_table(), timing::TimeMode::kFast);
  {
    PlantThread plant(bus_thread.socket_path(), tpdos_for, 5);
    auto bus = open_patiently(small_table(), timing::TimeMode::kFast, bus_thread.socket_path());
    timing::TickStart start;
    std::uint64_t tick = 0;
    for (; tick < 100 && !start.ended; ++tick) {
      start = bus->begin_tick(tick);
      bus->write_sync();
      bus->wait_feedback(2);
      bus->end_tick();
    }
    EXPECT_LT(tick, 10U);
    EXPECT_EQ(bus->send(0, rpdo_of(0, 0)), SendResult::kDown);
    EXPECT_EQ(bus->stats(0).state, BusState::kDown);
  }
  EXPECT_EQ(bus_thread.outcome().end_reason, "plant left");
}

TEST(Lockstep, PacedTimeNeverRunsAheadOfTheWallClock) {
  const auto start = std::chrono::steady_clock::now();  // before the bus's own clock begins, however long that takes
  BusThread bus_thread(small_table(), timing::TimeMode::kPaced);
  PlantThread plant(bus_thread.socket_path(), tpdos_for);
  auto bus = open_patiently(small_table(), timing::TimeMode::kPaced, bus_thread.socket_path());
  bus->begin_tick(0);
  for (std::uint64_t tick = 0; tick < 50; ++tick) {
    bus->begin_tick(tick);
    EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::microseconds(4000 * tick));
    bus->write_sync();
    bus->wait_feedback(2);
    bus->end_tick();
  }
}

TEST(RealTime, FramesGoBothWaysWithoutAnybodyWaiting) {
  BusThread bus_thread(small_table(), timing::TimeMode::kReal);
  {
    PlantThread plant(bus_thread.socket_path(), tpdos_for);
    auto bus = open_patiently(small_table(), timing::TimeMode::kReal, bus_thread.socket_path());
    int tpdos = 0;
    std::uint64_t tick = 0;
    for (int i = 0; i < 50; ++i) {
      const timing::TickStart start = bus->begin_tick(tick);
      EXPECT_EQ(start.tick, tick + start.lost_ticks);
      tick = start.tick + 1;
      bus->write_sync();
      bus->wait_feedback(2);
      for (ReceivedFrame received; bus->receive(received);) ++tpdos;
      bus->end_tick();
    }
    EXPECT_GT(tpdos, 10) << "how many arrive in time is the machine's business, most of them usually";
    bus.reset();
  }
  EXPECT_EQ(bus_thread.outcome().end_reason, program_invocation_short_name + std::string(" left"));
  EXPECT_GE(bus_thread.outcome().stats[0].frames, 50U);
}

}  // namespace
}  // namespace liana::bus
