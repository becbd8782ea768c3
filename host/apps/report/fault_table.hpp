// Every fault number with how it is detected, for `liana faults` and docs/reference/faults.md. Numbers, names,
// reactions and remedies are the core's own; times come from its constants and from the robot table.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "firmware_like/safety/faults.hpp"

namespace liana::report {

struct FaultRow {
  FaultInfo info;
  const char* detector = "";  // what looks, and at what
  int within_ticks = 0;       // from the cause on, at most; -1: whenever it happens to be looked at
  std::string stops_by;       // "hold", "stop", "stop at once", "off at once"
};

// What the times depend on.
struct FaultTimes {
  double tick_s = 0.0;
  std::int32_t segments = 0;  // of a cable arm; 0: a serial arm, which has none of its faults
};

// All numbers but none, ascending, for a robot. For a serial arm those of cables have no time.
std::vector<FaultRow> fault_rows(const FaultTimes& times);

// The table as it stands in docs/reference/faults.md.
std::string markdown_of(const std::vector<FaultRow>& rows);

}  // namespace liana::report
