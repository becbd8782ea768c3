#include "firmware_like/cable/arm/cable_monitor.hpp"

#include <cmath>

#include "firmware_like/math/convert.hpp"
#include "firmware_like/math/pair.hpp"
#include "firmware_like/math/scalar.hpp"

namespace liana::cable {
namespace {

using Index = std::size_t;

// Detail of a fault: a length in micrometres.
std::uint16_t micrometres(double length_m) noexcept {
  return narrow<std::uint16_t>(to_counts(1e6 * std::fabs(length_m)).value);
}

// The level of every cable, from the readings. Returns the sum of the squares of its changes since `before_N`.
double take_levels(const CableWatchLimits& limits, const CableReadings& now, const CableVector& before_N,
                   CableVector& level_N) noexcept {
  Pair squares{};
  for (Index c = 0; c < static_cast<Index>(limits.cable_count); c += 2) {
    const Pair beyond_m = load_pair(&now.payout_m[c]) - load_pair(&now.path_m[c]);
    const Pair level = load_pair(&now.tension_N[c]) + load_pair(&limits.stiffness_N_m[c]) * beyond_m;
    const Pair change = level - load_pair(&before_N[c]);
    store_pair(level, &level_N[c]);
    squares += change * change;
  }
  return sum(squares);
}

std::int32_t max_changed(const CableWatchLimits& limits, const CableVector& before_N,
                         const CableVector& level_N) noexcept {
  std::int32_t most = 0;
  double largest_N = 0.0;
  for (std::int32_t c = 0; c < limits.cable_count; ++c) {
    const double change_N = std::fabs(level_N[as_index(c)] - before_N[as_index(c)]);
    if (!(change_N > largest_N)) continue;
    most = c;
    largest_N = change_N;
  }
  return most;
}

// A jump of more than the limit makes its cable the suspect, or is one more of the suspect's.
void note_jump(const CableWatchLimits& limits, const CableVector& before_N, const CableVector& level_N,
               CableMonitorState& state) noexcept {
  const std::int32_t cable = max_changed(limits, before_N, level_N);
  const double change_N = level_N[as_index(cable)] - before_N[as_index(cable)];
  if (!(std::fabs(change_N) > limits.jump_N)) return;
  const bool rose = change_N > 0.0;
  if (cable == state.suspect) {
    if (rose != state.suspect_rose && state.reversals < kScatterReversals) ++state.reversals;
  } else {
    state.suspect = cable;
    state.suspect_from_N = before_N[as_index(cable)];
  }
  state.suspect_rose = rose;
  state.suspect_ticks = 0;
}

// A suspect scatters, or stays where it jumped to, or is none.
void judge_suspect(const CableWatchLimits& limits, const CableVector& level_N, std::uint64_t tick,
                   CableMonitorState& state, FaultList& faults) noexcept {
  const Index c = as_index(state.suspect);
  const std::int16_t drive = narrow<std::int16_t>(state.suspect);
  const double moved_N = level_N[c] - state.suspect_from_N;
  if (state.reversals >= kScatterReversals) {
    latch(faults, {FaultNumber::kTensionScatters, drive, 0, tick});
    return;
  }
  if (++state.suspect_ticks < kJumpConfirmTicks) return;
  state.suspect = -1;
  if (std::fabs(moved_N) > 0.5 * limits.jump_N) {
    latch(faults, {FaultNumber::kCableSlip, drive, micrometres(moved_N / limits.stiffness_N_m[c]), tick});
  }
}

// One segment: its cables' lengths contradict each other by more or less than when the arm was enabled. One that does
// is stayed with.
void watch_contradiction(const RobotParams& table, const CableWatchLimits& limits, const CableReadings& now,
                         std::uint64_t tick, CableMonitorState& state, FaultList& faults) noexcept {
  const std::int32_t first = state.cable, end = first + table.segment[as_index(state.segment)].cables;
  double tension_N = table.tension.plan_N;  // one cable that is tighter turns its segment against the others
  for (Index c = as_index(first); c < as_index(end); ++c) tension_N = larger(tension_N, now.tension_N[c]);
  for (Index c = as_index(first); c < as_index(end); ++c) {
    const double change_m = now.residual_m[c] - state.residual_m[c];
    if (std::fabs(change_m) <= limits.contradiction_m[c] + tension_N * table.friction_mu * limits.hidden_m_N[c])
      continue;
    if (++state.contradicts_ticks < kContradictionTicks) return;
    latch(faults, {FaultNumber::kHomingImplausible, narrow<std::int16_t>(first), micrometres(change_m), tick});
    return;
  }
  state.contradicts_ticks = 0;
  const bool last = ++state.segment == table.segment_count;
  state.cable = last ? 0 : end;
  if (last) state.segment = 0;
}

}  // namespace

CableWatchLimits make_cable_watch_limits(const RobotParams& table, const CableVector& zero_payout_m) noexcept {
  CableWatchLimits limits;
  limits.cable_count = table.cable_count();
  limits.jump_N = table.cable_monitor.jump_N;
  Index c = 0;
  double wrap_rad = 0.0;
  for (Index j = 0; j < as_index(table.segment_count); ++j) {
    wrap_rad += table.segment[j].modules * table.segment[j].theta_limit_rad;
    for (std::int32_t i = 0; i < table.segment[j].cables; ++i, ++c) {
      limits.contradiction_m[c] = table.cable_monitor.contradiction_m;
      if (feeds(table.segment[j])) continue;  // no tension goes with its lengths
      limits.stiffness_N_m[c] = table.cable_EA_N / zero_payout_m[c];
      limits.hidden_m_N[c] = wrap_rad / limits.stiffness_N_m[c];
    }
  }
  return limits;
}

void watch_cables(const RobotParams& table, const CableWatchLimits& limits, const CableReadings& now, bool usable,
                  std::uint64_t tick, CableMonitorState& state, FaultList& faults) noexcept {
  if (!usable) {
    state.watching = false;
    return;
  }
  const CableVector& before_N = state.level_N[state.newest];
  state.newest ^= 1;
  CableVector& level_N = state.level_N[state.newest];
  const double squares = take_levels(limits, now, before_N, level_N);
  if (!state.watching) {
    state = CableMonitorState{
        .watching = true, .newest = state.newest, .level_N = state.level_N, .residual_m = now.residual_m};
    return;
  }
  if (!(squares <= limits.jump_N * limits.jump_N)) note_jump(limits, before_N, level_N, state);
  if (state.suspect >= 0) judge_suspect(limits, level_N, tick, state, faults);
  if (state.reversals > 0 && tick % kScatterForgetTicks == 0) --state.reversals;
  watch_contradiction(table, limits, now, tick, state, faults);
}

}  // namespace liana::cable
