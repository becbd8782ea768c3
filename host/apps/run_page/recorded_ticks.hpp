// The ticks of a run as its page replays them: the core in the page gets the same Inputs, and its Outputs are compared
// (docs/getting-started/tour-of-the-console.md).
#pragma once

#include <cstdint>
#include <string>

namespace liana::run_page {

// A page holds the first ten minutes at 250 Hz: some 3 MB.
constexpr std::uint64_t kMaxPageTicks = 150000;

struct RecordedTicks {
  bool is_serial = false;
  std::uint64_t recorded = 0;  // how many ticks the recording has, with those that the page leaves out
  std::uint64_t ticks = 0;     // how many of them follow the start without a gap: these are in `bytes`
  std::string start;           // the recording's start message
  std::string sizes;           // of the Inputs of each tick [byte]: u16, little-endian
  std::string inputs;     // byte i of all ticks whose Inputs have one, for each i, as difference from the one before
  std::string checksums;  // of the Outputs of each tick: CRC-32 as in IEEE 802.3, little-endian
};

// Of the recording in `folder`; with no ticks where there is none, or one that begins in mid-run. Throws
// std::runtime_error when the file is damaged.
RecordedTicks recorded_ticks_in(const std::string& folder, bool is_serial);

}  // namespace liana::run_page
