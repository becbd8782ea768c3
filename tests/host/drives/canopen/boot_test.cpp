// Booting the drives as docs/reference/drives.md wants it: order, every mismatch, losses, restarts, and nothing
// allocated on the way.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <set>

#include "host/drives/canopen/boot_sequence.hpp"
#include "host/drives/canopen/cob_id.hpp"
#include "host/drives/canopen/messages.hpp"
#include "tests/host/drives/bus/allocation_count.hpp"
#include "tests/host/drives/bus/fake_drive.hpp"
#include "tests/host/drives/bus/quiet_bus.hpp"
#include "tests/message.hpp"

namespace liana::canopen {
namespace {

using test::AllocationCount;
using test::expectation;
using test::FakeDrive;

// Two buses in memory: frames sent in one tick are answered before the next.
class MemoryBus final : public test::QuietBus {
 public:
  MemoryBus() : QuietBus(2) {}
  bus::SendResult send(int bus, const bus::CanFrame& frame) noexcept override {
    if (refuse_next > 0 && refuse_next-- > 0) return bus::SendResult::kQueueFull;
    sent[count++] = {bus, frame};
    return bus::SendResult::kOk;
  }

  std::array<bus::ReceivedFrame, 256> sent{};
  std::size_t count = 0;
  int refuse_next = 0;
};

constexpr BootTiming kTiming{20, 40, 100, 5, 30, 80};

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
    boot = std::make_unique<BootSequence>(expected, timing);
    AllocationCount::clear();
    return go_on();
  }
  // Further ticks, until the boot stops running.
  int go_on() {
    int tick = 0;
    for (; boot->state() == BootState::kRunning && tick < 100000; ++tick) step(tick);
    return tick;
  }
  void pass(int ticks) {
    for (int tick = 0; tick < ticks; ++tick) step(tick);
  }
  void step(int tick) {
    if (before_tick) before_tick(tick);
    bus.count = 0;
    AllocationCount::start();
    boot->step(bus);
    AllocationCount::stop();
    for (std::size_t i = 0; i < bus.count; ++i) hear(bus.sent[i]);
    for (std::size_t i = 0; i < late.size(); ++i) {
      if (--late[i].ticks > 0) continue;
      drives[late[i].drive].dead = false;
      deliver({late[i].frame}, late[i].drive);
      late.erase(late.begin() + static_cast<std::ptrdiff_t>(i--));
    }
    for (std::size_t d = 0; d < drives.size() && tick % 25 == 0; ++d) deliver(drives[d].heartbeat(), d);
  }
  void hear(const bus::ReceivedFrame& sent) {
    const bool is_reset = sent.frame.id == 0 && sent.frame.data[0] == kNmtResetCommunication;
    if (is_reset) ++resets[sent.frame.data[1]];
    if (sent.frame.id == 0 && sent.frame.data[0] == kNmtStart && lost_starts > 0 && lost_starts-- > 0) return;
    for (std::size_t d = 0; d < drives.size(); ++d) {
      if (expected[d].bus != sent.bus) continue;
      const std::vector<bus::CanFrame> answers = drives[d].receive(sent.frame);
      const int delay = answers.empty() ? 0 : is_reset ? drives[d].reset_ticks : drives[d].answer_ticks;
      if (delay == 0) deliver(answers, d);
      for (std::size_t i = 0; delay > 0 && i < answers.size(); ++i) late.push_back({delay, d, answers[i]});
      if (is_reset && delay > 0) drives[d].dead = true;  // until its boot-up message
    }
  }

  std::span<const BootMismatch> mismatches(int node) const {
    return boot->mismatches(static_cast<std::size_t>(node - 1));
  }
  // What was wrong first; nothing: no failure.
  BootMismatch mismatch(int node) const { return mismatches(node).empty() ? BootMismatch{} : mismatches(node).front(); }
  std::string text(int node) const {
    char who[32];
    std::snprintf(who, sizeof who, "node %d on can0", node);
    return describe(mismatches(node), boot->more_mismatches(static_cast<std::size_t>(node - 1)), who);
  }

  std::vector<ExpectedDrive> expected;
  std::vector<FakeDrive> drives;
  MemoryBus bus;
  std::function<void(int)> before_tick;
  std::map<int, int> resets;  // by node
  int lost_starts = 0;        // NMT starts that no drive will hear
  struct Late {
    int ticks;
    std::size_t drive;
    bus::CanFrame frame;
  };
  std::vector<Late> late;
  BootTiming timing = kTiming;
  std::unique_ptr<BootSequence> boot;
};

