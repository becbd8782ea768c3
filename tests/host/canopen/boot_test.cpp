// Booting the drives as docs/drives.md wants it: order, every mismatch, losses, restarts, and nothing allocated on the
// way.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <memory>

#include "host/canopen/boot_sequence.hpp"
#include "host/canopen/cob_id.hpp"
#include "host/canopen/messages.hpp"
#include "tests/host/bus/allocation_count.hpp"
#include "tests/host/bus/fake_drive.hpp"

namespace liana::canopen {
namespace {

using test::AllocationCount;
using test::expectation;
using test::FakeDrive;

// Two buses in memory: frames sent in one tick are answered before the next.
class MemoryBus final : public bus::DriveBus {
 public:
  int bus_count() const noexcept override { return 2; }
  timing::TimeMode time_mode() const noexcept override { return timing::TimeMode::kFast; }
  timing::TickStart begin_tick(std::uint64_t tick) noexcept override { return {tick, 0, 0, false}; }
  bus::SendResult send(int bus, const bus::CanFrame& frame) noexcept override {
    if (refuse_next > 0 && refuse_next-- > 0) return bus::SendResult::kQueueFull;
    sent[count++] = {bus, frame};
    return bus::SendResult::kOk;
  }
  void wait_feedback(int) noexcept override {}
  bool receive(bus::ReceivedFrame&) noexcept override { return false; }
  void end_tick() noexcept override {}
  const bus::DriveBusStats& stats(int) const noexcept override { return stats_; }
  std::uint64_t now_us() const noexcept override { return 0; }

  std::array<bus::ReceivedFrame, 256> sent{};
  std::size_t count = 0;
  int refuse_next = 0;

 private:
  bus::DriveBusStats stats_;
};

constexpr BootTiming kTiming{20, 60, 5, 30, 80};

struct BootBench {
  BootBench() {
    for (std::uint8_t node = 1; node <= 15; ++node) {
      expected.push_back(expectation(node <= 8 ? 0 : 1, node));
      drives.emplace_back(expected.back());
    }
  }

  FakeDrive& drive(int node) { return drives[static_cast<std::size_t>(node - 1)]; }

  void deliver(const std::vector<bus::CanFrame>& frames, std::size_t drive) {
    for (const bus::CanFrame& frame : frames) {
      AllocationCount::start();
      boot->on_frame(expected[drive].bus, frame);
      AllocationCount::stop();
    }
  }

  // Runs until the boot is over; the ticks it took.
  int run() {
    boot = std::make_unique<BootSequence>(expected, kTiming);
    AllocationCount::clear();
    return go_on();
  }
  int go_on() {
    int tick = 0;
    for (; boot->state() == BootState::kRunning && tick < 2000; ++tick) {
      if (before_tick) before_tick(tick);
      bus.count = 0;
      AllocationCount::start();
      boot->step(bus);
      AllocationCount::stop();
      for (std::size_t i = 0; i < bus.count; ++i) {
        if (bus.sent[i].frame.id == 0 && bus.sent[i].frame.data[0] == kNmtResetCommunication)
          ++resets[bus.sent[i].frame.data[1]];
        if (bus.sent[i].frame.id == 0 && bus.sent[i].frame.data[0] == kNmtStart && lost_starts > 0 && lost_starts-- > 0)
          continue;
        for (std::size_t d = 0; d < drives.size(); ++d) {
          if (expected[d].bus == bus.sent[i].bus) deliver(drives[d].receive(bus.sent[i].frame), d);
        }
      }
      for (std::size_t d = 0; d < drives.size() && tick % 25 == 0; ++d) deliver(drives[d].heartbeat(), d);
    }
    return tick;
  }

  const BootMismatch& mismatch(int node) const { return boot->mismatch(static_cast<std::size_t>(node - 1)); }
  std::string text(int node) const { return describe(mismatch(node), "can0"); }

