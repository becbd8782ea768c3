// Reads the archive of a run, also while it is written. Any minute of telemetry comes within milliseconds.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/api/telemetry/layout.hpp"
#include "host/base/event/event.hpp"
#include "host/storage/archive/database.hpp"
#include "host/storage/archive/rows.hpp"

namespace liana::archive {

struct Counts {
  std::uint64_t events = 0, commands = 0, refused = 0;
};

class Reader {
 public:
  // `path`: the folder of a run, or its archive.db. `life`: which one, 0: the newest. Throws std::runtime_error with
  // path and reason.
  explicit Reader(const std::string& path, std::uint64_t life = 0);

  const std::string& folder() const { return folder_; }
  std::uint64_t life_number() const { return life_number_; }
  std::uint64_t lives() const { return lives_; }
  const Life& life() const { return life_; }
  // The recorder ended in order; false: it still writes, or was killed.
  bool is_finished() const { return finished_; }
  // Of the records; nothing where not one state came.
  const std::optional<telemetry::Layout>& layout() const { return layout_; }
  // From the first record to the last one; nothing without records. A few ms.
  std::optional<Span> recorded() const;

  // All in order of their ticks. Those below throw std::runtime_error when a file is damaged.
  std::vector<event::Event> events(Span span = kAll) const;
  std::vector<Command> commands(Span span = kAll, bool only_refused = false) const;
  std::vector<Gap> gaps() const;
  // Records of telemetry (host/api/telemetry/record.hpp), at most 50 a second.
  std::vector<std::string> telemetry(Span span = kAll) const;
  // What states said besides their numbers; the first holds at the begin of the span, from an earlier tick on.
  std::vector<Facts> facts(Span span = kAll) const;

  Counts counts() const;
  // Names of telemetry files of this life that were written and are not there, though no gap tells that they were
  // dropped. An archive of a version that kept no list of them is only asked whether there is any.
  std::vector<std::string> missing_files() const;
  // Of all lives: bytes of all files, and what SQLite finds wrong in them.
  std::uint64_t bytes() const;
  std::vector<std::string> problems() const;

  // Ticks of a stretch of arm time.
  Span span_of(double from_s, double to_s) const;

 private:
  void read_life(std::uint64_t life);
  std::uint64_t count(const std::string& sql) const;
  std::vector<Database> telemetry_of(Span span) const;

  std::string folder_;
  Database database_;
  std::uint64_t life_number_ = 0, lives_ = 0;
  Life life_;
  bool finished_ = false;
  std::optional<telemetry::Layout> layout_;
};

}  // namespace liana::archive