constexpr std::uint32_t key(std::uint32_t index, std::uint32_t sub) { return FakeDrive::key(index, sub); }

// Node 1 has two axes, node 2 one.
struct AxesBench : BootBench {
  AxesBench() {
    expected = {expectation(0, 1), expectation(0, 1), expectation(0, 2)};
    expected[1].axis = 2;
    drives.clear();
    drives.emplace_back(expected[0]);
    drives.back().add_axis();
    drives.emplace_back(expected[2]);
    drives[1].objects[key(0x1018, 4)].value = 1002;
    before_tick = [this](int) { count_requests(); };
  }
  // What was sent in the tick before.
  void count_requests() {
    int to_node_1 = 0;
    for (std::size_t i = 0; i < bus.count; ++i) {
      const bus::CanFrame& frame = bus.sent[i].frame;
      if (frame.id == 0x601) ++to_node_1;
      if (frame.id == 0x601 && frame.data[2] == 0x10 && frame.data[1] == 0x18) ++identity_reads;
      if (frame.id == 0 && frame.data[0] == kNmtStart && frame.data[1] == 1) ++starts;
    }
    most_at_once = std::max(most_at_once, to_node_1);
  }
  static constexpr std::uint32_t key(std::uint32_t index, std::uint32_t sub) { return FakeDrive::key(index, sub); }
  std::uint32_t value(std::uint32_t index, std::uint32_t sub) { return drives[0].objects.at(key(index, sub)).value; }

  int identity_reads = 0, starts = 0, most_at_once = 0;
};

TEST(Boot, TheTwoAxesOfANodeAreBootedAsOneNodeInTurn) {
  AxesBench bench;
  bench.run();
  bench.count_requests();
  ASSERT_EQ(bench.boot->state(), BootState::kOperational);
  EXPECT_EQ(bench.boot->progress().nodes, 2);
  EXPECT_EQ(bench.resets[1], 1);
  EXPECT_EQ(bench.identity_reads, 4) << "vendor, product, revision, serial number: once for both axes";
  EXPECT_EQ(bench.starts, 1);
  EXPECT_EQ(bench.most_at_once, 1);
  EXPECT_EQ(bench.value(0x1400, 1) & 0x7FF, 0x201U);
  EXPECT_EQ(bench.value(0x1800, 1) & 0x7FF, 0x181U);
  EXPECT_EQ(bench.value(0x1440, 1) & 0xBFFFFFFF, 0x401U) << "enabled";
  EXPECT_EQ(bench.value(0x1840, 1) & 0xBFFFFFFF, 0x381U);
  EXPECT_EQ(bench.value(0x1441, 1) & 0x80000000, 0x80000000U) << "not used";
  EXPECT_EQ(bench.value(0x1640, 1), 0x68400010U);
  EXPECT_EQ(bench.value(0x1640, 2), 0x687A0020U);
  EXPECT_EQ(bench.value(0x1A40, 1), 0x68410010U);
  EXPECT_EQ(bench.value(0x1A40, 3), 0x68770010U);
  EXPECT_EQ(bench.value(0x1440, 5), 12U);
  EXPECT_EQ(bench.value(0x6060, 0), 8U);
  EXPECT_EQ(bench.value(0x6860, 0), 8U);
  EXPECT_EQ(bench.value(0x6865, 0), 3476U);
  EXPECT_EQ(bench.value(0x1017, 0), 100U);
  EXPECT_EQ(bench.boot->serial(1), bench.boot->serial(0));
}

// Which process data are whose is seen by identifier alone. req:C2
TEST(Boot, NoTwoProcessDataOfABusHaveOneIdentifier) {
  std::set<std::uint32_t> ids;
  for (int node = 1; node <= 126; ++node) {
    for (std::uint8_t axis = 1; axis <= 2; ++axis) {
      ExpectedDrive drive = expectation(0, static_cast<std::uint8_t>(node));
      drive.axis = axis;
      for (const std::uint32_t id : {drive.command_id(), drive.report_id(), drive.rate_id()}) {
        EXPECT_TRUE(ids.insert(id).second) << std::hex << id;
        EXPECT_GT(id, 0x180U);
        EXPECT_LT(id, 0x580U);
      }
      EXPECT_EQ(route(drive.command_id()).kind, FrameKind::kRpdo1);
      EXPECT_EQ(route(drive.report_id()).kind, FrameKind::kTpdo1);
      EXPECT_EQ(route(drive.command_id()).axis, axis);
      EXPECT_EQ(route(drive.report_id()).axis, axis);
    }
  }
}

