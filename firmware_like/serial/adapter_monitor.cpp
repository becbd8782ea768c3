#include "firmware_like/serial/adapter_monitor.hpp"

#include "firmware_like/math/convert.hpp"

namespace liana::serial {

void read_adapter(const AdapterReading& reading, AdapterState& state) noexcept {
  const bool first = state.age_ticks == kNeverHeard;
  state.is_new = false;
  if (!first) state.age_ticks = narrow<std::uint16_t>(state.age_ticks + 1U);
  if (reading.age_ticks == kNeverHeard) return;
  if (!first && reading.sequence == state.last.sequence) {
    if (reading.age_ticks == 0) state.repeated = narrow<std::uint32_t>(std::uint64_t{state.repeated} + 1U);
    return;
  }
  state.last = reading;
  state.is_new = true;
  state.age_ticks = reading.age_ticks;
}

bool pins_are_in(const AdapterState& state) noexcept {
  bool in = is_heard(state);
  for (const std::uint8_t depth_01mm : state.last.depth_01mm) in = in && depth_01mm > kPastFace_01mm;
  return in;
}

}  // namespace liana::serial
