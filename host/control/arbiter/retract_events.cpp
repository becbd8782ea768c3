#include "host/control/arbiter/retract_events.hpp"

#include <array>

namespace liana::arbiter {

const char* retract_phase_name(RetractPhase phase) {
  static constexpr std::array<const char*, 6> kNames{"none", "stopping", "joining", "back", "done", "ended"};
  return kNames[static_cast<std::size_t>(phase)];
}

}  // namespace liana::arbiter
