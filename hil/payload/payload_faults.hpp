// What the fault list does to target, sensors, adapter and base of an arm that installs a payload.
#pragma once

#include <cstdint>

#include "hil/bench/fault_injector.hpp"
#include "hil/payload/adapter_node.hpp"
#include "hil/payload/wrist_sensor.hpp"

namespace liana::bench {

// What is wrong with the wrist sensor, and with what the adapter says, in this slot.
WristDefects wrist_defects(const FaultInjector& injector);
CaptureDefects capture_defects(const FaultInjector& injector);
// Puts what is wrong with pins, latch and lock drive into the adapter; takes back what has ended.
void spoil_adapter(const FaultInjector& injector, Adapter& adapter);
// By how much the base moves in this slot, in the frame of the base as it was.
Vec3 base_step_m(const FaultInjector& injector, std::uint32_t slot);

}  // namespace liana::bench
