#include "firmware_like/serial/sensors.hpp"

#include "firmware_like/serial/adapter_monitor.hpp"
#include "firmware_like/serial/wrist.hpp"

namespace liana::serial {
namespace {

constexpr double kFlicker_Nm = 1e-9;  // to and fro: one that always says the very same is stuck

}  // namespace

void predict_sensors(Sensors& sensors) noexcept {
  if (sensors.wrist.age_ticks < kWristSilentTicks) {
    ++sensors.wrist.sequence;
    sensors.wrist.age_ticks = 0;
    sensors.wrist.on_arm.torque_Nm[2] += sensors.wrist.sequence % 2 == 0 ? kFlicker_Nm : -kFlicker_Nm;
  }
  if (sensors.adapter.age_ticks < kAdapterSilentTicks) {
    ++sensors.adapter.sequence;
    sensors.adapter.age_ticks = 0;
  }
}

}  // namespace liana::serial
