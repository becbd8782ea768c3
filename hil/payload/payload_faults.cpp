#include "hil/payload/payload_faults.hpp"

namespace liana::bench {

namespace {

bool is_on(const FaultInjector& injector, FaultKind kind) {
  for (std::size_t i = 0; i < injector.faults().size(); ++i)
    if (injector.faults()[i].kind == kind && injector.is_on(i)) return true;
  return false;
}

}  // namespace

WristDefects wrist_defects(const FaultInjector& injector) {
  return {.failed = is_on(injector, FaultKind::kSensorFailed),
          .stuck = is_on(injector, FaultKind::kSensorStuck),
          .saturated = is_on(injector, FaultKind::kSensorSaturated),
          .silent = is_on(injector, FaultKind::kSensorSilent)};
}

CaptureDefects capture_defects(const FaultInjector& injector) {
  return {.stale = is_on(injector, FaultKind::kCaptureStale),
          .early = is_on(injector, FaultKind::kCaptureEarly),
          .twice = is_on(injector, FaultKind::kCaptureTwice),
          .lost = is_on(injector, FaultKind::kCaptureLost),
          .denied = is_on(injector, FaultKind::kCaptureDenied)};
}

void spoil_adapter(const FaultInjector& injector, Adapter& adapter) {
  for (std::size_t pin = 0; pin < kPins; ++pin) adapter.defects(pin) = {};
  for (std::size_t i = 0; i < injector.faults().size(); ++i) {
    const FaultConfig& fault = injector.faults()[i];
    const FaultParameters& with = fault.parameters;
    if (!injector.is_on(i)) continue;
    const std::size_t pin = static_cast<std::size_t>(with.pin) - 1;
    if (fault.kind == FaultKind::kJam) adapter.defects(pin).blocked_m = with.depth_m;
    if (fault.kind == FaultKind::kDepthLies) adapter.defects(pin).reads_m = with.depth_m;
  }
  adapter.break_latch(is_on(injector, FaultKind::kLatchFails));
  adapter.break_lock(is_on(injector, FaultKind::kLockFails));
}

Vec3 base_step_m(const FaultInjector& injector, std::uint32_t slot) {
  Vec3 step;
  for (std::size_t i = 0; i < injector.faults().size(); ++i) {
    const FaultConfig& fault = injector.faults()[i];
    const auto& begun = injector.courses()[i].begun;
    const FaultParameters& with = fault.parameters;
    if (fault.kind != FaultKind::kBaseMoved || !begun || slot - *begun >= with.slots) continue;
    step = step + (1.0 / with.slots) * Vec3{with.x_m, with.y_m, with.z_m};
  }
  return step;
}

}  // namespace liana::bench
