// What each fault kind does to a drive or its cable, and how it ends.
#include <cmath>

#include "hil/bench/drive_bank.hpp"

namespace liana::bench {

namespace {

constexpr double kSlackPerSlot_m = 1e-5;  // a clamp slips, no faster than that its tension falls by noise
constexpr int kSlackSlots = 2000;         // 20 mm: no tension left at any pose of the mission's
constexpr double kBroken_m = 1.0;         // more than a drum winds up in an hour of pretension attempts

}  // namespace

void DriveBank::begin(const FaultConfig& fault, std::size_t i) {
  Drive& drive = *drives_[i];
  const FaultParameters& with = fault.parameters;
  const auto code = static_cast<std::uint16_t>(with.code);
  switch (fault.kind) {
    case FaultKind::kMissing:
      return drive.power_off();
    case FaultKind::kWrongIdentityAfterReboot:
      drive.power_off();
      drive.set_identity(robot_.product + 1);
      return drive.power_on();
    case FaultKind::kWrongIdentity:
      return drive.set_identity(robot_.product + 1);
    case FaultKind::kSilent:
      drive.defects().silent = true;
      return;
    case FaultKind::kFault:
      return drive.raise_fault(code);
    case FaultKind::kSto:
      return drive.set_safe_torque_off();
    case FaultKind::kSlack:
      creep_[i] = {kSlackPerSlot_m, kSlackSlots};
      return;
    case FaultKind::kLate:
      drive.defects().late_cycles = static_cast<std::size_t>(with.cycles);
      return;
    case FaultKind::kStuck:
      drive.defects().stuck = true;
      return;
    case FaultKind::kNoisy:
      noise_[i] = {with.counts, with.permille};
      return;
    case FaultKind::kWrongPdoLength:
      drive.defects().pdo_length = static_cast<std::uint8_t>(with.bytes);
      return;
    case FaultKind::kEmcy:
      return drive.report_emergency(code);
    case FaultKind::kReboot:
      drive.power_off();
      return drive.power_on();
    case FaultKind::kEncoderJump:
      return drive.jump_encoder(with.counts);
    case FaultKind::kCableSlip:
      creep_[i] = {with.length_m / with.slots, static_cast<int>(with.slots)};
      return;
    case FaultKind::kCableBreak:
      loose_m_[i] += kBroken_m;
      return;
    case FaultKind::kMotorSaturation:
      drive.defects().most_torque_permille = permille(with.tension_N);
  }
}

void DriveBank::end(const FaultConfig& fault, std::size_t i) {
  DriveDefects& defects = drives_[i]->defects();
  const DriveDefects none;
  switch (fault.kind) {
    case FaultKind::kMissing:
      return drives_[i]->power_on();
    case FaultKind::kSilent:
      defects.silent = none.silent;
      return;
    case FaultKind::kSlack:
      loose_m_[i] -= kSlackPerSlot_m * (kSlackSlots - creep_[i].slots_left);
      creep_[i].slots_left = 0;
      return;
    case FaultKind::kLate:
      defects.late_cycles = none.late_cycles;
      return;
    case FaultKind::kStuck:
      defects.stuck = none.stuck;
      return;
    case FaultKind::kNoisy:
      noise_[i] = {};
      return;
    case FaultKind::kWrongPdoLength:
      defects.pdo_length = none.pdo_length;
      return;
    case FaultKind::kMotorSaturation:
      defects.most_torque_permille = none.most_torque_permille;
      return;
    default:
      return;  // the rest cannot end; load_faults sees to it
  }
}

}  // namespace liana::bench
