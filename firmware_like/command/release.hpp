// The one class that makes telecommands. tests/structure/rooms.ini holds who may include it: the step around both
// verdicts (host/control/verification/issue_step.cpp), which makes a candidate for the twin and lets it out only when
// both have passed; the reader of recordings (host/storage/recording), which gives back what was released then; and
// tests.
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
