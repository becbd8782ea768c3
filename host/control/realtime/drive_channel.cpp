#include "host/control/realtime/drive_channel.hpp"

#include <algorithm>
#include <cmath>

#include "firmware_like/drive/cia402.hpp"
#include "firmware_like/drive/pdo.hpp"
#include "firmware_like/math/convert.hpp"
#include "firmware_like/safety/drive_link_monitor.hpp"
#include "host/drives/canopen/cob_id.hpp"

namespace liana::realtime {

namespace {

std::vector<std::string> names_of(const config::BusesConfig& buses) {
  std::vector<std::string> names;
  for (const config::BusConfig& bus : buses.buses) names.push_back(bus.name);
  return names;
}

// How long a bus on which nobody is heard still gets its commands: long enough for a quick stop to arrive. Then silence
// makes drives that hear us but act on nothing (without SYNC they do not) stop by themselves, and no old command waits
// in a queue for the bus to come back.
constexpr std::uint16_t kFarewellTicks = 25;

// What a clear waits for drives that have to be booted again: a reset of 3 s, and the boot.
constexpr double kBringBack_s = 5.0;

// Ticks that were lost made everything older, too.
std::uint16_t older(std::uint16_t age, const timing::TickStart& start) {
  return narrow<std::uint16_t>(static_cast<std::uint64_t>(age) + 1 + start.lost_ticks);
}

void fill_command(bool is_cst, const DriveCommand& command, bus::CanFrame& frame) {
  const auto put = [&frame](const auto& bytes) {
    frame.length = static_cast<std::uint8_t>(bytes.size());
    std::copy(bytes.begin(), bytes.end(), frame.data.begin());
  };
  if (is_cst) {
    put(encode_torque_rpdo1(command));
  } else {
    put(encode_rpdo1(command));
  }
}

bool is_out(bus::BusState state) { return state == bus::BusState::kDown || state == bus::BusState::kBusOff; }

}  // namespace

DriveChannel::DriveChannel(const std::vector<canopen::ExpectedDrive>& drives, const config::BusesConfig& buses,
                           bus::DriveBus& bus)
    : bus_(bus),
      drives_(drives),
      bus_names_(names_of(buses)),
      master_(drives_, buses),
      sensor_line_(buses),
      max_bring_back_ticks_(static_cast<std::uint32_t>(std::lround(kBringBack_s * buses.rate_hz))) {
  for (auto& nodes : drives_of_node_)
    for (DrivesOfNode& axes : nodes) axes.fill(-1);
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    drives_of_node_[static_cast<std::size_t>(drives_[i].bus)][drives_[i].node][drives_[i].axis - 1U] =
        static_cast<int>(i);
    has_drives_[static_cast<std::size_t>(drives_[i].bus)] = true;
  }
  for (const config::BusConfig& each : buses.buses) {
    for (const config::LoadCellNode& node : each.load_cells) {
      for (const std::size_t cable : node.cables) {
        if (cable < has_cell_.size()) has_cell_[cable] = true;
      }
    }
  }
}

// Everything that came in since the last tick; what did not come grows older.
void DriveChannel::collect(const timing::TickStart& start, CycleInputs& inputs) noexcept {
  inputs.tick = start.tick;
  inputs.lost_ticks = start.lost_ticks;
  inputs.request = Request::kNone;
  for (std::size_t i = 0; i < drives_.size(); ++i)
    inputs.drive[i].feedback_age_ticks = older(inputs.drive[i].feedback_age_ticks, start);
  for (std::uint16_t& ticks : silent_ticks_) ticks = older(ticks, start);
  sensor_line_.begin_tick(start.lost_ticks);
  bus::ReceivedFrame received;
  while (bus_.receive(received)) {
    sensor_line_.on_frame(received.bus, received.frame);
    if (master_.on_frame(received.bus, received.frame, start.tick)) continue;
    take_rate(received.bus, received.frame, inputs);
    const canopen::FrameRoute route = canopen::route(received.frame.id);
    const int drive = drive_at(received.bus, route);
    if (drive < 0) continue;
    if (route.kind == canopen::FrameKind::kRpdo1) voices_[static_cast<std::size_t>(drive)].is_another = true;
    if (route.kind == canopen::FrameKind::kTpdo1)
      take_report(received.bus, static_cast<std::size_t>(drive), received.frame, inputs);
  }
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    inputs.drive[i].heartbeat_age_ticks = narrow<std::uint16_t>(master_.heartbeats().age_ticks(drives_[i].node));
    const bool operational = master_.heartbeats().state(drives_[i].node) == canopen::kStateOperational;
    const bool other_mode = (master_.modes().other_mode() >> i & 1u) != 0;
    inputs.drive[i].operational = !operational ? std::uint8_t{0} : other_mode ? kInOtherMode : std::uint8_t{1};
    const bool enabled =
        inputs.drive[i].feedback_age_ticks == 0 && decode(inputs.drive[i].statusword) == DriveState::kOperationEnabled;
    in_operation_ = enabled ? in_operation_ | 1u << i : in_operation_ & ~(1u << i);
  }
  take_emergencies(inputs);
  inputs.lost_bus_mask = lost_buses();
  inputs.twice_mask = drives_heard_twice(start);
}

