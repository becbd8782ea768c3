// An archive in formats of other tools.
#pragma once

#include <cstdint>
#include <string>

#include "host/storage/archive/reader.hpp"

namespace liana::archive {

// All return how many rows, messages or frames they wrote, and throw std::runtime_error with file and reason when they
// cannot; that there is nothing to write is such a reason, too.

// A line for each record: tick, time, state, number of the step, and every field of the layout; what is not there is
// left empty.
std::uint64_t write_csv(const Reader& reader, Span span, const std::string& file);

// MCAP with the schemas of Foxglove, so that its panels show the arm at once: `/scene`, `/tf` and `/joint_states` at
// 25 Hz, `/log` of events, and `/state` (plain JSON) for plots. Times are arm time. About 2 MB a minute.
std::uint64_t write_mcap(const Reader& reader, Span span, const std::string& file);

// The bus traffic of all buses in one candump log, in the order of its times. Runs with --record have it, and those
// that failed.
std::uint64_t write_candump(const Reader& reader, Span span, const std::string& file);

// Control ticks out of the ring, as `liana run --record` writes them: `folder`, which is made, gets ticks.mcap and
// snapshots.mcap, which `liana replay` runs. Outputs that are no longer kept are made again from the Inputs, and taken
// only where they match the checksum of those that were. Throws std::runtime_error when the ring holds nothing of the
// span, is damaged, or of a build with other fields, and when the folder holds a recording.
struct TicksWritten {
  std::uint64_t ticks = 0;       // that were written
  std::uint64_t made_again = 0;  // of these: their Outputs
  std::uint64_t left_out = 0;    // no Outputs are kept, and no image of this build goes before them
  std::uint64_t differing = 0;   // this core gives other Outputs than those that were
};
TicksWritten write_ticks(const Reader& reader, Span span, const std::string& folder);

}  // namespace liana::archive