TEST(Boot, WhatAxis2RefusesIsNamedWithItsOwnObjectsAndNothingIsStarted) {
  const auto refused = [](const std::function<void(FakeDrive&)>& spoil) {
    AxesBench bench;
    spoil(bench.drives[0]);
    bench.run();
    EXPECT_EQ(bench.boot->state(), BootState::kFailed);
    EXPECT_EQ(bench.starts, 0);
    EXPECT_EQ(bench.boot->mismatches(1).size(), 1U);
    return bench.boot->mismatches(1).front();
  };
  constexpr auto at = [](std::uint32_t index) { return FakeDrive::key(index, 0); };
  BootMismatch mismatch = refused([&](FakeDrive& drive) { drive.aborts[at(0x6D02)] = 0x06020000; });
  EXPECT_EQ(mismatch.failure, BootFailure::kAborted);
  EXPECT_EQ(mismatch.axis, 2);
  EXPECT_EQ(mismatch.index, 0x6D02);
  EXPECT_EQ(mismatch.abort_code, 0x06020000U);
  mismatch = refused([&](FakeDrive& drive) { drive.objects[at(0x6861)] = {1, 3}; });
  EXPECT_EQ(mismatch.failure, BootFailure::kValue);
  EXPECT_EQ(mismatch.axis, 2);
  EXPECT_EQ(mismatch.index, 0x6861);
  EXPECT_EQ(mismatch.found, 3U);
  mismatch = refused([&](FakeDrive& drive) { drive.aborts[at(0x6502)] = 0x06020000; });
  EXPECT_EQ(mismatch.axis, 1);
  mismatch = refused([&](FakeDrive& drive) { drive.dead = true; });
  EXPECT_EQ(mismatch.failure, BootFailure::kNoBootUp);
  EXPECT_EQ(mismatch.axis, 0) << "the whole node";
}

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
  EXPECT_EQ(value(0x1400, 1), 0x40000203U) << "bit 30 is the drive's own";
  EXPECT_EQ(value(0x1400, 2), 1U);
  EXPECT_EQ(value(0x1400, 5), 12U);
  EXPECT_EQ(value(0x1600, 0), 2U);
  EXPECT_EQ(value(0x1600, 1), 0x60400010U);
  EXPECT_EQ(value(0x1600, 2), 0x607A0020U);
  EXPECT_EQ(value(0x1800, 1), 0x40000183U);
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
    const BootMismatch mismatch = bench.mismatch(7);
    EXPECT_EQ(mismatch.failure, BootFailure::kValue);
    EXPECT_EQ(mismatch.node, 7);
    EXPECT_EQ(mismatch.index, index);
    EXPECT_EQ(mismatch.sub, sub);
    EXPECT_TRUE(mismatch.expected != mismatch.found || mismatch.expected_before != mismatch.found_before);
    EXPECT_EQ(bench.boot->progress().failed, 1);
    for (const FakeDrive& drive : bench.drives)
      EXPECT_NE(drive.state, 0x05) << "one failing drive keeps all from starting";
  }
}

TEST(Boot, TheMessageOfAMismatchSaysAllOfIt) {
  BootBench bench;
  bench.drive(7).objects[key(0x1018, 2)].value = 9;
  bench.run();
  EXPECT_TRUE(names(bench.text(7), {"node 7", "can0", "0x1018:2", "product code", "1", "9"}));
}