// TPDO2, of torque drives only.
void DriveChannel::take_rate(int bus, const bus::CanFrame& frame, CycleInputs& inputs) noexcept {
  const std::uint32_t page = frame.id & ~0x7FU;
  if (page != kTpdo2Base && page != kTpdo2Base + canopen::kAxisCobIds) return;
  const auto node = static_cast<std::uint8_t>(frame.id & 0x7F);
  const int drive =
      drive_at(bus, {canopen::FrameKind::kOther, node, page == kTpdo2Base ? std::uint8_t{1} : std::uint8_t{2}});
  if (drive < 0 || !drives_[static_cast<std::size_t>(drive)].type.is_cst) return;
  (void)decode_tpdo2({frame.data.data(), frame.length}, inputs.drive[static_cast<std::size_t>(drive)].rate_counts_s);
}

void DriveChannel::take_report(int bus, std::size_t drive, const bus::CanFrame& frame, CycleInputs& inputs) noexcept {
  Tpdo1 report;
  if (!decode_tpdo1({frame.data.data(), frame.length}, report, drives_[drive].type.has_torque)) return;
  DriveFeedback& feedback = inputs.drive[drive];
  feedback.statusword = report.statusword;
  feedback.position_counts = report.position_counts;
  feedback.torque_permille = report.torque_permille;
  feedback.feedback_age_ticks = 0;
  silent_ticks_[static_cast<std::size_t>(bus)] = 0;
  Voices& voices = voices_[drive];
  if (voices.report && *voices.report != frame.data) voices.is_another = true;
  voices.report = frame.data;
}

// A frame that comes twice says the same twice, and one that is late comes with the next once: only two voices differ
// in tick after tick. After lost ticks several reports are due.
std::uint32_t DriveChannel::drives_heard_twice(const timing::TickStart& start) noexcept {
  std::uint32_t mask = 0;
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    Voices& voices = voices_[i];
    const bool counts = voices.is_another && start.lost_ticks == 0;
    voices.ticks = counts ? std::min(narrow<std::uint16_t>(voices.ticks + 1U), kTwiceTicks) : 0;
    if (voices.ticks == kTwiceTicks) mask |= 1u << i;
    voices.report.reset();
    voices.is_another = false;
  }
  return mask;
}

// An interface that is up proves nothing: with its cable off it goes on sending to nobody. A bus is also lost when none
// of its drives is heard any more, as soon as one of them would be silent.
std::uint32_t DriveChannel::lost_buses() const noexcept {
  std::uint32_t mask = 0;
  for (int b = 0; b < bus_.bus_count(); ++b) {
    const bool is_silent =
        has_drives_[static_cast<std::size_t>(b)] && silent_ticks_[static_cast<std::size_t>(b)] > kFeedbackAgeTicks;
    if (is_silent || is_out(bus_.stats(b).state)) mask |= 1u << b;
  }
  return mask;
}

void DriveChannel::take_emergencies(CycleInputs& inputs) noexcept {
  for (std::size_t i = 0; i < drives_.size(); ++i) inputs.drive[i].emergency_code = 0;
  canopen::Emergency emergency;
  while (master_.emergencies().take(emergency)) {
    // It says no axis (CiA 301): it counts for all of the node.
    for (const int drive : drives_of_node_[static_cast<std::size_t>(emergency.bus)][emergency.node])
      if (drive >= 0) inputs.drive[static_cast<std::size_t>(drive)].emergency_code = emergency.code;
  }
}

