// `liana drive check` against drives of the bench: by reading it finds what no write is needed for and changes nothing;
// by trial it says what a boot says, and leaves the drive as it was.
#include "host/drives/commissioning/boot_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "host/drives/commissioning/jog_run.hpp"
#include "tests/drives/drive_channel.hpp"
#include "tests/message.hpp"

namespace liana {
namespace {

// One drive of the bench, or both axes of one, on a bus of its own: what is sent in one tick is answered in the next.
class DriveOnDesk final : public test::QuietBus {
 public:
  DriveOnDesk(std::vector<bench::Drive*> axes, int& writes) : QuietBus(1), axes_(std::move(axes)), writes_(writes) {}
  bus::SendResult send(int, const bus::CanFrame& frame) noexcept override {
    const bool is_write = frame.id > 0x600 && frame.id < 0x680 && (frame.data[0] >> 5) == 1;
    if (is_write) ++writes_;
    sent_.push_back(frame);
    return bus::SendResult::kOk;
  }
  bool receive(bus::ReceivedFrame& received) noexcept override {
    if (heard_.empty()) return false;
    received = heard_.front();
    heard_.pop_front();
    return true;
  }
  void end_tick() noexcept override {
    now_us_ += 4000;
    bench::FrameList out;
    for (const bus::CanFrame& frame : sent_) {
      bench::CanFrame there;
      there.time_us = now_us_;
      there.id = frame.id;
      there.length = frame.length;
      std::copy_n(frame.data.begin(), frame.length, there.data.begin());
      for (bench::Drive* axis : axes_) axis->receive(there, out);
    }
    sent_.clear();
    for (bench::Drive* axis : axes_) {
      axis->tick(now_us_, out);
      for (int i = 0; i < 4; ++i) axis->move(0.001, 50.0);
    }
    for (const bench::CanFrame& frame : out) {
      bus::CanFrame here{frame.id, frame.length, {}, 0};
      std::copy_n(frame.data.begin(), frame.length, here.data.begin());
      heard_.push_back({0, here});
    }
  }

 private:
  std::vector<bench::Drive*> axes_;
  int& writes_;
  std::uint64_t now_us_ = 0;
  std::deque<bus::CanFrame> sent_;
  std::deque<bus::ReceivedFrame> heard_;
};

struct Checked {
  explicit Checked(const bench::DictionaryConfig& dictionary)
      : drive(settings(dictionary), 1000.0),
        desk(std::make_unique<DriveOnDesk>(std::vector{&drive}, writes), 250.0, never) {}

  static bench::DriveSettings settings(const bench::DictionaryConfig& dictionary) {
    bench::DriveSettings out;
    out.vendor = 0x4C49;
    out.product = out.revision = out.serial = 1;
    out.dictionary = dictionary;
    return out;
  }
  std::uint32_t value(std::uint16_t index, std::uint8_t sub = 0) { return desk.read({0, 1}, index, sub).value(); }

