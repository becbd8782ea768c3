#include "hil/bench/drives.hpp"

namespace liana::bench {

namespace {

// Kinds that happen to a node, and so to each of its axes.
bool is_of_node(FaultKind kind) {
  switch (kind) {
    case FaultKind::kMissing:
    case FaultKind::kWrongIdentityAfterReboot:
    case FaultKind::kWrongIdentity:
    case FaultKind::kSilent:
    case FaultKind::kReboot:
    case FaultKind::kSlowReset:
    case FaultKind::kSlowSdo:
      return true;
    default:
      return false;
  }
}

std::uint64_t microseconds(double seconds) { return static_cast<std::uint64_t>(1e6 * seconds); }

}  // namespace

Drives::Drives(std::uint32_t product, std::uint64_t seed) : product_(product), fault_noise_(seed, "fault noise") {}

void Drives::add(const DriveSettings& settings, double start_counts) {
  drives_.push_back(std::make_unique<Drive>(settings, start_counts));
  noise_.emplace_back();
}

void Drives::exchange(const FrameList& frames, std::uint64_t now_us, FrameList& out) {
  for (const CanFrame& frame : frames)
    for (auto& drive : drives_)
      if (drive->bus() == frame.bus) drive->receive(frame, out);
  for (auto& drive : drives_) drive->tick(now_us, out);
}

void Drives::set_measured(std::size_t i, double permille) {
  double error_counts = 0.0;
  if (noise_[i].permille > 0.0) permille += fault_noise_.gaussian(noise_[i].permille);
  if (noise_[i].counts > 0.0) error_counts = fault_noise_.gaussian(noise_[i].counts);
  drives_[i]->set_measured(permille, error_counts);
}

std::size_t Drives::enabled() const {
  std::size_t count = 0;
  for (const auto& drive : drives_) count += drive->power_state() == PowerState::kOperationEnabled ? 1 : 0;
  return count;
}

std::vector<std::size_t> Drives::affected(const FaultConfig& fault, std::size_t i) const {
  if (!is_of_node(fault.kind)) return {i};
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < drives_.size(); ++k)
    if (drives_[k]->bus() == drives_[i]->bus() && drives_[k]->node() == drives_[i]->node()) out.push_back(k);
  return out;
}

void Drives::begin(const FaultConfig& fault, std::size_t i) {
  for (const std::size_t each : affected(fault, i)) begin_at(fault, each);
}

void Drives::end(const FaultConfig& fault, std::size_t i) {
  for (const std::size_t each : affected(fault, i)) end_at(fault, each);
}

void Drives::begin_at(const FaultConfig& fault, std::size_t i) {
  Drive& drive = *drives_[i];
  const FaultParameters& with = fault.parameters;
  const auto code = static_cast<std::uint16_t>(with.code);
  switch (fault.kind) {
    case FaultKind::kMissing:
      return drive.power_off();
    case FaultKind::kWrongIdentityAfterReboot:
      drive.power_off();
      drive.set_identity(product_ + 1);
      return drive.power_on();
    case FaultKind::kWrongIdentity:
      return drive.set_identity(product_ + 1);
    case FaultKind::kSilent:
      drive.defects().silent = true;
      return;
    case FaultKind::kFault:
      return drive.raise_fault(code);
    case FaultKind::kSto:
      return drive.set_safe_torque_off();
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
    case FaultKind::kNoReports:
      drive.defects().no_reports = true;
      return;
    case FaultKind::kNodeTwice:
      drive.defects().twice = true;
      return;
    case FaultKind::kOtherMode:
      drive.defects().mode = static_cast<std::int8_t>(with.mode);
      return;
    case FaultKind::kSlowReset:
      drive.defects().reset_us = microseconds(with.seconds);
      return;
    case FaultKind::kSlowPower:
      drive.defects().power_us = microseconds(with.seconds);
      return;
    case FaultKind::kSlowSdo:
      drive.defects().sdo_us = microseconds(with.seconds);
      return;
    case FaultKind::kEncoderJump:
      return drive.jump_encoder(with.counts);
    default:
      return begin_behind(fault, i);
  }
}

void Drives::end_at(const FaultConfig& fault, std::size_t i) {
  DriveDefects& defects = drives_[i]->defects();
  const DriveDefects none;
  switch (fault.kind) {
    case FaultKind::kMissing:
      return drives_[i]->power_on();
    case FaultKind::kSilent:
      defects.silent = none.silent;
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
    case FaultKind::kNoReports:
      defects.no_reports = none.no_reports;
      return;
    case FaultKind::kNodeTwice:
      defects.twice = none.twice;
      return;
    case FaultKind::kOtherMode:
      drives_[i]->leave_other_mode();
      return;
    case FaultKind::kSlowReset:
      defects.reset_us = none.reset_us;
      return;
    case FaultKind::kSlowPower:
      defects.power_us = none.power_us;
      return;
    case FaultKind::kSlowSdo:
      defects.sdo_us = none.sdo_us;
      return;
    default:
      return end_behind(fault, i);
  }
}

}  // namespace liana::bench
