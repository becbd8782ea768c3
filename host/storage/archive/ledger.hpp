// archive.db: events, commands and gaps of a life, the oldest dropped beyond a bound that days do not reach. Rows wait
// until commit() has made them durable; only then do they count as kept.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/base/event/event.hpp"
#include "host/storage/archive/database.hpp"
#include "host/storage/archive/rows.hpp"

namespace liana::archive {

// Rows of one life. The first events stay: they have the cause of what went on.
struct LedgerLimits {
  std::uint64_t first_events = 10'000, newest_events = 1'000'000;
  std::uint64_t commands = 5'000'000;  // a day has 4,320,000 at 50 a second
  std::uint64_t gaps = 100'000;
  std::uint64_t at_once = 1000;  // rows are dropped together
};

class Ledger {
 public:
  // Of rows that wait for a disk that takes no more; beyond it they are counted as lost.
  static constexpr std::size_t kMaxQueuedWrites = 100000;

  // Opens the archive of this folder, which must exist, or makes it. Throws DatabaseError, also for one that is
  // damaged.
  explicit Ledger(const std::string& folder, const LedgerLimits& limits = {});

  // What is added from here on is of this life. Goes on with the newest one where its recorder was cut off and it is
  // the same: of the same tables and build, and with no event that lianad has yet to number (`next_event`, 0: never).
  // Throws DatabaseError.
  struct Begun {
    std::uint64_t life = 0;  // number, 1 for the first
    bool goes_on = false;
  };
  Begun begin(const Life& life, std::uint64_t next_event = 0);
  // Of its telemetry, once the first state has come. Throws DatabaseError.
  void set_layout(const Json& layout);

  void add(const event::Event& event);
  void add(const Command& command);
  void add(const Gap& gap);
  // A file of telemetry that begins at this tick is there; a gap tells when it is dropped.
  void add_telemetry_file(std::uint64_t first_tick);
  // Whether rows wait for commit().
  bool is_waiting() const { return !waiting_.empty(); }
  // Makes all that was added outlive loss of power: milliseconds, at worst half a second. False when the disk takes no
  // more: then all of it waits for the next try. Throws DatabaseError for anything else.
  bool commit();
  // Events, commands and gaps that are durable, of this object; and rows that found no place to wait.
  std::uint64_t durable() const { return durable_; }
  std::uint64_t lost() const { return lost_; }

  // The life is over: leaves one plain file. Throws DatabaseError.
  void finish();

 private:
  void wait(std::function<void()> insert);
  void drop_oldest();
  void drop_events(std::uint64_t from, std::uint64_t to);

  LedgerLimits limits_;
  Database database_;
  std::optional<Statement> event_, command_, gap_, telemetry_file_;
  std::uint64_t life_ = 0, durable_ = 0, lost_ = 0;
  std::vector<std::function<void()>> waiting_;
  std::size_t files_waiting_ = 0;  // of these, files of telemetry
  std::uint64_t newest_event_ = 0, newest_command_ = 0, newest_tick_ = 0, gaps_ = 0;
  std::uint64_t events_dropped_ = 0, commands_dropped_ = 0, gaps_dropped_ = 0;  // up to this one
};

}  // namespace liana::archive