  std::vector<DriveExpectation> expected;
  std::vector<FakeDrive> drives;
  MemoryBus bus;
  std::function<void(int)> before_tick;
  std::map<int, int> resets;  // by node
  int lost_starts = 0;        // NMT starts that no drive will hear
  std::unique_ptr<BootSequence> boot;
};

constexpr std::uint32_t key(std::uint32_t index, std::uint32_t sub) { return FakeDrive::key(index, sub); }

TEST(Boot, AllDrivesOfBothBusesBecomeOperationalInParallel) {
  BootBench bench;
  const int ticks = bench.run();
  EXPECT_EQ(bench.boot->state(), BootState::kOperational);
  EXPECT_LT(ticks, 130) << "one exchange per tick and node";
  for (const FakeDrive& drive : bench.drives) EXPECT_EQ(drive.state, 0x05);
  const BootProgress progress = bench.boot->progress();
  EXPECT_EQ(progress.operational, 15);
  EXPECT_EQ(progress.configured, 15);
  EXPECT_EQ(progress.failed, 0);
  EXPECT_EQ(progress.objects_done, progress.objects_total);
}

TEST(Boot, NothingIsAllocatedInAStepNotEvenWhenADriveFails) {
  BootBench bench;
  bench.drive(3).objects[key(0x1018, 2)].value = 2;
  bench.drive(4).dead = true;
  bench.run();
  EXPECT_EQ(bench.boot->state(), BootState::kFailed);
  EXPECT_EQ(AllocationCount::value(), 0);
}

TEST(Boot, TheAllocationCounterSeesAPlantedNew) {
  AllocationCount::clear();
  AllocationCount::start();
  const auto planted = std::make_unique<int>(1);
  AllocationCount::stop();
  EXPECT_GT(AllocationCount::value(), 0);
}

TEST(Boot, EveryDriveEndsWithTheConfigurationOfTheContract) {
  BootBench bench;
  bench.run();
  const auto value = [&](std::uint32_t index, std::uint32_t sub) {
    return bench.drive(3).objects[key(index, sub)].value;
  };
  EXPECT_EQ(value(0x1400, 1), 0x203U);
  EXPECT_EQ(value(0x1400, 2), 1U);
  EXPECT_EQ(value(0x1400, 5), 12U);
  EXPECT_EQ(value(0x1600, 0), 2U);
  EXPECT_EQ(value(0x1600, 1), 0x60400010U);
  EXPECT_EQ(value(0x1600, 2), 0x607A0020U);
  EXPECT_EQ(value(0x1800, 1), 0x183U);
  EXPECT_EQ(value(0x1800, 2), 1U);
  EXPECT_EQ(value(0x1A00, 0), 3U);
  EXPECT_EQ(value(0x1A00, 3), 0x60770010U);
  for (std::uint32_t pdo = 1; pdo <= 3; ++pdo) {
    EXPECT_EQ(value(0x1400 + pdo, 1) >> 31, 1U);
    EXPECT_EQ(value(0x1800 + pdo, 1) >> 31, 1U);
  }
  EXPECT_EQ(value(0x6060, 0), 8U);
  EXPECT_EQ(value(0x60C2, 1), 4U);
  EXPECT_EQ(value(0x60C2, 2), 0xFDU);
  EXPECT_EQ(value(0x6072, 0), 1000U);
  EXPECT_EQ(value(0x6065, 0), 3476U);
  EXPECT_EQ(value(0x6066, 0), 100U);
  EXPECT_EQ(value(0x605A, 0), 2U);
  EXPECT_EQ(value(0x605E, 0), 2U);
  EXPECT_EQ(value(0x6007, 0), 3U);
  EXPECT_EQ(value(0x1017, 0), 100U);
  EXPECT_EQ(value(0x1016, 1), (127U << 16) | 300U);
}

TEST(Boot, APdoIsRemappedInTheOrderCia301Demands) {
  BootBench bench;
  bench.run();
  const std::vector<std::uint32_t> order{key(0x1400, 1), key(0x1600, 0), key(0x1600, 1), key(0x1600, 2),
                                         key(0x1600, 0), key(0x1400, 2), key(0x1400, 5), key(0x1400, 1)};
  const auto& writes = bench.drive(1).writes;
  ASSERT_GE(writes.size(), order.size());
  EXPECT_TRUE(std::equal(order.begin(), order.end(), writes.begin()));
}

TEST(Boot, EveryWrongIdentityOrMechanicIsNamedWithNodeObjectExpectedAndFound) {
  const std::pair<std::uint32_t, std::uint32_t> cases[] = {{0x1000, 0}, {0x1018, 1}, {0x1018, 2}, {0x1018, 3},
                                                           {0x1018, 4}, {0x6502, 0}, {0x608F, 1}, {0x608F, 2},
                                                           {0x6091, 1}, {0x6091, 2}, {0x6076, 0}};
  for (const auto& [index, sub] : cases) {
    BootBench bench;
    std::uint32_t& value = bench.drive(7).objects[key(index, sub)].value;
    value = index == 0x6502 ? 0x321 : value + 7;
    bench.run();
    ASSERT_EQ(bench.boot->state(), BootState::kFailed) << std::hex << index;
    const BootMismatch& mismatch = bench.mismatch(7);
    EXPECT_EQ(mismatch.failure, BootFailure::kValue);
    EXPECT_EQ(mismatch.node, 7);
    EXPECT_EQ(mismatch.index, index);
    EXPECT_EQ(mismatch.sub, sub);
    EXPECT_NE(mismatch.expected, mismatch.found);
    EXPECT_EQ(bench.boot->progress().failed, 1);
    for (const FakeDrive& drive : bench.drives)
      EXPECT_NE(drive.state, 0x05) << "one failing drive keeps all from starting";
  }
}

TEST(Boot, TheMessageOfAMismatchSaysAllOfIt) {
  BootBench bench;
  bench.drive(7).objects[key(0x1018, 2)].value = 9;
  bench.run();
  EXPECT_EQ(bench.text(7),
            "node 7 on can0: object 0x1018:2 (product code): expected 1 (0x1), found 9 (0x9): another drive is "
            "connected under this node id, or "
            "the robot table is wrong");
}

TEST(Boot, EveryWriteThatDoesNotStickIsFound) {
  BootBench reference;
  reference.run();
  std::set<std::uint32_t> written(reference.drive(2).writes.begin(), reference.drive(2).writes.end());
  written.erase(key(0x1600, 0));  // its first value, 0, is what it had
  written.erase(key(0x1A00, 0));
  ASSERT_GT(written.size(), 20U);
  for (const std::uint32_t object : written) {
    BootBench bench;
    bench.drive(2).stubborn.insert(object);
    bench.run();
    EXPECT_EQ(bench.boot->state(), BootState::kFailed) << std::hex << object;
    EXPECT_EQ(bench.mismatch(2).failure, BootFailure::kValue) << std::hex << object;
    EXPECT_EQ(key(bench.mismatch(2).index, bench.mismatch(2).sub), object);
    EXPECT_TRUE(bench.mismatch(2).written);
  }
}

TEST(Boot, ARefusedWriteIsReportedWithTheAbortCodeAsText) {
  BootBench bench;
  bench.drive(2).aborts[key(0x6072, 0)] = 0x06090031;
  bench.run();
  EXPECT_EQ(bench.mismatch(2).failure, BootFailure::kAborted);
  EXPECT_NE(bench.text(2).find(
                "0x6072:0 (max torque): writing 1000 (0x3E8) refused with abort code 0x06090031, value too high"),
            std::string::npos)
      << bench.text(2);
}

TEST(Boot, AMissingDriveIsNamedAndTheOthersAreCheckedToTheEnd) {
  BootBench bench;
  bench.drive(9).dead = true;
  bench.drive(12).objects[key(0x6076, 0)].value = 8000;
  bench.run();
  EXPECT_EQ(bench.boot->state(), BootState::kFailed);
  EXPECT_EQ(bench.mismatch(9).failure, BootFailure::kNoBootUp);
  EXPECT_EQ(bench.mismatch(12).failure, BootFailure::kValue);
  EXPECT_EQ(bench.boot->progress().configured, 13);
  EXPECT_NE(bench.text(9).find("no boot-up message"), std::string::npos);
}

TEST(Boot, ADriveThatFallsSilentIsNamedWithTheObject) {
  BootBench bench;
  bench.drive(1).deaf_from = key(0x6065, 0);
  bench.run();
  EXPECT_EQ(bench.mismatch(1).failure, BootFailure::kNoAnswer);
  EXPECT_EQ(bench.mismatch(1).index, 0x6065);
}

TEST(Boot, LostAnswersAndFullQueuesAreTriedAgain) {
  BootBench bench;
  bench.drive(5).lost_answers = 2;
  bench.bus.refuse_next = 40;
  bench.run();
  EXPECT_EQ(bench.boot->state(), BootState::kOperational);
}

TEST(Boot, ADriveThatComesUpLateIsResetAgainUntilItAnswers) {
  BootBench bench;
  bench.drive(6).dead = true;
  bench.before_tick = [&](int tick) { bench.drive(6).dead = tick < 30; };
  bench.run();
  EXPECT_EQ(bench.boot->state(), BootState::kOperational);
  EXPECT_EQ(bench.resets[6], 3) << "the third is the first it hears";
  EXPECT_EQ(bench.resets[5], 1);
}

TEST(Boot, ADriveThatRestartsIsConfiguredFromTheBeginningButNotForEver) {
  BootBench bench;
  bench.drive(8).restarts = 2;
  bench.run();
  EXPECT_EQ(bench.boot->state(), BootState::kOperational);
  EXPECT_EQ(std::count(bench.drive(8).writes.begin(), bench.drive(8).writes.end(), key(0x1400, 2)), 3);
  BootBench endless;
  endless.drive(8).restarts = 1000;
  endless.run();
  EXPECT_EQ(endless.mismatch(8).failure, BootFailure::kRestarts);
}

// After the boot: reset communication, as a drive does by itself after a loss of power.
void come_back(BootBench& bench, int node) {
  const std::size_t d = static_cast<std::size_t>(node - 1);
  bench.drive(node).writes.clear();
  bench.deliver(bench.drive(node).receive(nmt_frame(kNmtResetCommunication, bench.drive(node).node)), d);
}

TEST(Boot, ADriveThatComesBackAfterTheBootIsConfiguredAgainAndTheOthersAreLeftAlone) {
  BootBench bench;
  bench.run();
  for (FakeDrive& drive : bench.drives) drive.writes.clear();
  for (int time = 0; time < 5; ++time) {  // as often as it likes
    come_back(bench, 8);
    EXPECT_EQ(bench.boot->state(), BootState::kRunning);
    bench.go_on();
    EXPECT_EQ(bench.boot->state(), BootState::kOperational);
    EXPECT_EQ(bench.drive(8).state, kStateOperational);
    EXPECT_EQ(std::count(bench.drive(8).writes.begin(), bench.drive(8).writes.end(), key(0x1400, 2)), 1);
    EXPECT_TRUE(bench.drive(7).writes.empty());
  }
  EXPECT_EQ(AllocationCount::value(), 0);
}

TEST(Boot, ADriveThatComesBackAsAnotherIsNamedAndMayComeBackAsItself) {
  BootBench bench;
  bench.run();
  const FakeDrive::Object right = bench.drive(8).objects[key(0x1018, 2)];
  bench.drive(8).objects[key(0x1018, 2)].value += 1;
  come_back(bench, 8);
  bench.go_on();
  EXPECT_EQ(bench.boot->state(), BootState::kFailed);
  EXPECT_EQ(bench.mismatch(8).index, 0x1018);
  EXPECT_NE(bench.drive(8).state, kStateOperational);
  bench.drive(8).objects[key(0x1018, 2)] = right;
  come_back(bench, 8);
  bench.go_on();
  EXPECT_EQ(bench.boot->state(), BootState::kOperational);
  EXPECT_EQ(bench.mismatch(8).failure, BootFailure::kNone);
}

TEST(Boot, ASerialNumberThatNobodyExpectsIsKept) {
  BootBench bench;
  for (DriveExpectation& drive : bench.expected) drive.serial.reset();
  bench.drive(8).objects[key(0x1018, 4)].value = 31415;
  bench.drive(9).objects.erase(key(0x1018, 4));
  bench.run();
  ASSERT_EQ(bench.boot->state(), BootState::kOperational);
  EXPECT_EQ(bench.boot->serial(6), 1007U);
  EXPECT_EQ(bench.boot->serial(7), 31415U);
  EXPECT_EQ(bench.boot->serial(8), 0U) << "it has none";
  bench.drive(8).objects[key(0x1018, 4)].value = 27182;
  come_back(bench, 8);
  bench.go_on();
  EXPECT_EQ(bench.boot->state(), BootState::kFailed) << "another drive has come back";
  EXPECT_EQ(bench.mismatch(8).expected, 31415U);
  EXPECT_EQ(bench.mismatch(8).found, 27182U);
  EXPECT_EQ(AllocationCount::value(), 0);
}

TEST(Boot, ADriveThatDoesNotStartIsReportedWithItsState) {
  BootBench bench;
  bench.drive(11).never_operational = true;
  bench.run();
  EXPECT_EQ(bench.boot->state(), BootState::kFailed);
  EXPECT_EQ(bench.mismatch(11).failure, BootFailure::kNotOperational);
  EXPECT_EQ(bench.mismatch(11).found, 0x7FU);
}

TEST(Boot, StartsThatWereLostAreSentAgain) {
  BootBench bench;
  bench.lost_starts = 20;  // the first of all 15 drives, the second of five
  bench.run();
  EXPECT_EQ(bench.boot->state(), BootState::kOperational);
  EXPECT_EQ(bench.lost_starts, 0);
}

TEST(Boot, ADriveWithoutGearOrSparePdosIsRightIfNoGearIsExpected) {
  BootBench bench;
  for (const std::uint32_t object : {key(0x6091, 1), key(0x6091, 2), key(0x1402, 1), key(0x1403, 1), key(0x1803, 1)})
    bench.drive(2).objects.erase(object);
  bench.run();
  EXPECT_EQ(bench.boot->state(), BootState::kOperational);
  BootBench geared;
  geared.expected[1].gear_motor_turns = 5;
  geared.drive(2).objects.erase(key(0x6091, 1));
  geared.run();
  EXPECT_EQ(geared.mismatch(2).failure, BootFailure::kAborted);
  EXPECT_EQ(geared.mismatch(2).index, 0x6091);
}

TEST(Boot, FramesFromTheWrongBusDoNotCount) {
  BootBench bench;
  bench.expected[0].bus = 1;  // the table says can1, the drive hangs on can0
  bench.drives[0].dead = true;
  bench.boot = std::make_unique<BootSequence>(bench.expected, kTiming);
  bench.boot->step(bench.bus);
  bench.boot->on_frame(0, bus::CanFrame{0x701, 1, {0}, 0});
  EXPECT_EQ(bench.boot->phase(0), NodePhase::kWaitBootUp);
  bench.boot->on_frame(1, bus::CanFrame{0x701, 1, {0}, 0});
  EXPECT_EQ(bench.boot->phase(0), NodePhase::kObjects);
}

}  // namespace
}  // namespace liana::canopen
