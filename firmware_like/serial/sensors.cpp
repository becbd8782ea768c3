#include "firmware_like/serial/sensors.hpp"

#include "firmware_like/serial/adapter_monitor.hpp"
#include "firmware_like/serial/wrist.hpp"

namespace liana::serial {
namespace {

constexpr double kFlicker_Nm = 1e-9;  // to and fro: one that always says the very same is stuck

}  // namespace

Sensors imagined(const Sensors& last) noexcept {
  Sensors next = last;
  if (last.wrist.age_ticks < kWristSilentTicks) {
    ++next.wrist.sequence;
    next.wrist.age_ticks = 0;
    next.wrist.on_arm.torque_Nm[2] += next.wrist.sequence % 2 == 0 ? kFlicker_Nm : -kFlicker_Nm;
  }
  if (last.adapter.age_ticks < kAdapterSilentTicks) {
    ++next.adapter.sequence;
    next.adapter.age_ticks = 0;
  }
  return next;
}

}  // namespace liana::serial
