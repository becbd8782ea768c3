#include "hil/bench/fault_injector.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace liana::bench {

namespace {

bool holds(const FaultCondition& when, const Theta& theta_rad, const Theta& rate_rad_s, const DriveBank& drives) {
  if (when.theta && (theta_rad[*when.theta] < when.above_rad || theta_rad[*when.theta] > when.below_rad)) return false;
  if (when.enabled && drives.enabled() != drives.size()) return false;
  return !when.moving ||
         std::any_of(rate_rad_s.begin(), rate_rad_s.end(), [](double rate) { return std::fabs(rate) > kMoving_rad_s; });
}

}  // namespace

FaultInjector::FaultInjector(std::vector<FaultConfig> faults)
    : faults_(std::move(faults)), courses_(faults_.size()), held_(faults_.size(), 0) {}

bool FaultInjector::is_due(std::size_t fault, std::uint32_t slot, const Theta& theta_rad, const Theta& rate_rad_s,
                           const DriveBank& drives) {
  if (faults_[fault].at_slot) return slot == *faults_[fault].at_slot;
  const FaultCondition& when = faults_[fault].when;
  held_[fault] = holds(when, theta_rad, rate_rad_s, drives) ? held_[fault] + 1 : 0;
  return held_[fault] >= when.for_slots;
}

void FaultInjector::step(std::uint32_t slot, const Theta& theta_rad, const Theta& rate_rad_s, DriveBank& drives) {
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    const FaultConfig& fault = faults_[i];
    Course& course = courses_[i];
    if (!course.begun && is_due(i, slot, theta_rad, rate_rad_s, drives)) {
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
