#include "firmware_like/cable/arm/let_go.hpp"

#include "firmware_like/math/convert.hpp"

namespace liana::cable {

void let_go(const CableLayout& layout, std::int32_t cable, SegmentReleaseState& state) noexcept {
  state = {SegmentReleaseStage::kOut, layout.segment[as_index(cable)], cable, 0};
}

void judge_missed(bool is_slack, std::uint64_t tick, SegmentReleaseState& state, FaultList& faults) noexcept {
  if (state.stage != SegmentReleaseStage::kOut) return;
  if (!is_slack) {
    state.stage = SegmentReleaseStage::kUndone;
    state.ticks = 0;
  } else if (state.ticks == kLetGoJudgeTicks) {
    latch(faults, {FaultNumber::kCableBreak, narrow<std::int16_t>(state.cable), 0, tick});
    state.stage = SegmentReleaseStage::kBroken;
  }
}

bool count_let_go(bool arrived, SegmentReleaseState& state) noexcept {
  if (!is_let_go(state)) return false;
  if (state.ticks < kLetGoSettleTicks) ++state.ticks;
  const bool settled = arrived && state.ticks == kLetGoSettleTicks;
  if (state.stage == SegmentReleaseStage::kUndone && settled) state = SegmentReleaseState{};
  return !settled;
}

TensionPlan plan_without(const RobotParams& table, const CableLayout& layout, const CableGeometry& geometry,
                         const TensionRatio& ratio, std::int32_t segment, const ThetaVector& static_Nm) noexcept {
  TensionRatio without = ratio;  // a loose cable carries nothing to any joint
  SegmentVector lift_N;
  lift_N.fill(-kLetGoLower_N * table.tension.scale());
  for (std::size_t c = 0; c < as_index(layout.cable_count); ++c) {
    if (layout.segment[c] == segment) without[c] = {};
  }
  TensionPlan plan = plan_tension(table, geometry, without, lift_N, {static_Nm, {}});
  for (std::size_t c = 0; c < as_index(layout.cable_count); ++c) {
    if (layout.segment[c] == segment) plan.motor_N[c] = 0.0;
  }
  return plan;
}

}  // namespace liana::cable
