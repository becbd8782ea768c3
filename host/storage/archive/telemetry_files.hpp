// Telemetry of one life as it comes, into files that follow each other: a second at a time, oldest file dropped first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/api/telemetry/layout.hpp"
#include "host/storage/archive/database.hpp"
#include "host/storage/archive/per_second_summary.hpp"
#include "host/storage/archive/rows.hpp"

namespace liana::archive {

struct TelemetryLimits {
  double file_s = 3600.0;            // a file is this long
  std::uint64_t bytes = 1200000000;  // of all files; the oldest go, but never the one that is written
};

// Why telemetry is missing.
constexpr const char* kTooOld = "older than the archive keeps";
constexpr const char* kDiskFull = "the disk is full";
constexpr const char* kRoomForRows = "the disk is full: room for commands and events";
constexpr const char* kRoomOnDisk = "the disk is full: the oldest ticks of the ring go from here on";

class TelemetryFiles {
 public:
  // `on_gap` hears of everything that is not, or no longer, there, `on_file` of every file as soon as something durable
  // is in it, by its first tick. Files are made with the first second.
  TelemetryFiles(std::string folder, std::uint64_t life, double period_s, TelemetryLimits limits,
                 std::function<void(const Gap&)> on_gap, std::function<void(std::uint64_t)> on_file);

  // What records hold, for their figures by the second (PerSecondSummary); before the first record.
  void set_layout(const telemetry::Layout& layout) { layout_ = layout; }
  // Facts that hold from this record on; call it before add() of that record.
  void set_facts(const Facts& facts);
  // One record; ticks rise. Writes when a second is together.
  void add(std::uint64_t tick, const std::string& record);
  // Writes what waits. A full disk costs the oldest file of the ring, then of telemetry, and where there is none this
  // second. Throws DatabaseError
  // for anything else.
  void flush();
  // Makes room for what may not be dropped: the oldest file goes, in the end the one that is written. False: there is
  // none.
  bool make_room();
  // Leaves plain files. Throws DatabaseError.
  void finish();

 private:
  struct File {
    File(const std::string& path, const std::optional<telemetry::Layout>& layout);
    Database database;
    Statement telemetry, facts;
    std::optional<PerSecondSummary> figures;
    std::uint64_t first_tick = 0;
    bool is_told = false;          // on_file_ has heard of it
    std::optional<Facts> told;     // the newest facts in it
    std::uint64_t whole_tick = 0;  // of the last ones that were written whole
  };
  void open_file(std::uint64_t first_tick);
  void write();
  void write_facts(const Facts& facts, std::uint64_t tick);
  bool drop_oldest(const std::string& why, bool also_newest);
  void keep_to_limit();
  void lose_second();
  void end_of_loss();

  const std::string folder_;
  const std::uint64_t life_;
  const double period_s_;
  const TelemetryLimits limits_;
  const std::function<void(const Gap&)> on_gap_;
  const std::function<void(std::uint64_t)> on_file_;
  std::optional<telemetry::Layout> layout_;
  std::unique_ptr<File> file_;
  std::string records_;  // of this second
  std::uint64_t first_tick_ = 0, last_tick_ = 0, count_ = 0;
  std::vector<Facts> waiting_;    // of this second
  std::optional<Facts> current_;  // of the newest record that is written
  std::optional<Gap> losing_;     // since the disk is full: what was lost after it was said
};

}  // namespace liana::archive