TEST(Boot, EveryWriteThatDoesNotStickIsFound) {
  BootBench reference;
  reference.run();
  std::set<std::uint32_t> written(reference.drive(2).writes.begin(), reference.drive(2).writes.end());
  written.erase(key(0x1600, 0));  // its first value, 0, is what it had
  written.erase(key(0x1A00, 0));
  written.erase(key(0x1400, 2));  // any type of an RPDO will do
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
  EXPECT_TRUE(names(bench.text(2), {"0x6072:0", "max torque", "1000", "0x06090031"}));
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
  EXPECT_TRUE(names(bench.text(9), {"boot-up"}));
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

constexpr double kRates_hz[] = {200.0, 250.0, 500.0};

int ticks_in(double seconds, double rate_hz) { return static_cast<int>(seconds * rate_hz); }

TEST(Boot, PatienceIsTheSameInSecondsAtEveryRate) {
  for (const double rate_hz : kRates_hz) {
    const BootTiming timing = boot_timing(rate_hz);
    EXPECT_EQ(timing.reset_ticks, 1.0 * rate_hz);
    EXPECT_EQ(timing.max_reset_ticks, 4.0 * rate_hz);
    EXPECT_EQ(timing.boot_up_ticks, 10.0 * rate_hz);
    EXPECT_EQ(timing.sdo_ticks, 1.0 * rate_hz);
    EXPECT_EQ(timing.start_ticks, std::ceil(0.25 * rate_hz));
    EXPECT_EQ(timing.operational_ticks, 2.0 * rate_hz);
  }
}

TEST(Boot, ADriveWhoseResetTakesUpToFourSecondsComesUp) {
  for (const double rate_hz : kRates_hz) {
    for (const double reset_s : {0.3, 0.6, 1.1, 2.5, 3.9}) {
      BootBench bench;
      bench.timing = boot_timing(rate_hz);
      bench.drive(6).reset_ticks = ticks_in(reset_s, rate_hz);
      const int ticks = bench.run();
      EXPECT_EQ(bench.boot->state(), BootState::kOperational) << reset_s << " s at " << rate_hz << " Hz";
      EXPECT_LT(ticks, 10.0 * rate_hz);
    }
  }
}

TEST(Boot, AnswersThatTakeUpToASecondAreWaitedFor) {
  for (const double rate_hz : kRates_hz) {
    for (const double answer_s : {0.32, 0.8}) {
      BootBench bench;
      bench.timing = boot_timing(rate_hz);
      bench.drive(6).answer_ticks = ticks_in(answer_s, rate_hz);
      bench.run();
      EXPECT_EQ(bench.boot->state(), BootState::kOperational)
          << answer_s << " s at " << rate_hz << " Hz: " << bench.text(6);
    }
  }
}

TEST(Boot, AnswersThatAlwaysComeTooLateEndItWithTheObject) {
  BootBench bench;
  bench.drive(6).answer_ticks = 200;
  EXPECT_LT(bench.run(), 1000);
  EXPECT_EQ(bench.boot->state(), BootState::kFailed);
  EXPECT_EQ(bench.mismatch(6).failure, BootFailure::kNoAnswer);
  EXPECT_EQ(bench.mismatch(6).index, 0x1000);
}

TEST(Boot, AnotherToolsTransfersWithASilentDriveDoNotKeepItRunning) {
  BootBench bench;
  bench.drive(6).deaf_from = key(0x1000, 0);
  bench.before_tick = [&](int) { bench.boot->on_frame(0, {0x586, 8, {0x00, 1, 2, 3, 4, 5, 6, 7}, 0}); };
  EXPECT_LT(bench.run(), 1000);
  EXPECT_EQ(bench.mismatch(6).failure, BootFailure::kNoAnswer);
}

TEST(Boot, ADriveThatGetsItsPowerAfterItWasCalledMissingIsBootedWhenItsBootUpMessageComes) {
  for (const double rate_hz : kRates_hz) {
    BootBench bench;
    bench.timing = boot_timing(rate_hz);
    bench.drive(6).dead = true;
    bench.run();
    ASSERT_EQ(bench.boot->state(), BootState::kFailed);
    EXPECT_EQ(bench.mismatch(6).failure, BootFailure::kNoBootUp);
    bench.pass(ticks_in(2.0, rate_hz));
    bench.drive(6).dead = false;
    bench.deliver({{0x706, 1, {0}, 0}}, 5);
    EXPECT_EQ(bench.boot->state(), BootState::kRunning);
    bench.go_on();
    EXPECT_EQ(bench.boot->state(), BootState::kOperational);
    EXPECT_TRUE(bench.mismatches(6).empty());
    EXPECT_EQ(bench.resets[5], 1) << "the others are left alone";
  }
}

TEST(Boot, ADriveThatComesWithItsCableAndWithoutAWordIsResetAndBooted) {
  BootBench bench;
  bench.timing = boot_timing(250.0);
  bench.drive(6).dead = true;
  bench.run();
  ASSERT_EQ(bench.boot->state(), BootState::kFailed);
  bench.pass(3000);
  bench.drive(6).dead = false;
  bench.pass(1001);
  bench.go_on();
  EXPECT_EQ(bench.boot->state(), BootState::kOperational);
}

TEST(Boot, EverythingThatADriveRefusesIsToldAtOnceAndOfEveryDrive) {
  BootBench bench;
  bench.drive(2).aborts[key(0x6060, 0)] = 0x06020000;
  bench.drive(2).aborts[key(0x6007, 0)] = 0x06010002;
  bench.drive(2).objects[key(0x6076, 0)].value = 5;
  bench.drive(9).stubborn.insert(key(0x605A, 0));
  bench.run();
  ASSERT_EQ(bench.mismatches(2).size(), 3U);
  EXPECT_EQ(bench.mismatches(2)[0].index, 0x6076);
  EXPECT_EQ(bench.mismatches(2)[1].index, 0x6060);
  EXPECT_EQ(bench.mismatches(2)[2].index, 0x6007);
  EXPECT_EQ(bench.mismatches(9).size(), 1U);
  const std::string text = bench.text(2);
  for (const char* said : {"node 2 on can0", "0x6076:0", "0x6060:0", "0x6007:0", "0x06010002"})
    EXPECT_NE(text.find(said), std::string::npos) << text;
}

TEST(Boot, ADriveThatRefusesMoreThanAnybodyReadsIsToldInPartAndCounted) {
  BootBench bench;
  for (std::uint32_t pdo = 1; pdo < 32; ++pdo) {  // of both directions; each may be there, or else be disabled
    bench.drive(2).aborts[key(0x1400 + pdo, 1)] = 0x08000022;
    bench.drive(2).aborts[key(0x1800 + pdo, 1)] = 0x08000022;
  }
  bench.run();
  EXPECT_EQ(bench.mismatches(2).size(), kMaxMismatches);
  EXPECT_EQ(bench.boot->more_mismatches(1), 2 * 31 - kMaxMismatches);
  EXPECT_NE(bench.text(2).find("; and " + std::to_string(bench.boot->more_mismatches(1)) + " more"), std::string::npos);
  EXPECT_EQ(AllocationCount::value(), 0);
}

TEST(Boot, AnotherDriveThanExpectedIsReadAndNotWritten) {
  BootBench bench;
  bench.drive(2).objects[key(0x1018, 1)].value = 9;
  bench.drive(2).objects[key(0x6076, 0)].value = 5;
  bench.run();
  EXPECT_EQ(bench.mismatches(2).size(), 2U);
  EXPECT_TRUE(bench.drive(2).writes.empty());
}

void recover(BootBench& bench, int node, NodeSeen seen) {
  bench.resets.clear();
  for (FakeDrive& drive : bench.drives) drive.writes.clear();
  bench.boot->recover(static_cast<std::size_t>(node - 1), seen);
}

TEST(Boot, ADriveThatFellBackToPreOperationalIsConfiguredAndStartedWithoutAReset) {
  BootBench bench;
  bench.run();
  bench.drive(8).state = kStatePreOperational;
  recover(bench, 8, NodeSeen::kPreOperational);
  EXPECT_EQ(bench.boot->state(), BootState::kRunning);
  bench.go_on();
  EXPECT_EQ(bench.boot->state(), BootState::kOperational);
  EXPECT_EQ(bench.drive(8).state, kStateOperational);
  EXPECT_FALSE(bench.drive(8).writes.empty()) << "it may have restarted unheard: all is written and compared again";
  EXPECT_TRUE(bench.drive(7).writes.empty());
  EXPECT_TRUE(bench.resets.empty());
}

TEST(Boot, ADriveThatWasLostIsResetAndBootedAlone) {
  BootBench bench;
  bench.run();
  bench.drive(8).state = kStateStopped;
  recover(bench, 8, NodeSeen::kLost);
  bench.go_on();
  EXPECT_EQ(bench.boot->state(), BootState::kOperational);
  EXPECT_EQ(bench.resets, (std::map<int, int>{{8, 1}}));
}

TEST(Boot, ADriveThatIsWellIsLeftAlone) {
  BootBench bench;
  bench.run();
  recover(bench, 8, NodeSeen::kWell);
  EXPECT_EQ(bench.boot->state(), BootState::kOperational);
}

TEST(Boot, ADriveThatRefusedIsAskedAgainWhenSomebodyWantsIt) {
  BootBench bench;
  bench.drive(8).aborts[key(0x6072, 0)] = 0x06090031;
  bench.run();
  ASSERT_EQ(bench.boot->state(), BootState::kFailed);
  bench.pass(2000);
  EXPECT_EQ(bench.resets[8], 1) << "nobody asks it by himself";
  bench.drive(8).aborts.clear();
  recover(bench, 8, NodeSeen::kLost);
  bench.go_on();
  EXPECT_EQ(bench.boot->state(), BootState::kOperational);
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
  endless.deliver({{0x708, 1, {0}, 0}}, 7);
  EXPECT_EQ(endless.boot->state(), BootState::kFailed) << "a further restart does not begin it all again";
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
  for (ExpectedDrive& drive : bench.expected) drive.serial.reset();
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

// field-notes D1: what CiA 402 leaves to the maker, and 1400:5, which most drives do not have.
TEST(Boot, ADriveMayLackWhatTheProfileLeavesToItsMaker) {
  for (const std::uint32_t object : {key(0x1400, 5), key(0x6007, 0), key(0x605A, 0), key(0x605E, 0), key(0x6065, 0),
                                     key(0x6066, 0), key(0x6072, 0), key(0x6076, 0), key(0x608F, 1), key(0x608F, 2)}) {
    BootBench bench;
    bench.drive(2).objects.erase(object);
    bench.run();
    EXPECT_EQ(bench.boot->state(), BootState::kOperational) << std::hex << object << ": " << bench.text(2);
  }
}

TEST(Boot, WhatATypeRequiresMustBeThere) {
  BootBench bench;
  bench.expected[1].type.objects[{0x6072, 0}] = {config::Presence::kRequired, {}};
  bench.drive(2).objects.erase(key(0x6072, 0));
  bench.run();
  ASSERT_EQ(bench.mismatches(2).size(), 1U);
  EXPECT_EQ(bench.mismatch(2).index, 0x6072);
}

TEST(Boot, AReadOnlyObjectThatHasTheValueAlreadyIsRight) {
  BootBench bench;
  FakeDrive& drive = bench.drive(3);
  drive.objects[key(0x6066, 0)].value = 100;
  drive.objects[key(0x60C2, 2)].value = 0xFD;
  drive.read_only = {key(0x6066, 0), key(0x60C2, 2)};
  bench.run();
  EXPECT_EQ(bench.boot->state(), BootState::kOperational) << bench.text(3);
  BootBench other;
  other.drive(3).read_only = {key(0x6066, 0)};
  other.run();
  ASSERT_EQ(other.mismatches(3).size(), 1U);
  EXPECT_TRUE(names(other.text(3), {"100", "0x06010002"}));
  EXPECT_TRUE(names(other.text(3), {"0", "0x0"}));
}

TEST(Boot, WhatATypeFixesIsReadAndNeverWritten) {
  BootBench bench;
  bench.expected[2].type.objects[{0x6066, 0}] = {config::Presence::kFixed, 7};
  bench.drive(3).objects[key(0x6066, 0)].value = 7;
  bench.run();
  EXPECT_EQ(bench.boot->state(), BootState::kOperational) << bench.text(3);
  EXPECT_EQ(std::count(bench.drive(3).writes.begin(), bench.drive(3).writes.end(), key(0x6066, 0)), 0);
}

TEST(Boot, EverythingThatADriveRefusesIsNamedAtOnce) {
  BootBench bench;
  FakeDrive& drive = bench.drive(7);
  drive.objects[key(0x6076, 0)].value = 1;
  drive.read_only = {key(0x1600, 1), key(0x6060, 0), key(0x1017, 0)};
  drive.objects.erase(key(0x60C2, 1));
  bench.run();
  std::vector<std::uint32_t> named;
  for (const BootMismatch& mismatch : bench.mismatches(7)) named.push_back(key(mismatch.index, mismatch.sub));
  const std::vector<std::uint32_t> expected{key(0x6076, 0), key(0x1600, 1), key(0x6060, 0), key(0x60C2, 1),
                                            key(0x1017, 0)};
  EXPECT_EQ(named, expected) << bench.text(7);
  for (const char* object : {"0x6076:0", "0x1600:1", "0x6060:0", "0x60C2:1", "0x1017:0"})
    EXPECT_NE(bench.text(7).find(object), std::string::npos) << bench.text(7);
}

TEST(Boot, NothingIsWrittenToADriveThatIsAnother) {
  BootBench bench;
  bench.drive(4).objects[key(0x1018, 2)].value = 77;
  bench.drive(4).objects.erase(key(0x6060, 0));
  bench.run();
  EXPECT_TRUE(bench.drive(4).writes.empty());
  ASSERT_EQ(bench.mismatches(4).size(), 2U) << bench.text(4);
  EXPECT_EQ(bench.mismatches(4)[1].index, 0x6060) << "what it lacks is said all the same";
}

// 6061 is the mode that the drive is in; some take their time to show it.
TEST(Boot, ADriveThatTakesAModeAndStaysInAnotherIsRefusedByName) {
  BootBench bench;
  bench.drive(1).objects[key(0x6061, 0)] = {1, 1};
  bench.drive(15).objects[key(0x6061, 0)] = {1, 0};
  bench.drive(8).objects[key(0x6061, 0)] = {1, 1};
  bench.drive(8).mode_reads = 125;
  bench.run();
  for (const auto& [node, shown] : {std::pair{1, 1U}, std::pair{15, 0U}}) {
    ASSERT_EQ(bench.mismatches(node).size(), 1U) << bench.text(node);
    EXPECT_EQ(bench.mismatch(node).index, 0x6061);
    EXPECT_EQ(bench.mismatch(node).expected, 8U);
    EXPECT_EQ(bench.mismatch(node).found, shown);
  }
  EXPECT_TRUE(bench.mismatches(8).empty()) << bench.text(8);
  BootBench later;
  later.drive(8).objects[key(0x6061, 0)] = {1, 1};
  later.drive(8).mode_reads = 126;
  later.run();
  EXPECT_EQ(later.mismatch(8).index, 0x6061);
}

TEST(Boot, WhereTheModeCannotBeWrittenOnlyThatIsNamed) {
  BootBench bench;
  bench.drive(4).objects[key(0x6061, 0)] = {1, 1};
  bench.drive(4).read_only = {key(0x6060, 0)};
  bench.run();
  ASSERT_EQ(bench.mismatches(4).size(), 1U) << bench.text(4);
  EXPECT_EQ(bench.mismatch(4).index, 0x6060);
}

TEST(Boot, AnswersAndHeartbeatsOfAnotherLengthAreNamedAsSuch) {
  for (const std::uint8_t bytes : {std::uint8_t{7}, std::uint8_t{4}, std::uint8_t{3}, std::uint8_t{0}}) {
    BootBench bench;
    bench.drive(2).answer_bytes = bytes;
    bench.run();
    EXPECT_EQ(bench.mismatch(2).failure, BootFailure::kNoAnswer);
    EXPECT_EQ(bench.mismatch(2).odd_length, bytes) << bench.text(2);
  }
  for (const std::uint8_t bytes : {std::uint8_t{0}, std::uint8_t{2}, std::uint8_t{8}}) {
    BootBench bench;
    bench.drive(2).heartbeat_bytes = bytes;
    bench.run();
    EXPECT_EQ(bench.mismatch(2).failure, BootFailure::kNotOperational);
    EXPECT_EQ(bench.mismatch(2).odd_length, bytes) << bench.text(2);
  }
  BootBench silent;
  silent.drive(2).deaf_from = key(0x6076, 0);
  silent.run();
  EXPECT_EQ(silent.mismatch(2).odd_length, std::nullopt);
}

TEST(Boot, AValueIsToldWholeAlsoWhereOnlySomeOfItsBitsAreCompared) {
  BootBench bench;
  bench.drive(2).objects[key(0x1000, 0)].value = 0x00020191;
  bench.drive(3).objects[key(0x607E, 0)] = {1, 0xA1};
  bench.run();
  EXPECT_EQ(bench.mismatch(2).found, 0x00020191U);
  EXPECT_EQ(bench.mismatch(2).mask, 0xFFFFU);
  EXPECT_TRUE(names(bench.text(2), {"0x20191", "0x192", "0xFFFF"}));
  EXPECT_EQ(bench.mismatch(3).found, 0xA1U);
  EXPECT_TRUE(names(bench.text(3), {"161", "0xA1"}));
}

// field-notes D7: what decides direction, scale and stopping distance is read.
TEST(Boot, DirectionScaleLimitsAndStoppingAreReadAndRefusedByName) {
  struct Case {
    std::uint32_t object;
    std::uint32_t value;
    std::uint8_t blamed_sub;
    Facts facts;
  };
  const Case cases[] = {{key(0x607E, 0), 0x80, 0, {"polarity"}},
                        {key(0x6092, 1), 60000, 1, {"65536", "1", "60000"}},
                        {key(0x607D, 1), 0xFFFFFC19, 1, {"-1000", "2000", "-999"}},
                        {key(0x607D, 2), 1999, 2, {"-1000", "2000", "-2000", "1999"}},
                        {key(0x607F, 0), 9999, 0, {"10000", "9999"}},
                        {key(0x6080, 0), 9, 0, {"max motor speed"}},
                        {key(0x60C5, 0), 99999, 0, {"max acceleration"}},
                        {key(0x6085, 0), 99999, 0, {"quick stop deceleration", "100000", "99999"}}};
  const auto fill = [](BootBench& bench) {
    bench.expected[5].demand = {-1000, 2000, 10000};
    const std::pair<std::uint32_t, std::uint32_t> good[] = {
        {key(0x60A8, 0), 0x00B50000}, {key(0x6092, 1), 131072}, {key(0x6092, 2), 2},     {key(0x607D, 1), 0xFFFFF830},
        {key(0x607D, 2), 2000},       {key(0x607E, 0), 0},      {key(0x607F, 0), 10000}, {key(0x6080, 0), 10},
        {key(0x60C5, 0), 100000},     {key(0x6085, 0), 100000}};
    for (const auto& [object, value] : good) bench.drive(6).objects[object] = {4, value};
  };
  BootBench well;
  fill(well);
  well.run();
  EXPECT_EQ(well.boot->state(), BootState::kOperational) << well.text(6);
  for (const Case& each : cases) {
    BootBench bench;
    fill(bench);
    if (each.object == key(0x6092, 1)) bench.drive(6).objects[key(0x6092, 2)].value = 1;
    bench.drive(6).objects[each.object].value = each.value;
    bench.run();
    ASSERT_EQ(bench.mismatches(6).size(), 1U) << std::hex << each.object << bench.text(6);
    EXPECT_EQ(key(bench.mismatch(6).index, 0), each.object & 0xFFFF00);
    EXPECT_EQ(bench.mismatch(6).sub, each.blamed_sub) << std::hex << each.object;
    EXPECT_TRUE(names(bench.text(6), each.facts));
  }
}

TEST(Boot, PositionLimitsOfZeroAreNone) {
  BootBench bench;
  bench.expected[5].demand = {-1000, 2000, 10000};
  bench.drive(6).objects[key(0x607D, 1)] = {4, 0};
  bench.drive(6).objects[key(0x607D, 2)] = {4, 0};
  bench.run();
  EXPECT_EQ(bench.boot->state(), BootState::kOperational) << bench.text(6);
}

TEST(Boot, TheUnitOfPositionsIsSetOrTheDriveIsRefused) {
  BootBench bench;
  bench.drive(6).objects[key(0x60A8, 0)] = {4, 0xFF410000};  // tenths of a degree
  bench.run();
  EXPECT_EQ(bench.boot->state(), BootState::kOperational);
  EXPECT_EQ(bench.drive(6).objects[key(0x60A8, 0)].value, 0x00B50000U);
  BootBench stuck;
  stuck.drive(6).objects[key(0x60A8, 0)] = {4, 0xFF410000};
  stuck.drive(6).read_only = {key(0x60A8, 0)};
  stuck.run();
  EXPECT_EQ(stuck.mismatch(6).index, 0x60A8);
  EXPECT_TRUE(names(stuck.text(6), {"unit", "0x60A8:0"}));
}

TEST(Boot, EveryPdoThatIsNotUsedIsDisabledWhateverItsCobId) {
  BootBench bench;
  for (std::uint32_t pdo = 4; pdo < 12; ++pdo) bench.drive(6).objects[key(0x1800 + pdo, 1)] = {4, 0x40000480U + pdo};
  bench.run();
  ASSERT_EQ(bench.boot->state(), BootState::kOperational) << bench.text(6);
  for (std::uint32_t pdo = 4; pdo < 12; ++pdo)
    EXPECT_EQ(bench.drive(6).objects[key(0x1800 + pdo, 1)].value, 0xC0000480U + pdo) << "only bit 31 changes";
  EXPECT_EQ(bench.drive(5).objects[key(0x1402, 1)].value, 0xC0000405U);
}

TEST(Boot, ADriveThatInsistsOnItsTransmissionTypeForTargetsIsRight) {
  BootBench bench;
  bench.drive(6).read_only = {key(0x1400, 2)};  // 255: targets act at once
  bench.run();
  EXPECT_EQ(bench.boot->state(), BootState::kOperational) << bench.text(6);
  BootBench reports;
  reports.drive(6).read_only = {key(0x1800, 2)};  // 255: nobody knows when it reports
  reports.run();
  EXPECT_EQ(reports.mismatch(6).index, 0x1800);
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
