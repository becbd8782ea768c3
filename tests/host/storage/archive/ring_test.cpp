// The control-rate ring holds every tick as it came, stays within its limits, and keeps what surrounds a fault
// (req:A25).
#include "host/storage/archive/ring.hpp"

#include <signal.h>
#include <sys/wait.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "host/storage/archive/ring_files.hpp"
#include "host/storage/archive/ring_reader.hpp"
#include "tests/host/storage/archive/archive_folder.hpp"
#include "tests/host/storage/archive/ring_ticks.hpp"
#include "tests/host/storage/archive/small_disk.hpp"

namespace liana::archive {
namespace {

constexpr std::uint64_t kLife = 1;

// Hours in seconds, so that a test sees files come and go.
RingLimits quick() {
  return {.inputs_file_s = 10.0,
          .outputs_file_s = 2.0,
          .image_s = 4.0,
          .full_s = 6.0,
          .around_s = 2.0,
          .most_s = 40.0,
          .leave_bytes = 0};
}

class RingOfARun : public ArchiveFolder {
 protected:
  Ring ring(const RingLimits& limits = quick()) {
    return Ring(folder_, kLife, life(), limits, [this](const Gap& gap) { gaps_.push_back(gap); });
  }
  void feed(Ring& ring, std::uint64_t ticks) {
    for (std::uint64_t i = 0; i < ticks; ++i) {
      if (ticks_.next_tick() == 40) ring.take(ticks_.start());
      if (ticks_.next_tick() % 1000 == 0) ring.take(ticks_.image());
      ring.take(ticks_.next());
    }
  }
  // All ticks that are there, by number.
  std::map<std::uint64_t, RingTick> read(Span span = kAll) const {
    std::map<std::uint64_t, RingTick> found;
    RingVisitor visitor;
    visitor.tick = [&](const RingAbout&, const RingTick& tick) { found[tick.tick] = tick; };
    RingReader(folder_, kLife).visit(span, visitor);
    return found;
  }
  RingCheck checked() const {
    std::vector<std::string> problems;
    const RingCheck check = check_ring(folder_, kLife, problems);
    EXPECT_EQ(problems, std::vector<std::string>{});
    return check;
  }

