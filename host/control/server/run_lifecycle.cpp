#include "host/control/server/run_lifecycle.hpp"

#include <algorithm>

namespace liana::server {

namespace {

constexpr double kAfterMission_s = 1.0;      // of arm time at rest
constexpr double kAfterFault_s = 5.0;        // the same where something failed: elastic cables let the arm swing
constexpr double kMaxAfterMission_s = 60.0;  // of arm time, at rest or not
constexpr double kShutdownLimit_s = 10.0;    // of arm time, until the drives are off

bool is_off(const CycleOutputs& outputs) {
  return outputs.state == OperatingState::kDisabled || outputs.state == OperatingState::kFault;
}

}  // namespace

void RunLifecycle::mission_ends(std::uint64_t tick) {
  if (is_stopping()) return;
  phase_ = RunPhase::kAfterMission;
  since_tick_ = tick;
}

void RunLifecycle::ask_to_end() {
  was_asked_ = true;
  if (phase_ == RunPhase::kRunning) phase_ = RunPhase::kAskedToEnd;
}

const char* RunLifecycle::why_to_stop(std::uint64_t tick, const CycleOutputs& outputs) {
  if (phase_ == RunPhase::kAskedToEnd) return "asked for";
  if (phase_ != RunPhase::kAfterMission) return nullptr;
  if (!is_off(outputs) && outputs.at_rest == 0) moved_tick_ = tick;
  const double rested_s = since_s(tick, std::max(since_tick_, moved_tick_));
  const double enough_s = outputs.faults.count == 0 ? kAfterMission_s : kAfterFault_s;
  const bool ends = rested_s > enough_s || since_s(tick, since_tick_) > kMaxAfterMission_s;
  return ends ? "the mission has ended" : nullptr;
}

bool RunLifecycle::stop(std::uint64_t tick) {
  if (is_stopping()) return false;
  phase_ = RunPhase::kStopping;
  since_tick_ = tick;
  return true;
}

bool RunLifecycle::is_over(std::uint64_t tick, const CycleOutputs& outputs) const {
  if (!is_stopping()) return false;
  return (is_off(outputs) && tick > since_tick_ + interval_ticks_) || since_s(tick, since_tick_) > kShutdownLimit_s;
}

}  // namespace liana::server
