#include "firmware_like/cable/arm/let_go.hpp"

#include "firmware_like/math/convert.hpp"

namespace liana::cable {

void answer_loss(const RobotParams& table, const CableLayout& layout, Request request, const FaultList& faults,
                 SegmentReleaseState& state) noexcept {
  if (request == Request::kClear) state.stage = SegmentReleaseStage::kNone;
  const bool was_lost = !is_let_go(state) && state.ticks == kLetGoSettleTicks;
  if (request == Request::kRecover && was_lost) state.stage = SegmentReleaseStage::kBroken;
  for (std::int32_t i = 0; i < faults.count && request == Request::kRecover; ++i) {
    const Fault& fault = faults.fault[as_index(i)];
    if (fault.number != FaultNumber::kCableBreak) continue;
    const std::int32_t segment = may_let_go(table) ? layout.segment[as_index(fault.index)] : -1;
    state = {SegmentReleaseStage::kBroken, segment, fault.index, kLetGoSettleTicks};
    return;
  }
}

bool is_planned_released(const RobotParams& table, const CableVector& plan_N, std::size_t cable) noexcept {
  if (plan_N[cable] != 0.0) return false;
  const std::size_t cables = as_index(table.cable_count());
  for (std::size_t c = as_index(table.feed_count()); c < cables; ++c)
    if (plan_N[c] > 0.0) return static_cast<std::int32_t>(cable) >= table.feed_count();
  return false;
}

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
                         const TensionRatio& ratio, const SegmentReleaseState& lost,
                         const ThetaVector& static_Nm) noexcept {
  TensionRatio without = ratio;  // a loose cable carries nothing to any joint
  SegmentVector lift_N;
  lift_N.fill(lost.segment < 0 ? 0.0 : -kLetGoLower_N * table.tension.scale());
  for (std::size_t c = 0; c < as_index(layout.cable_count); ++c) {
    if (is_released(lost, layout, c)) without[c] = {};
  }
  TensionPlan plan = plan_tension(table, geometry, without, lift_N, {static_Nm, {}});
  for (std::size_t c = 0; c < as_index(layout.cable_count); ++c) {
    if (is_released(lost, layout, c)) plan.motor_N[c] = 0.0;
  }
  return plan;
}

}  // namespace liana::cable
