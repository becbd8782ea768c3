#include "host/drives/canopen/mode_monitor.hpp"

#include <algorithm>

#include "host/drives/bus/bus_load.hpp"
#include "host/drives/bus/frame_bits.hpp"
#include "host/drives/canopen/cob_id.hpp"

namespace liana::canopen {
namespace {

constexpr std::uint16_t kSettledTicks = 3;  // in Operation enabled, before its mode is looked at
constexpr double kAnswer_s = 0.5;

bool has_room(const config::BusesConfig& buses, std::size_t b) {
  if (b >= buses.buses.size()) return false;
  const auto drives = static_cast<int>(buses.buses[b].nodes.size());
  return bus::worst_load_with_sdo(buses, b) + mode_bits_per_s(drives, buses.rate_hz) / buses.buses[b].bitrate <=
         buses.max_load;
}

constexpr std::uint32_t bit(std::size_t drive) { return 1U << drive; }

}  // namespace

double mode_bits_per_s(int drives, double rate_hz) {
  return 2.0 * drives * rate_hz / kModeRoundTicks * bus::worst_frame_bits(8);
}

ModeMonitor::ModeMonitor(const std::vector<ExpectedDrive>& drives, const config::BusesConfig& buses) {
  const auto answer_ticks = static_cast<std::uint32_t>(std::max(2.0, kAnswer_s * buses.rate_hz));
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const ExpectedDrive& drive = drives[i];
    const auto b = static_cast<std::size_t>(drive.bus);
    Asked asked{.bus = drive.bus, .node = drive.node, .axis = drive.axis, .sdo = {drive.node, answer_ticks}};
    asked.shares_node = std::any_of(drives.begin(), drives.end(), [&](const ExpectedDrive& other) {
      return other.node == drive.node && other.axis != drive.axis;
    });
    asked.mode = drive.type.is_cst ? 10 : 8;
    asked.bus_is_full = !has_room(buses, b);
    asked.is_asked = !asked.bus_is_full && drive.type.rule_of({kModeDisplay, 0}).presence != config::Presence::kAbsent;
    drives_.push_back(asked);
    if (asked.is_asked) rounds_[b].drives.push_back(i);
  }
}

void ModeMonitor::step(bus::DriveBus& bus, std::uint32_t in_operation) noexcept {
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    Asked& drive = drives_[i];
    drive.sdo.tick();
    if ((in_operation & bit(i)) != 0) {
      if (drive.enabled_ticks < kSettledTicks) ++drive.enabled_ticks;
    } else {
      drive.enabled_ticks = 0;
      drive.counts = drive.was_passed = false;
      other_ &= ~bit(i);
    }
  }
  for (Round& round : rounds_) {
    round.credit = std::min(round.credit + round.drives.size(), round.drives.size() + kModeRoundTicks);
    while (round.credit >= kModeRoundTicks && !round.drives.empty()) {
      round.credit -= kModeRoundTicks;
      ask_next(round, bus);
    }
  }
}

// A node has one SDO server: while one of its axes is asked, the others have to wait, and whoever has waited takes the
// next turn of the node. Whose turn it is when drive i is due.
std::size_t ModeMonitor::axis_to_ask(std::size_t i) noexcept {
  std::size_t next = i;
  if (!drives_[i].shares_node || drives_[i].sdo.status() == SdoStatus::kBusy) return i;
  for (std::size_t k = 0; k < drives_.size(); ++k) {
    const Asked& other = drives_[k];
    if (k == i || other.node != drives_[i].node) continue;
    if (other.sdo.status() == SdoStatus::kBusy) {
      drives_[i].was_passed = true;
      return k;
    }
    if (other.was_passed) next = k;
  }
  return next;
}

bool ModeMonitor::may_ask(const Asked& drive) noexcept {
  return drive.is_asked && drive.enabled_ticks >= kSettledTicks;
}

void ModeMonitor::ask_next(Round& round, bus::DriveBus& bus) noexcept {
  const std::size_t due = round.drives[round.next];
  round.next = (round.next + 1) % round.drives.size();
  if (!may_ask(drives_[due])) return;
  Asked& drive = drives_[axis_to_ask(due)];
  if (!may_ask(drive)) return;
  bus::CanFrame frame;
  if (drive.sdo.status() != SdoStatus::kBusy) {
    drive.sdo.start_upload(on_axis(kModeDisplay, drive.axis), 0);
    drive.counts = true;
    drive.was_passed = false;
  }
  while (drive.sdo.take_request(frame)) bus.send(drive.bus, frame);
}

void ModeMonitor::on_frame(int bus, const bus::CanFrame& frame) noexcept {
  const FrameRoute from = route(frame.id);
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    Asked& drive = drives_[i];
    if (drive.bus != bus || drive.node != from.node || drive.sdo.status() != SdoStatus::kBusy) continue;
    drive.sdo.on_response(frame);
    if (drive.sdo.status() != SdoStatus::kBusy) take_answer(i);
  }
}

void ModeMonitor::take_answer(std::size_t i) noexcept {
  Asked& drive = drives_[i];
  if (drive.sdo.status() == SdoStatus::kAborted && drive.sdo.abort_code() == kAbortNoObject) drive.is_asked = false;
  if (drive.sdo.status() != SdoStatus::kDone || !drive.counts) return;
  const bool is_other = static_cast<std::int8_t>(drive.sdo.value()) != drive.mode;
  other_ = is_other ? other_ | bit(i) : other_ & ~bit(i);
}

}  // namespace liana::canopen
