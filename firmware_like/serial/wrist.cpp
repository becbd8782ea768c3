#include "firmware_like/serial/wrist.hpp"

#include "firmware_like/math/convert.hpp"
#include "firmware_like/math/scalar.hpp"

namespace liana::serial {
namespace {

bool is_finite(const Wrench& wrench) noexcept {
  double sum = 0.0;
  for (double x : wrench.force_N) sum += x * 0.0;
  for (double x : wrench.torque_Nm) sum += x * 0.0;
  return sum == 0.0;
}

WristHealth health_of(const WristReading& reading) noexcept {
  if (!is_finite(reading.on_arm)) return WristHealth::kNoNumber;
  if (reading.status == WristStatus::kGood) return WristHealth::kGood;
  return reading.status == WristStatus::kSaturated ? WristHealth::kSaturated : WristHealth::kFailed;
}

bool is_same(const Wrench& a, const Wrench& b) noexcept { return a.force_N == b.force_N && a.torque_Nm == b.torque_Nm; }

}  // namespace

void read_wrist(const WristReading& reading, std::uint16_t still_samples, WristState& state) noexcept {
  const bool first = state.age_ticks == kNeverHeard;
  if (!first) state.age_ticks = narrow<std::uint16_t>(state.age_ticks + 1U);
  if (reading.age_ticks == kNeverHeard) return;
  if (!first && reading.sequence == state.sequence) return;
  state.sequence = reading.sequence;
  state.age_ticks = reading.age_ticks;
  state.said = health_of(reading);
  if (state.said != WristHealth::kGood) return;
  if (first || !is_same(reading.on_arm, state.felt)) {
    state.same_samples = 0;
  } else if (state.same_samples < still_samples) {
    ++state.same_samples;
  }
  state.felt = reading.on_arm;
  if (still_samples > 0 && state.same_samples >= still_samples) state.said = WristHealth::kStuck;
}

WristHealth health(const WristState& state) noexcept {
  return state.age_ticks >= kWristSilentTicks ? WristHealth::kSilent : state.said;
}

Wrench given_by_arm(const WristState& state) noexcept { return sum_of(state.tare, scaled(state.felt, -1.0)); }

}  // namespace liana::serial
