// A cable that is gone: the ones that are left in its segment pull the arm away from where it was, and drums that stand
// make it no better, because the energy is in the stretched cables. So the whole segment is let go at once, and the
// tensions of all others are planned without it (docs/explanation/fault-detection.md, "What the arm does").
#pragma once

#include <cstdint>

#include "firmware_like/cable/arm/cables.hpp"
#include "firmware_like/cable/arm/friction.hpp"
#include "firmware_like/cable/arm/tension.hpp"
#include "firmware_like/cable/arm/tension_monitor.hpp"
#include "firmware_like/command/request.hpp"
#include "firmware_like/safety/faults.hpp"

namespace liana::cable {

// So far go the targets of the segment's drums at first: to stretch of 80 N, in 8 ms, a drive only gets by a step that
// is several times as far. The missed cable goes with the others, so that nothing is one-sided when it only slipped or
// its reading was lost.
constexpr double kSegmentRelease_m = 0.005;
// The most that a drum may let out in one tick, and only in the tick in which the segment is let go: that, and the
// stretch of tensions that are planned lower from then on. Drives take it as a step of their targets.
constexpr double kLetGoStep_m = 0.008;
// So far down goes the plan of all other cables (times TensionLimits::scale): what they pull at the segment's joints
// has nothing against it.
constexpr double kLetGoLower_N = 25.0;
// A cable that is missed for so many ticks after its first sample is broken: its segment is wound back to where it is
// taut at the planned pose, which is nothing to the cables that are left and keeps an arm that has all of them where it
// was. Until then a sample that shows tension takes everything back: the first one comes before any drum has moved.
constexpr std::uint16_t kLetGoJudgeTicks = kBreakDebounceTicks - 1;
// Drives may be far behind their targets for so many ticks: five of their time constants.
constexpr std::uint16_t kLetGoSettleTicks = 40;

// In more gravity [m/s2] nothing is let go: until the drums are back, half a second later, the segment would have
// fallen 60 mm. Drums that stand hold it by the cables that are left; without one of five these still surround it,
// without one of three or four they hold only what pulls to their side.
constexpr double kLetGoGravity_m_s2 = 0.5;
inline bool may_let_go(const RobotParams& table) noexcept {
  return dot(table.gravity_m_s2, table.gravity_m_s2) <= kLetGoGravity_m_s2 * kLetGoGravity_m_s2;
}

enum class SegmentReleaseStage : std::uint8_t {
  kNone = 0,
  kOut = 1,     // let out; not judged yet
  kBroken = 2,  // a break: taut, without tension
  kUndone = 3,  // the cable never was gone: everything back to the plan
};

// Which cables are let go, and since when.
struct SegmentReleaseState {
  SegmentReleaseStage stage = SegmentReleaseStage::kNone;
  std::int32_t segment = 0;  // 0-based; -1: no segment is let go, only the cable is done without
  std::int32_t cable = 0;    // the one that is missed
  std::uint16_t ticks = 0;   // since the segment was let go, or since it was undone; up to kLetGoSettleTicks
};

constexpr bool is_let_go(const SegmentReleaseState& state) noexcept {
  return state.stage != SegmentReleaseStage::kNone;
}
// The segment's cables do not follow the plan of tensions.
constexpr bool is_loose(const SegmentReleaseState& state) noexcept {
  return is_let_go(state) && state.stage != SegmentReleaseStage::kUndone;
}
// The cable was found broken, and the arm does without its segment's cables until a clear says that they are whole.
constexpr bool does_without(const SegmentReleaseState& state) noexcept {
  return state.stage == SegmentReleaseStage::kBroken;
}
// Targets may jump out in this tick.
constexpr bool segment_release_begins(const SegmentReleaseState& state) noexcept {
  return state.stage == SegmentReleaseStage::kOut && state.ticks == 0;
}
// Targets may jump back to where the drums stand in this tick.
constexpr bool jumps_back(const SegmentReleaseState& state) noexcept {
  return (state.stage == SegmentReleaseStage::kBroken && state.ticks == kLetGoJudgeTicks) ||
         (state.stage == SegmentReleaseStage::kUndone && state.ticks == 0);
}
// Drives may be far behind their targets.
constexpr bool is_behind(const SegmentReleaseState& state) noexcept {
  return is_let_go(state) && state.ticks < kLetGoSettleTicks;
}

// This cable is planned without tension: it is the one that is missed, or of its segment.
inline bool is_released(const SegmentReleaseState& state, const CableLayout& layout, std::size_t cable) noexcept {
  return is_let_go(state) &&
         (layout.segment[cable] == state.segment || static_cast<std::int32_t>(cable) == state.cable);
}
// The same by a tick's planned tensions: this cable is planned with exactly 0 N while others are pulled, which nothing
// else makes.
bool is_planned_released(const RobotParams& table, const CableVector& plan_N, std::size_t cable) noexcept;
// Nobody expects tension of this cable: its segment is let go, and whether it is broken itself is judged.
inline bool may_be_slack(const SegmentReleaseState& state, const CableLayout& layout, std::int32_t cable) noexcept {
  if (!is_released(state, layout, static_cast<std::size_t>(cable))) return false;
  return cable != state.cable || state.stage != SegmentReleaseStage::kOut;
}

// While the drives are without torque: a clear forgets what was lost, a recovery does without the first cable that
// `faults` have as broken, and without its segment where the arm has no weight that the others carry. Without such a
// fault it does without the cable that a clear has forgotten: it was not whole.
void answer_loss(const RobotParams& table, const CableLayout& layout, Request request, const FaultList& faults,
                 SegmentReleaseState& state) noexcept;

// Lets the segment of `cable` go.
void let_go(const CableLayout& layout, std::int32_t cable, SegmentReleaseState& state) noexcept;

// The missed cable in a later tick, `is_slack` by its watchdog: broken, or never gone.
void judge_missed(bool is_slack, std::uint64_t tick, SegmentReleaseState& state, FaultList& faults) noexcept;

// Ends a tick. `arrived`: every target is where it is wanted. True while drums still have somewhere to go.
bool count_let_go(bool arrived, SegmentReleaseState& state) noexcept;

// Tensions without what is released: that pulls exactly 0 N. Where a segment is let go, the others are near their floor
// and in balance at every joint but this segment's; else all joints are, with what weight and springs take there, and a
// cable of the segment may be planned to push where too few are left.
TensionPlan plan_without(const RobotParams& table, const CableLayout& layout, const CableGeometry& geometry,
                         const TensionRatio& ratio, const SegmentReleaseState& lost,
                         const ThetaVector& static_Nm) noexcept;

}  // namespace liana::cable
