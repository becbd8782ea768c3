#include "host/control/rt_cycle.hpp"

#include <algorithm>

#include "firmware_like/drive/pdo.hpp"
#include "firmware_like/math/convert.hpp"
#include "firmware_like/safety/watchdogs.hpp"
#include "host/canopen/cob_id.hpp"
#include "host/control/tick_guard.hpp"

namespace liana {

namespace {

std::vector<std::string> names_of(const BusesConfig& buses) {
  std::vector<std::string> names;
  for (const BusConfig& bus : buses.buses) names.push_back(bus.name);
  return names;
}

// How long a bus on which nobody is heard still gets its commands: long enough for a quick stop to arrive. Then silence
// makes drives that hear us but act on nothing (without SYNC they do not) stop by themselves, and no old command waits
// in a queue for the bus to come back.
constexpr std::uint16_t kFarewellTicks = 25;

std::uint16_t older(std::uint16_t age) { return narrow<std::uint16_t>(static_cast<std::uint32_t>(age) + 1); }

bool is_out(BusState state) { return state == BusState::kDown || state == BusState::kBusOff; }

}  // namespace

RtCycle::RtCycle(const RobotConfig& robot, const BusesConfig& buses, DriveBus& bus, Link& link)
    : table_(robot.table),
      bus_(bus),
      drives_(canopen::drive_expectations(robot, buses)),
      bus_names_(names_of(buses)),
      half_period_us_(static_cast<std::uint64_t>(buses.period_us()) / 2),
      period_us_(static_cast<std::uint64_t>(buses.period_us())),
      master_(drives_, buses),
      timing_(link.timing),
      core_(robot.table, link) {
  for (auto& nodes : drive_of_node_) nodes.fill(-1);
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    drive_of_node_[static_cast<std::size_t>(drives_[i].bus)][drives_[i].node] = static_cast<std::int8_t>(i);
    has_drives_[static_cast<std::size_t>(drives_[i].bus)] = true;
  }
}

bool RtCycle::run_tick() noexcept {
  const TickStart start = bus_.begin_tick(report_.next_tick);  // the deadline
  if (start.ended) return false;
  const TickGuard nothing_allocates_from_here;
  count_overrun(start);
  bus_.write_sync();  // drives act on the targets of the last tick, and sample
  bus_.wait_feedback(static_cast<int>(drives_.size()));
  heard_us_ = bus_.now_us();
  collect(start);      // TPDOs, heartbeats, emergencies: the inputs of this tick
  master_.step(bus_);  // heartbeat out; while booting, the next SDO requests
  if (report_.boot == BootPhase::kDone) command_drives(core_.step(inputs_));
  bus_.end_tick();
  finish_tick(start);  // what the service side sees
  return true;
}

// Everything that came in since the last tick; what did not come grows older.
void RtCycle::collect(const TickStart& start) noexcept {
  inputs_.tick = start.tick;
  inputs_.lost_ticks = start.lost_ticks;
  inputs_.request = Request::kNone;
  for (std::size_t i = 0; i < drives_.size(); ++i)
    inputs_.drive[i].feedback_age_ticks = older(inputs_.drive[i].feedback_age_ticks);
  for (std::uint16_t& ticks : silent_ticks_) ticks = older(ticks);
  ReceivedFrame received;
  while (bus_.receive(received)) {
    if (master_.on_frame(received.bus, received.frame, start.tick)) continue;
    const canopen::FrameRoute route = canopen::route(received.frame.id);
    if (route.kind != canopen::FrameKind::kTpdo1) continue;
    const std::int8_t drive = drive_of_node_[static_cast<std::size_t>(received.bus)][route.node];
    Tpdo1 report;
    if (drive < 0 || !decode_tpdo1({received.frame.data.data(), received.frame.length}, report)) continue;
    DriveFeedback& feedback = inputs_.drive[static_cast<std::size_t>(drive)];
    feedback.statusword = report.statusword;
    feedback.position_counts = report.position_counts;
    feedback.torque_permille = report.torque_permille;
    feedback.feedback_age_ticks = 0;
    silent_ticks_[static_cast<std::size_t>(received.bus)] = 0;
  }
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    inputs_.drive[i].heartbeat_age_ticks = narrow<std::uint16_t>(master_.heartbeats().age_ticks(drives_[i].node));
    inputs_.drive[i].operational = master_.heartbeats().state(drives_[i].node) == canopen::kStateOperational ? 1 : 0;
  }
  take_emergencies();
  inputs_.lost_bus_mask = lost_buses();
}

