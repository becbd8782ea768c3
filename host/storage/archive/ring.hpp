// The control-rate ring: every tick of lianad, with and without --record, in files that follow each other. Outputs of
// the last hour and around faults; of the rest Inputs and a checksum of the Outputs, which a replay makes again from
// them.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/storage/archive/ring_files.hpp"
#include "host/storage/archive/ring_segment.hpp"
#include "host/storage/archive/rows.hpp"
#include "host/storage/archive/tick_block.hpp"

namespace liana::archive {

class Ring {
 public:
  // `life`: of the archive that the folder holds (Ledger::begin), `about` what it says. `on_gap` hears of ticks that
  // are not there because of a slow reader or a full disk, not of those that are too old.
  Ring(std::string folder, std::uint64_t life, const Life& about, RingLimits limits,
       std::function<void(const Gap&)> on_gap);

  // One binary packet of lianad's topic `tick`. Throws std::runtime_error for one of another version. A disk that takes
  // nothing costs ticks, and throws nothing.
  void take(std::string_view packet);
  // A fault or an emergency stop was at this tick.
  void keep_around(std::uint64_t tick);
  // Writes what waits and ends the files.
  void finish();

  std::uint64_t ticks() const { return ticks_; }      // that were taken
  std::uint64_t missing() const { return missing_; }  // that never came, or found no room

 private:
  std::uint64_t ticks_in(double time_s) const;
  void take_tick(std::string_view packet);
  void take_image(std::string_view packet);
  void look_for_gap(std::string_view inputs);
  void flush();
  void write();
  void open_files(std::uint64_t tick);
  void keep_windows(bool is_open);
  bool has_room() const;
  bool make_room();
  void lose_block(const std::string& why);
  void end_of_loss();

  const std::string folder_;
  const std::uint64_t life_;
  const double period_s_;
  const bool is_serial_;
  const RingLimits limits_;
  const std::function<void(const Gap&)> on_gap_;
  RingAbout about_;
  std::optional<TickBlock> block_;
  std::unique_ptr<RingSegment> inputs_, outputs_;
  std::string image_;                        // the next one to be written
  std::optional<std::uint64_t> image_tick_;  // of the newest that was written, where a replay can go on from it
  std::vector<Span> windows_;                // around faults
  std::optional<std::uint64_t> next_tick_;
  std::optional<Gap> losing_;          // since the disk takes nothing: what was lost after it was said
  std::uint64_t next_alarm_tick_ = 0;  // of a full disk
  std::uint64_t ticks_ = 0, missing_ = 0;
};

}  // namespace liana::archive
