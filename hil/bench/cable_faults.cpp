// What each fault kind does to a drive's cable, and how it ends.
#include "hil/bench/drive_bank.hpp"

namespace liana::bench {

namespace {

constexpr double kSlackPerSlot_m = 1e-5;  // a clamp slips, no faster than that its tension falls by noise
constexpr int kSlackSlots = 2000;         // 20 mm: no tension left at any pose of the mission's
constexpr double kBroken_m = 1.0;         // more than a drum winds up in an hour of pretension attempts

}  // namespace

// Of slack that has ended and is not all taken up.
int DriveBank::slots_to_take_up(std::size_t i) const { return creep_[i].per_slot_m < 0.0 ? creep_[i].slots_left : 0; }

void DriveBank::begin_behind(const FaultConfig& fault, std::size_t i) {
  const FaultParameters& with = fault.parameters;
  switch (fault.kind) {
    case FaultKind::kSlack:
      creep_[i] = {kSlackPerSlot_m, kSlackSlots - slots_to_take_up(i)};
      return;
    case FaultKind::kCableSlip:
      creep_[i] = {with.length_m / with.slots, static_cast<int>(with.slots)};
      return;
    case FaultKind::kCableBreak:
      loose_m_[i] += kBroken_m;
      return;
    case FaultKind::kMotorSaturation:
      at(i).defects().most_torque_permille = permille(with.tension_N);
      return;
    default:
      return;  // the rest is the drive's own
  }
}

void DriveBank::end_behind(const FaultConfig& fault, std::size_t i) {
  switch (fault.kind) {
    case FaultKind::kSlack:
      creep_[i] = {-kSlackPerSlot_m, kSlackSlots - creep_[i].slots_left};  // taken up as slowly: nothing jerks
      return;
    case FaultKind::kMotorSaturation:
      at(i).defects().most_torque_permille = DriveDefects{}.most_torque_permille;
      return;
    default:
      return;  // the rest cannot end; load_faults sees to it
  }
}

}  // namespace liana::bench
