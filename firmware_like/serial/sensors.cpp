#include "firmware_like/serial/sensors.hpp"

#include "firmware_like/serial/adapter_watch.hpp"
#include "firmware_like/serial/wrist.hpp"

namespace liana::serial {

Sensors imagined(const Sensors& last) noexcept {
  Sensors next = last;
  if (last.wrist.age_ticks < kWristSilentTicks) {
    ++next.wrist.sequence;
    next.wrist.age_ticks = 0;
  }
  if (last.adapter.age_ticks < kAdapterSilentTicks) {
    ++next.adapter.sequence;
    next.adapter.age_ticks = 0;
  }
  return next;
}

}  // namespace liana::serial
