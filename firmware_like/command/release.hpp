// The one class that makes telecommands. Who may call it is held by tests/structure: the step after both verdicts
// (host/verify), the reader of recordings, which gives back what was released then (host/record), and tests.
#pragma once

#include <cstdint>

#include "firmware_like/command/telecommand.hpp"

namespace liana {

class Release {
 public:
  // The telecommand `sequence` of `owner`, in force from first_tick until expiry_tick (exclusive).
  template <class Setpoint>
  static constexpr Telecommand<Setpoint> make(std::uint64_t sequence, std::uint64_t first_tick,
                                              std::uint64_t expiry_tick, std::uint32_t owner,
                                              const Setpoint& setpoint) {
    return {sequence, first_tick, expiry_tick, owner, setpoint};
  }
};

}  // namespace liana