  int writes = 0;
  std::atomic<bool> never = false;
  bench::Drive drive;
  commissioning::Desk desk;
};

std::string all_of(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

TEST(BootCheck, AGoodDriveWouldBootAndReadingWritesNothing) {
  Checked checked({});
  const commissioning::BootCheck read = commissioning::check_by_reading(checked.desk, test::expectation());
  EXPECT_TRUE(read.would_boot()) << all_of(read.more);
  EXPECT_TRUE(read.is_watched);
  EXPECT_EQ(checked.writes, 0);
}

TEST(BootCheck, ATrialSaysWhatABootSaysAndPutsBackWhatItWrote) {
  Checked checked({});
  checked.desk.look_at_boot(test::expectation());
  const std::pair<std::uint16_t, std::uint8_t> objects[] = {{0x6065, 0}, {0x60C2, 1}, {0x6072, 0}, {0x1017, 0},
                                                            {0x1600, 0}, {0x1A00, 0}, {0x1400, 5}};
  std::vector<std::uint32_t> before, after;
  for (const auto& [index, sub] : objects) before.push_back(checked.value(index, sub));
  ASSERT_NE(before[0], test::expectation().following_window_counts) << "the trial has to have something to put back";
  const commissioning::BootCheck tried = commissioning::check_by_trial(checked.desk, test::expectation());
  EXPECT_TRUE(tried.would_boot()) << all_of(tried.more);
  EXPECT_EQ(tried.node->phase(), canopen::NodePhase::kOperational);
  EXPECT_GT(checked.writes, 0);
  EXPECT_TRUE(tried.not_restored.empty()) << all_of(tried.not_restored);
  for (const auto& [index, sub] : objects) after.push_back(checked.value(index, sub));
  EXPECT_EQ(after, before);
  EXPECT_EQ(checked.drive.nmt_state(), bench::NmtState::kPreOperational);
  EXPECT_EQ(checked.drive.power_state(), bench::PowerState::kSwitchOnDisabled);
}

// The kind of `stepper.eds`: csp, and no value of torque.
TEST(BootCheck, AnObjectThatIsMappedAndNotThereIsFoundByReading) {
  for (const auto& [index, entry] :
       {std::pair{std::uint16_t{0x6077}, "1A00:3"}, std::pair{std::uint16_t{0x6064}, "1A00:2"},
        std::pair{std::uint16_t{0x607A}, "1600:2"}}) {
    bench::DictionaryConfig dictionary;
    dictionary.absent.push_back({index, {}});
    Checked checked(dictionary);
    const commissioning::BootCheck read = commissioning::check_by_reading(checked.desk, test::expectation());
    EXPECT_FALSE(read.would_boot());
    ASSERT_EQ(read.more.size(), 1U) << all_of(read.more);
    EXPECT_TRUE(names(read.more[0], {config::object_name({index, 0}), "0x06020000", entry})) << read.more[0];
    EXPECT_FALSE(commissioning::check_by_trial(checked.desk, test::expectation()).would_boot());
  }
}

TEST(BootCheck, AnObjectOfAnotherSizeIsFoundByReading) {
  // The bench's objects have their right size: what is asked for is made another.
  Checked checked({});
  canopen::ExpectedDrive drive = test::expectation();
  drive.type.writes = {{{0x6066, 0}, "a window of time", 4, 100, true}};
  const commissioning::BootCheck read = commissioning::check_by_reading(checked.desk, drive);
  ASSERT_EQ(read.more.size(), 1U) << all_of(read.more);
  EXPECT_TRUE(names(read.more[0], {"6066", "16 bits", "32 bits"})) << read.more[0];
}

// Only a write shows it: reading says that it has not tried, a trial names it as the boot does.
TEST(BootCheck, WhatCannotBeWrittenIsFoundByATrial) {
  const std::pair<std::uint16_t, std::uint8_t> objects[] = {{0x1A00, 3}, {0x1600, 1}, {0x6060, 0}, {0x1017, 0}};
  for (const auto& [index, sub] : objects) {
    bench::DictionaryConfig dictionary;
    dictionary.read_only.push_back({index, sub});
    Checked checked(dictionary);
    EXPECT_TRUE(commissioning::check_by_reading(checked.desk, test::expectation()).would_boot());
    const commissioning::BootCheck tried = commissioning::check_by_trial(checked.desk, test::expectation());
    ASSERT_FALSE(tried.node->mismatches().empty()) << std::hex << index;
    EXPECT_EQ(tried.node->mismatches()[0].index, index);
    EXPECT_EQ(tried.node->mismatches()[0].sub, sub);
  }
}

TEST(BootCheck, WithoutModeDisplayTheModeIsNotWatched) {
  bench::DictionaryConfig dictionary;
  dictionary.absent.push_back({0x6061, {}});
  Checked checked(dictionary);
  const commissioning::BootCheck read = commissioning::check_by_reading(checked.desk, test::expectation());
  EXPECT_TRUE(read.would_boot());
  EXPECT_FALSE(read.is_watched);
}

// Node 1 with two axes on a desk, the second of which is meant.
class SecondAxis : public ::testing::Test {
 protected:
  SecondAxis() : desk_(std::make_unique<DriveOnDesk>(std::vector{&first_, &second_}, writes_), 250.0, never_) {}

  static bench::DriveSettings settings(int axis) {
    bench::DriveSettings out = Checked::settings({});
    out.axis = axis;
    out.axes = 2;
    return out;
  }
  static canopen::ExpectedDrive expected() {
    canopen::ExpectedDrive drive = test::expectation();
    drive.axis = 2;
    drive.rpdo_deadline_ms = 100;
    return drive;
  }

  int writes_ = 0;
  std::atomic<bool> never_ = false;
  bench::Drive first_{settings(1), 1000.0}, second_{settings(2), 2000.0};
  commissioning::Desk desk_;
};

TEST_F(SecondAxis, IsCheckedByReadingAndByTrial) {
  EXPECT_TRUE(commissioning::check_by_reading(desk_, expected()).would_boot());
  EXPECT_EQ(writes_, 0);
  const commissioning::BootCheck tried = commissioning::check_by_trial(desk_, expected());
  EXPECT_TRUE(tried.would_boot()) << all_of(tried.more);
  EXPECT_TRUE(tried.is_watched);
  EXPECT_TRUE(tried.not_restored.empty()) << all_of(tried.not_restored);
}

TEST_F(SecondAxis, IsJoggedAloneAndEndsDisabled) {
  commissioning::JogRun run(desk_, expected());
  ASSERT_EQ(run.boot().phase(), canopen::NodePhase::kOperational);
  commissioning::JogRequest request;
  request.by_counts = 6000.0;
  request.counts_per_s = 8000.0;
  request.window_counts = 1500.0;
  request.settled_counts = 20.0;
  const commissioning::JogOutcome outcome = run.jog(request, [](const commissioning::JogSample&) {});
  EXPECT_EQ(outcome.end, commissioning::JogResult::kArrived);
  EXPECT_TRUE(outcome.is_off);
  EXPECT_NEAR(second_.motor().position_counts(), 8000.0, 20.0);
  EXPECT_EQ(first_.motor().position_counts(), 1000.0);
  EXPECT_EQ(first_.motor().mode(), bench::MotorMode::kBraked);
}

}  // namespace
}  // namespace liana
