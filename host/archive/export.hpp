// An archive in formats of other tools.
#pragma once

#include <cstdint>
#include <string>

#include "host/archive/reader.hpp"

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

}  // namespace liana::archive