// An interface that is up proves nothing: with its cable off it goes on sending to nobody. A bus is also lost when none
// of its drives is heard any more, as soon as one of them would be silent.
std::uint32_t RtCycle::lost_buses() const noexcept {
  std::uint32_t mask = 0;
  for (int b = 0; b < bus_.bus_count(); ++b) {
    const bool is_silent =
        has_drives_[static_cast<std::size_t>(b)] && silent_ticks_[static_cast<std::size_t>(b)] > kFeedbackAgeTicks;
    if (is_silent || is_out(bus_.stats(b).state)) mask |= 1u << b;
  }
  return mask;
}

void RtCycle::take_emergencies() noexcept {
  for (std::size_t i = 0; i < drives_.size(); ++i) inputs_.drive[i].emergency_code = 0;
  canopen::Emergency emergency;
  while (master_.emergencies().take(emergency)) {
    const std::int8_t drive = drive_of_node_[static_cast<std::size_t>(emergency.bus)][emergency.node];
    if (drive >= 0) inputs_.drive[static_cast<std::size_t>(drive)].emergency_code = emergency.code;
  }
}

void RtCycle::command_drives(const Outputs& outputs) noexcept {
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    if (silent_ticks_[static_cast<std::size_t>(drives_[i].bus)] > kFarewellTicks) continue;
    CanFrame frame;
    frame.id = rpdo1_cob_id(drives_[i].node);
    frame.length = kRpdo1Bytes;
    const std::array<std::uint8_t, kRpdo1Bytes> bytes = encode_rpdo1(outputs.drive[i]);
    std::copy(bytes.begin(), bytes.end(), frame.data.begin());
    bus_.send(drives_[i].bus, frame);
  }
}

// Names why deadlines were missed: the tick before took too long (its own work, or waiting for the bus), or the thread
// woke up late.
void RtCycle::count_overrun(const TickStart& start) noexcept {
  const std::uint64_t waited_us = heard_us_ - began_us_, took_us = ended_us_ - began_us_;
  began_us_ = bus_.now_us();
  if (start.lost_ticks == 0) return;
  report_.overruns.lost_ticks += start.lost_ticks;
  if (took_us < period_us_) {
    ++report_.overruns.late_wake;
  } else if (waited_us > half_period_us_ + period_us_ / 4) {
    ++report_.overruns.bus_wait;
  } else {
    ++report_.overruns.long_tick;
  }
}

// The Controller starts at the beginning of a command interval, so that recordings and twin images start there, too.
void RtCycle::finish_tick(const TickStart& start) noexcept {
  report_.next_tick = start.tick + 1;
  const bool interval_ends = report_.next_tick % static_cast<std::uint64_t>(table_.interval_ticks) == 0;
  const canopen::BootState boot = master_.boot().state();
  if (report_.boot == BootPhase::kBooting && interval_ends && boot != canopen::BootState::kRunning) {
    report_.boot = boot == canopen::BootState::kOperational ? BootPhase::kDone : BootPhase::kFailed;
  }
  for (int b = 0; b < bus_.bus_count(); ++b) report_.bus[static_cast<std::size_t>(b)] = bus_.stats(b);
  report_.inputs = inputs_;
  core_.publish(report_);
  ended_us_ = bus_.now_us();
  timing_.wakeup_us.record(start.lateness_us);
  timing_.tick_us.record(static_cast<std::uint32_t>(ended_us_ - heard_us_));
}

std::vector<BootProblem> RtCycle::boot_problems() const {
  std::vector<BootProblem> problems;
  for (std::size_t i = 0; i < master_.boot().node_count(); ++i) {
    const canopen::BootMismatch& mismatch = master_.boot().mismatch(i);
    if (mismatch.failure == canopen::BootFailure::kNone) continue;
    const bool missing =
        mismatch.failure == canopen::BootFailure::kNoBootUp || mismatch.failure == canopen::BootFailure::kNoAnswer;
    problems.push_back({static_cast<int>(i), missing ? FaultNumber::kDriveMissing : FaultNumber::kDriveNotOperational,
                        canopen::describe(mismatch, bus_names_[static_cast<std::size_t>(mismatch.bus)])});
  }
  return problems;
}

std::vector<std::uint32_t> RtCycle::serials() const {
  std::vector<std::uint32_t> out;
  for (std::size_t i = 0; i < master_.boot().node_count(); ++i) out.push_back(master_.boot().serial(i));
  return out;
}

}  // namespace liana
