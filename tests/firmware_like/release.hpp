// Stand-in for the release step: tests may make telecommands without verification.
#pragma once

#include <cstdint>

#include "firmware_like/telecommand.hpp"

namespace liana {

class Release {
 public:
  static Telecommand make(std::uint64_t sequence, std::uint64_t first_tick, std::uint64_t expiry_tick,
                          const Setpoint& setpoint) {
    return {sequence, first_tick, expiry_tick, 1, setpoint};
  }
};

}  // namespace liana
