// From a recording to a tape, and to what the core must answer.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <set>
#include <string>

#include "firmware_like/cable_controller.hpp"
#include "firmware_like/serial_controller.hpp"

namespace liana::bits {

struct TapeSummary {
  std::uint64_t mission_ticks = 0;  // whole recordings
  std::uint64_t what_if_ticks = 0;  // in branches off them
  std::uint64_t what_ifs = 0;       // branches
  std::set<FaultNumber> faults;     // that the branches and missions reached
};

struct TapeOptions {
  std::uint64_t apart = 5000;            // ticks between branches
  std::uint64_t limit = ~0ULL;           // most ticks of each recording
  std::optional<std::uint64_t> flip_at;  // falsifies one bit of this recorded tick (from 0), to see that it is found
};

// Appends a recording to a tape. Branches leave it at and shortly after every change of the operating state and of the
// held variables, and every `apart` ticks. `expected` gets the recorded Outputs, in branches those of the core that
// this program is built with. Throws std::runtime_error when the recording is not whole or does not begin at the start
// of a run. The arm is that of the recording.
template <class Arm>
void append_recording(const std::string& directory, const TapeOptions& options, std::ostream& tape,
                      std::ostream& expected, TapeSummary& summary);

// Appends cases (tests/benchmarks/worst_cases.hpp), one a line, each from power-up. Returns how many ticks they have;
// throws std::runtime_error on a line that is no case.
std::uint64_t append_cases(std::istream& lines, std::ostream& tape, std::ostream& expected);

}  // namespace liana::bits
