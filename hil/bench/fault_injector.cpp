#include "hil/bench/fault_injector.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hil/config/fault_kinds.hpp"

namespace liana::bench {

FaultInjector::FaultInjector(std::vector<FaultConfig> faults)
    : faults_(std::move(faults)), courses_(faults_.size()), held_(faults_.size(), 0) {}

void FaultInjector::add(const std::vector<FaultConfig>& more) {
  faults_.insert(faults_.end(), more.begin(), more.end());
  courses_.resize(faults_.size());
  held_.resize(faults_.size(), 0);
}

bool FaultInjector::has(FaultKind kind, std::size_t drive) const {
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    const std::vector<std::size_t>& drives = faults_[i].drives;
    if (faults_[i].kind == kind && is_on(i) && std::find(drives.begin(), drives.end(), drive) != drives.end())
      return true;
  }
  return false;
}

void FaultInjector::end_all() {
  for (std::size_t i = 0; i < faults_.size(); ++i)
    if (is_on(i) && row_of(faults_[i].kind).can_end) faults_[i].for_slots = 0;
}

bool FaultInjector::holds(const FaultCondition& when, std::uint32_t slot, const TrueMotion& arm,
                          const Drives& drives) const {
  if (when.theta && (arm.angle_rad[*when.theta] < when.above_rad || arm.angle_rad[*when.theta] > when.below_rad))
    return false;
  if (when.enabled && drives.enabled() != drives.size()) return false;
  if (when.depth_above_m && arm.depth_m <= *when.depth_above_m) return false;
  if (when.depth_below_m && (arm.depth_m >= *when.depth_below_m || arm.depth_m <= kNoDepth_m)) return false;
  if (when.contact_above_N && arm.contact_N <= *when.contact_above_N) return false;
  if (when.captured && !arm.captured) return false;
  if (when.carried_above && arm.carried <= *when.carried_above) return false;
  if (when.after_first_slots && (!courses_[0].begun || slot < *courses_[0].begun + *when.after_first_slots))
    return false;
  return !when.moving || std::any_of(arm.rate_rad_s.begin(), arm.rate_rad_s.end(),
                                     [](double rate) { return std::fabs(rate) > kMoving_rad_s; });
}

bool FaultInjector::is_due(std::size_t fault, std::uint32_t slot, const TrueMotion& arm, const Drives& drives) {
  if (faults_[fault].at_slot) return slot == *faults_[fault].at_slot;
  const FaultCondition& when = faults_[fault].when;
  held_[fault] = holds(when, slot, arm, drives) ? held_[fault] + 1 : 0;
  return held_[fault] >= when.for_slots;
}

void FaultInjector::step(std::uint32_t slot, const TrueMotion& arm, Drives& drives) {
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    const FaultConfig& fault = faults_[i];
    Course& course = courses_[i];
    if (!course.begun && is_due(i, slot, arm, drives)) {
      course.begun = slot;
      for (const std::size_t drive : fault.drives) drives.begin(fault, drive);
    }
    if (course.begun && !course.ended && fault.for_slots && slot - *course.begun >= *fault.for_slots) {
      course.ended = slot;
      for (const std::size_t drive : fault.drives) drives.end(fault, drive);
    }
  }
}

}  // namespace liana::bench
