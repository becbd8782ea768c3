// Any window that is cut out of the ring is a recording that replays bit by bit, also where its Outputs are gone
// (req:A25).
#include <filesystem>

#include "host/storage/archive/export.hpp"
#include "host/storage/archive/ledger.hpp"
#include "host/storage/archive/ring.hpp"
#include "host/storage/recording/replay.hpp"
#include "tests/host/storage/archive/archive_folder.hpp"
#include "tests/host/storage/archive/ring_ticks.hpp"

namespace liana::archive {
namespace {

constexpr std::uint64_t kGapBegins = 20000, kGapEnds = 20050;

// 100 s of ticks, images every 4 s of which the ring keeps every fifth, Outputs of the last 6 s, a gap of 50 ticks.
class RingExport : public ArchiveFolder {
 protected:
  RingExport() {
    Ledger ledger(folder_);
    ledger.begin(life());
    ledger.finish();
    Ring ring(folder_, 1, life(), limits(), [](const Gap&) {});
    for (ring.take(ticks_.start()); ticks_.next_tick() < 100 * kSecond;) {
      if (ticks_.next_tick() % 1000 == 0) ring.take(ticks_.image());
      const std::uint64_t tick = ticks_.next_tick();
      const std::string packet = ticks_.next();
      if (tick < kGapBegins || tick >= kGapEnds) ring.take(packet);
    }
    ring.finish();
  }
  static RingLimits limits() {
    return {.inputs_file_s = 30.0, .outputs_file_s = 2.0, .image_s = 20.0, .full_s = 6.0, .leave_bytes = 0};
  }
  TicksWritten cut(Span span) const { return write_ticks(Reader(folder_), span, cut_); }

  const std::string cut_ = folder_ + "/cut";
  RingTicks ticks_;
};

TEST_F(RingExport, AnyWindowReplaysWithoutATickThatDiffers) {
  struct Window {
    const char* about;
    Span span;
    std::uint64_t ticks, made_again, left_out;
  };
  constexpr std::uint64_t kFirst = 40;  // tick of the run
  for (const Window& window :
       {Window{"a minute ago Outputs are made again", {12345, 15432}, 3088, 3088, 0},
        Window{"the newest ticks have their own Outputs", {98 * kSecond, kAll.last}, 2 * kSecond, 0, 0},
        Window{"the begin of the run", {0, 2000}, 2001 - kFirst, 2001 - kFirst, 0},
        Window{"from the next image after a gap",
               {19000, 22000},
               kGapBegins - 19000 + 22001 - 21000,
               kGapBegins - 19000 + 22001 - 21000,
               21000 - kGapEnds}}) {
    SCOPED_TRACE(window.about);
    std::filesystem::remove_all(cut_);
    const TicksWritten written = cut(window.span);
    EXPECT_EQ(written.ticks, window.ticks);
    EXPECT_EQ(written.made_again, window.made_again);
    EXPECT_EQ(written.left_out, window.left_out);
    EXPECT_EQ(written.differing, 0u);
    const recording::ReplayResult replayed = recording::replay(cut_);
    EXPECT_EQ(replayed.ticks, written.ticks);
    EXPECT_EQ(replayed.differing_ticks, 0u);
    EXPECT_EQ(replayed.missing_ticks, 0u);
    EXPECT_TRUE(replayed.complete);
  }
}

TEST_F(RingExport, WhatIsNotThereOrWouldBeOverwrittenIsRefused) {
  EXPECT_THROW(cut({200 * kSecond, 201 * kSecond}), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(cut_));
  cut({1000, 1100});
  EXPECT_THROW(cut({1000, 1100}), std::runtime_error);
}

}  // namespace
}  // namespace liana::archive
