// What enters one tick of any robot.
#pragma once

#include <cstdint>

#include "firmware_like/command/request.hpp"
#include "firmware_like/drive/drive_io.hpp"

namespace liana {

struct CycleInputs {
  std::uint64_t tick = 0;
  std::uint32_t lost_ticks = 0;     // deadlines missed just before this tick
  std::uint32_t lost_bus_mask = 0;  // bit b: bus b is down
  std::uint32_t twice_mask = 0;     // bit i: somebody else speaks under the identifiers of drive i, too
  Request request = Request::kNone;
  DriveFeedbacks drive{};
};

}  // namespace liana
