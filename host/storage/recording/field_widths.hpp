// How wide the recorded fields of a tick are: enough to take its bytes apart and put them together again, whatever they
// mean.
#pragma once

#include <string>

#include "host/storage/recording/visit.hpp"

namespace liana::recording {

// A digit for each field in recorded order: 1, 2, 4 or 8 bytes.
struct FieldWidths {
  std::string inputs;       // up to telecommand_present, which is the last byte
  std::string telecommand;  // what follows where that is 1
  std::string outputs;
  bool operator==(const FieldWidths&) const = default;
};

// Of a robot with so many drives, thetas and segments.
FieldWidths field_widths(bool is_serial, const RecordedCounts& counts);

}  // namespace liana::recording
