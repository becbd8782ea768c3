// Why a drive could not be booted, as a fault of the state message.
#pragma once

#include <string>
#include <vector>

#include "firmware_like/safety/faults.hpp"

namespace liana::realtime {

struct BootProblem {
  int drive = 0;  // 0-based, in the order of the cables
  FaultNumber number = FaultNumber::kNone;
  std::string text;  // node, bus, object, expected and found value, what to do
};

// All texts in one line.
std::string text_of(const std::vector<BootProblem>& problems);

}  // namespace liana::realtime