void DriveChannel::command(const DriveCommands& commands) noexcept {
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    if (silent_ticks_[static_cast<std::size_t>(drives_[i].bus)] > kFarewellTicks) continue;
    bus::CanFrame frame;
    frame.id = drives_[i].command_id();
    fill_command(drives_[i].type.is_cst, commands[i], frame);
    bus_.send(drives_[i].bus, frame);
  }
}

BootPhase DriveChannel::boot_phase() const noexcept {
  const canopen::BootState boot = master_.boot().state();
  if (boot == canopen::BootState::kRunning) return BootPhase::kBooting;
  return boot == canopen::BootState::kOperational ? BootPhase::kDone : BootPhase::kFailed;
}

void DriveChannel::step_master() noexcept {
  master_.step(bus_, in_operation_);
  const canopen::BootState before = boot_seen_;
  boot_seen_ = master_.boot().state();
  if (boot_seen_ == canopen::BootState::kFailed && before != boot_seen_) publish_refusals();
}

void DriveChannel::publish_refusals() noexcept {
  BootRefusals& draft = refusals_.draft();
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    BootRefusals::OfDrive& own = draft.drive[i];
    own.count = 0;
    for (const canopen::BootMismatch& mismatch : master_.boot().mismatches(i))
      if (std::max<int>(mismatch.axis, 1) == drives_[i].axis) own.mismatch[own.count++] = mismatch;
    own.more = master_.boot().more_mismatches(i);
  }
  refusals_.publish();
}

bool DriveChannel::reboot_lost_drives(const CycleInputs& inputs) noexcept {
  const bool goes_on = bring_back_tick_ != 0 && inputs.tick == bring_back_tick_ + 1;
  bring_back_tick_ = inputs.tick;
  if (!goes_on) {
    bring_back_ticks_ = 0;
    for (std::size_t i = 0; i < drives_.size(); ++i)
      master_.recover(i, drives_[i].node, inputs.drive[i].feedback_age_ticks <= kFeedbackAgeTicks);
  }
  return master_.boot().state() != canopen::BootState::kRunning || ++bring_back_ticks_ >= max_bring_back_ticks_;
}

std::vector<BootProblem> DriveChannel::boot_problems() {
  refusals_.refresh();
  std::vector<BootProblem> problems;
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    const BootRefusals::OfDrive& refused = refusals_.value().drive[i];
    if (refused.count == 0) continue;
    const canopen::BootFailure last = refused.mismatch[refused.count - 1].failure;
    const bool missing = last == canopen::BootFailure::kNoBootUp || last == canopen::BootFailure::kNoAnswer;
    const std::string who = refused.mismatch[0].axis == 0 ? names_of_node(i) : canopen::name_of(drives_[i]);
    problems.push_back({static_cast<int>(i), missing ? FaultNumber::kDriveMissing : FaultNumber::kDriveNotOperational,
                        canopen::describe({refused.mismatch.data(), refused.count}, refused.more,
                                          who + " on " + bus_names_[static_cast<std::size_t>(drives_[i].bus)])});
  }
  return problems;
}

// Every axis of the node of a drive that is its first.
std::string DriveChannel::names_of_node(std::size_t drive) const {
  std::string text;
  const std::size_t end = drive + canopen::axes_of_first(std::span(drives_).subspan(drive));
  for (std::size_t i = drive; i < end; ++i) text += (text.empty() ? "" : " and ") + canopen::name_of(drives_[i]);
  return text;
}

std::vector<std::string> DriveChannel::unwatched() const {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    const std::string name = canopen::name_of(drives_[i]);
    if (!drives_[i].type.has_torque) {
      lines.push_back(name + (has_cell_[i] ? ": reports no torque: the tension of its cable is by its load cell alone"
                                           : ": reports no torque and has no load cell: the tension of its cable is "
                                             "taken as planned, and slack, overload, slip, break and contact (5001 to "
                                             "5003, 5005 to 5009) are not watched"));
    }
    const bool has_mode = master_.boot().has(i, {canopen::kModeDisplay, 0});
    if (!has_mode) lines.push_back(name + ": has no 6061: whether it stays in its mode is not watched");
    if (has_mode && master_.modes().bus_is_full(i)) {
      lines.push_back(name +
                      ": its bus has no room to ask for 6061 (max_load): whether it stays in its mode is not "
                      "watched");
    }
  }
  return lines;
}

std::vector<std::uint32_t> DriveChannel::serials() const {
  std::vector<std::uint32_t> out;
  for (std::size_t i = 0; i < drives_.size(); ++i) out.push_back(master_.boot().serial(i));
  return out;
}

}  // namespace liana::realtime
