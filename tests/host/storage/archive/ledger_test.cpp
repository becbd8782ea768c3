// What archive.db keeps of a life that goes on and on.
#include "host/storage/archive/ledger.hpp"

#include "host/base/json/json.hpp"
#include "host/storage/archive/check.hpp"
#include "host/storage/archive/reader.hpp"
#include "tests/host/storage/archive/archive_folder.hpp"

namespace liana::archive {
namespace {

constexpr LedgerLimits kSmall{.first_events = 10, .newest_events = 50, .commands = 40, .gaps = 5, .at_once = 3};

class LongLife : public ArchiveFolder {
 protected:
  // Events and commands 1 to `count`, and a gap of each, committed one by one.
  void live(std::uint64_t count) {
    Ledger ledger(folder_, kSmall);
    ledger.begin(life());
    for (std::uint64_t n = 1; n <= count; ++n) {
      ledger.add(event::Event{.kind = event::EventKind::kTool, .text = "e", .sequence = n, .tick = 10 * n});
      ledger.add(Command{.sequence = n, .tick = 10 * n, .released = n % 2 == 0});
      ledger.add(Gap{10 * n, 10 * n, "states", 1, "read too slowly"});
      ASSERT_TRUE(ledger.commit());
    }
    ledger.finish();
  }
};

TEST_F(LongLife, TheFirstEventsAndTheNewestRowsAreKeptAndAGapTellsOfTheOthers) {
  live(500);
  const Reader reader(folder_);
  const std::vector<event::Event> events = reader.events();
  ASSERT_GE(events.size(), 60u);
  EXPECT_LE(events.size(), 60u + kSmall.at_once + 1);
  EXPECT_EQ(events[9].sequence, 10u);
  EXPECT_GT(events[10].sequence, 440u);
  EXPECT_EQ(events.back().sequence, 500u);
  const Counts counts = reader.counts();
  EXPECT_GE(counts.commands, 40u);
  EXPECT_LE(counts.commands, 40u + kSmall.at_once + 1);
  std::size_t of_states = 0, of_events = 0;
  std::uint64_t dropped = 0;
  for (const Gap& gap : reader.gaps()) {
    of_states += gap.what == "states";
    of_events += gap.what == "events";
    if (gap.what == "events") dropped += gap.count;
  }
  EXPECT_LE(of_states, kSmall.gaps + kSmall.at_once + 1);
  EXPECT_EQ(of_events, 1u);
  EXPECT_EQ(dropped + events.size(), 500u);
  EXPECT_TRUE(check(folder_).problems.empty()) << check(folder_).problems.front();
}

TEST_F(LongLife, AShortOneIsKeptWhole) {
  live(40);
  const Reader reader(folder_);
  EXPECT_EQ(reader.events().size(), 40u);
  EXPECT_EQ(reader.counts().commands, 40u);
}

}  // namespace
}  // namespace liana::archive