  RingTicks ticks_;
  std::vector<Gap> gaps_;
};

TEST_F(RingOfARun, GivesEveryTickBackAsItCameByteForByte) {
  RingTicks same;
  Ring ring = this->ring();
  feed(ring, 5 * kSecond + 7);
  ring.finish();
  const auto found = read();
  ASSERT_EQ(found.size(), 5 * kSecond + 7);
  for (const auto& [tick, there] : found) {
    const std::string packet = same.next();
    const recording::TickParts parts = recording::split_tick_packet(packet);
    ASSERT_EQ(there.inputs, parts.inputs) << tick;
    ASSERT_EQ(there.outputs, parts.outputs) << tick;
  }
}

TEST_F(RingOfARun, OfOldTicksKeepsInputsAndTheOutputsAroundAFault) {
  Ring ring = this->ring();
  feed(ring, 10 * kSecond);
  const std::uint64_t fault = ticks_.next_tick();
  ring.keep_around(fault);
  feed(ring, 20 * kSecond);
  ring.finish();
  const auto found = read();
  EXPECT_EQ(found.size(), 30 * kSecond);  // Inputs of all
  std::uint64_t full = 0;
  for (const auto& [tick, there] : found) {
    const bool is_near = tick + 2 * kSecond >= fault && tick <= fault + 2 * kSecond;
    const bool is_new = tick + 6 * kSecond >= ticks_.next_tick();
    if (is_near || is_new) {
      EXPECT_FALSE(there.outputs.empty()) << "Outputs of tick " << tick << " are gone";
    }
    full += there.outputs.empty() ? 0 : 1;
  }
  EXPECT_LT(full, 20 * kSecond);  // the others went
  EXPECT_EQ(checked().full_ticks, full);
}

TEST_F(RingOfARun, StaysUnderItsBytesAndLosesTheOldestFirst) {
  RingLimits limits = quick();
  limits.bytes = 300000;
  Ring ring = this->ring(limits);
  for (int i = 0; i < 60; ++i) {
    feed(ring, kSecond);
    EXPECT_LT(RingReader(folder_, kLife).bytes(), limits.bytes + 250000) << "after " << i << " s";
  }
  ring.finish();
  const auto found = read();
  EXPECT_GT(found.begin()->first, 10 * kSecond);
  EXPECT_EQ(found.rbegin()->first, ticks_.next_tick() - 1);
  EXPECT_EQ(found.rbegin()->first - found.begin()->first + 1, found.size());  // without a gap
}

TEST_F(RingOfARun, KeepsNothingLongerThanItsTime) {
  Ring ring = this->ring();
  feed(ring, 80 * kSecond);
  ring.finish();
  const Span there = RingReader(folder_, kLife).recorded().value();
  EXPECT_GE(there.last - there.first, 40 * kSecond);
  EXPECT_LE(there.last - there.first, 60 * kSecond);
}

// Who asks again and again would never end.
TEST_F(RingOfARun, SaysThatAFileCannotBeRemoved) {
  std::filesystem::create_directories(ring_path(folder_, RingKind::kInputs, 1, 0) + "/inside");
  EXPECT_FALSE(drop_oldest_ring_file(folder_, false));
}

TEST_F(RingOfARun, CountsAndMarksTicksThatNeverCame) {
  Ring ring = this->ring();
  feed(ring, kSecond);
  const std::uint64_t first = ticks_.next_tick();
  for (int i = 0; i < 30; ++i) ticks_.next();
  feed(ring, kSecond);
  ring.finish();
  EXPECT_EQ(ring.missing(), 30u);
  ASSERT_EQ(gaps_.size(), 1u);
  EXPECT_EQ(gaps_[0].what, "ticks");
  EXPECT_EQ(gaps_[0].first_tick, first);
  EXPECT_EQ(gaps_[0].last_tick, first + 29);
  EXPECT_EQ(checked().missing, 30u);
}

TEST_F(RingOfARun, OfAKilledWriterLosesASecondAndIsGoodToRead) {
  const pid_t child = fork();
  if (child == 0) {
    Ring ring = this->ring();
    feed(ring, 25 * kSecond + 100);
    raise(SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  const RingCheck check = checked();
  EXPECT_EQ(check.ticks, 25 * kSecond);
  EXPECT_EQ(check.cut_short, 2u);
  EXPECT_EQ(check.missing, 0u);
}

TEST_F(RingOfARun, SaysWhichFileIsDamaged) {
  Ring ring = this->ring();
  feed(ring, 3 * kSecond);
  ring.finish();
  const std::string file = ring_files(folder_).back().path;
  std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
  bytes.seekp(static_cast<std::streamoff>(std::filesystem::file_size(file) / 2));
  bytes.put('\x55').put('\xAA');
  bytes.close();
  std::vector<std::string> problems;
  check_ring(folder_, kLife, problems);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_NE(problems[0].find(file), std::string::npos) << problems[0];
}

// 0 when the ring gave way to what others wrote, said so once, and went on when there was room again.
int on_a_full_disk(Ring& ring, const std::string& folder, const std::vector<Gap>& gaps,
                   const std::function<void(std::uint64_t)>& feed) {
  feed(20 * kSecond);
  std::ofstream others(folder + "/others", std::ios::binary);
  const std::string block(100000, 'x');
  while (others.write(block.data(), static_cast<std::streamsize>(block.size())).flush()) {
  }
  feed(10 * kSecond);
  if (ring.missing() != 10 * kSecond) return 2;
  if (gaps.size() != 2) return 3;  // the oldest went, then nothing could be written
  others.close();
  std::filesystem::remove(folder + "/others");
  feed(10 * kSecond);
  ring.finish();
  if (gaps.size() != 3 || gaps[2].count + gaps[1].count != ring.missing()) return 4;
  std::vector<std::string> problems;
  const RingCheck check = check_ring(folder, kLife, problems);
  if (!problems.empty()) return 5;
  return check.ticks >= 9 * kSecond ? 0 : 6;
}

TEST_F(RingOfARun, OnAFullDiskGivesWayAndGoesOnWhenThereIsRoom) {
  const int code = on_small_disk(folder_, "8m", [this] {
    RingLimits limits = quick();
    limits.leave_bytes = 1000000;
    Ring ring = this->ring(limits);
    return on_a_full_disk(ring, folder_, gaps_, [&](std::uint64_t ticks) { feed(ring, ticks); });
  });
  if (code == kNoDisk) GTEST_SKIP() << "no file system can be mounted here";
  EXPECT_EQ(code, 0);
}

}  // namespace
}  // namespace liana::archive
