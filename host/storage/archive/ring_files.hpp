// Files of the control-rate ring beside archive.db, oldest first: which there are, and which may go.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/storage/archive/rows.hpp"

namespace liana::archive {

enum class RingKind : std::uint8_t {
  kOutputs,  // ring-outputs-LIFE-FIRSTTICK.mcap: goes when it is no longer new
  kKept,     // ring-kept-...: the same, around a fault
  kInputs,   // ring-inputs-...: Inputs, checksums of Outputs, images of the Controller
};

struct RingFile {
  RingKind kind = RingKind::kInputs;
  std::uint64_t life = 0, first_tick = 0;
  std::string path;
};

std::string ring_path(const std::string& folder, RingKind kind, std::uint64_t life, std::uint64_t first_tick);
// Those of a folder by the tick that they begin with, Outputs before the Inputs of the same tick; none where there is
// no such folder.
std::vector<RingFile> ring_files(const std::string& folder);
std::uint64_t bytes_of(const RingFile& file);

// Makes room on a full disk: takes away the oldest file; while `is_open` neither the newest Inputs nor the newest
// Outputs, which may be being written. False: there is none, or it cannot be removed. From any thread or process.
bool drop_oldest_ring_file(const std::string& folder, bool is_open = true);

struct RingLimits {
  double inputs_file_s = 600.0;      // a file is this long
  double outputs_file_s = 20.0;      // likewise
  double image_s = 60.0;             // from image to image of the Controller: a replay begins at one
  double full_s = 3600.0;            // Outputs are kept for so long
  double around_s = 10.0;            // and for ever so long before and after a fault or an emergency stop
  double most_s = 86400.0;           // everything is kept for so long
  std::uint64_t bytes = 1490000000;  // of all files when one begins; the oldest go. 1.5e9 with what comes till the next
  std::uint64_t leave_bytes = 64 << 20;  // of the disk, for commands, events and telemetry
};

// Takes away what is too old at `tick` of `life`, and the oldest where there is too much. What an earlier life left is
// as old as this one.
void keep_to_limits(const std::string& folder, const RingLimits& limits, double period_s, std::uint64_t life,
                    std::uint64_t tick);

// From now on the Outputs of these ticks stay, in files of at most `file_ticks`; `is_open`: the newest one is being
// written, and is left alone.
void keep_outputs(const std::string& folder, std::uint64_t life, Span ticks, std::uint64_t file_ticks, bool is_open);

}  // namespace liana::archive
