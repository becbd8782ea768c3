#include "host/drives/commissioning/jog_run.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "firmware_like/drive/cia402.hpp"
#include "firmware_like/drive/pdo.hpp"
#include "host/drives/canopen/messages.hpp"

namespace liana::commissioning {
namespace {

constexpr double kTell_s = 0.1;
constexpr std::int8_t kModeCsp = 8;
constexpr std::uint16_t kNeverHeard = 0xFFFF;  // ticks

}  // namespace

JogRun::JogRun(Desk& desk, const canopen::ExpectedDrive& drive)
    : desk_(desk),
      drive_(drive),
      node_(drive, canopen::boot_timing(desk.rate_hz(), drive.type.times)),
      heartbeat_(drive.heartbeat_ms, desk.rate_hz()),
      sdo_(drive.node, static_cast<std::uint32_t>(desk.ticks(kAnswer_s))) {}

JogRun::~JogRun() {
  const auto nothing = [](const bus::ReceivedFrame&) {};
  const auto reset = [this] {
    desk_.bus().send(drive_.bus, canopen::nmt_frame(canopen::kNmtResetCommunication, drive_.node));
  };
  try {
    desk_.exchange(Desk::Tick::kQuiet, nothing, reset);
    desk_.exchange(Desk::Tick::kQuiet, nothing, [] {});  // it is on the wire before the bus is closed
  } catch (const std::runtime_error&) {                  // the bus has gone, and with it the heartbeat
  }
}

const canopen::BootNode& JogRun::boot() {
  using canopen::NodePhase;
  const auto take = [this](const bus::ReceivedFrame& received) {
    if (is_from_drive(received, canopen::FrameKind::kSdoResponse)) node_.on_sdo_response(received.frame);
    if (is_from_drive(received, canopen::FrameKind::kHeartbeat)) node_.on_heartbeat(received.frame);
  };
  const auto send = [this] {
    heartbeat_.step(desk_.bus());
    node_.allow_start();
    bus::CanFrame frame;
    if (node_.step(frame)) node_.sent(desk_.bus().send(drive_.bus, frame) == bus::SendResult::kOk);
  };
  while (node_.phase() != NodePhase::kOperational && node_.phase() != NodePhase::kFailed) {
    desk_.refuse_when_interrupted();
    desk_.exchange(Desk::Tick::kQuiet, take, send);
  }
  return node_;
}

bool JogRun::is_from_drive(const bus::ReceivedFrame& received, canopen::FrameKind kind) const {
  const canopen::FrameRoute from = canopen::route(received.frame.id);
  return received.bus == drive_.bus && from.node == drive_.node && from.kind == kind &&
         (kind != canopen::FrameKind::kTpdo1 || from.axis == drive_.axis);
}

void JogRun::on_frame(const bus::ReceivedFrame& received) {
  const bus::CanFrame& frame = received.frame;
  if (is_from_drive(received, canopen::FrameKind::kTpdo1)) on_report(frame);
  if (is_from_drive(received, canopen::FrameKind::kEmergency)) on_emergency(frame);
  if (is_from_drive(received, canopen::FrameKind::kSdoResponse)) sdo_.on_response(frame);
  if (is_from_drive(received, canopen::FrameKind::kHeartbeat) && frame.length == 1) {
    seen_.heartbeat_age_ticks = 0;
    is_operational_ = (frame.data[0] & canopen::kNmtStateMask) == canopen::kStateOperational;
  }
}

void JogRun::on_report(const bus::CanFrame& frame) {
  Tpdo1 report;
  if (!decode_tpdo1({frame.data.data(), frame.length}, report, drive_.type.has_torque)) return;
  seen_.statusword = report.statusword;
  seen_.position_counts = report.position_counts;
  seen_.torque_permille = report.torque_permille;
  seen_.feedback_age_ticks = 0;
  max_torque_permille_ = std::max(max_torque_permille_, std::abs(std::int32_t{report.torque_permille}));
}

void JogRun::on_emergency(const bus::CanFrame& frame) {
  if (frame.length != 8) return;
  const auto code = static_cast<std::uint16_t>(canopen::get_u32(frame.data.data(), 2));
  if (code == 0) return;  // an error that has gone
  seen_.emergency_code = code;
  if (first_emergency_ == 0) first_emergency_ = code;
}

// SYNC, what came since, the command.
void JogRun::cycle(Jog& jog) {
  for (std::uint16_t* age : {&seen_.feedback_age_ticks, &seen_.heartbeat_age_ticks})
    if (*age < kNeverHeard) ++*age;
  seen_.emergency_code = 0;
  const auto send = [&] {
    take_answer();
    const bool other_mode = mode_ && *mode_ != kModeCsp;
    seen_.operational = !is_operational_ ? std::uint8_t{0} : other_mode ? kInOtherMode : std::uint8_t{1};
    heartbeat_.step(desk_.bus());
    bus::CanFrame command{drive_.command_id(), kRpdo1Bytes, {}, 0};
    const std::array<std::uint8_t, kRpdo1Bytes> data = encode_rpdo1(jog.step(seen_));
    std::copy(data.begin(), data.end(), command.data.begin());
    const bool knows_place = seen_.feedback_age_ticks != kNeverHeard;  // before, there is no target
    if (knows_place) desk_.bus().send(drive_.bus, command);
    sdo_.tick();
    bus::CanFrame request;
    if (sdo_.take_request(request)) desk_.bus().send(drive_.bus, request);
  };
  desk_.exchange(
      Desk::Tick::kCyclic, [this](const bus::ReceivedFrame& received) { on_frame(received); }, send);
}

void JogRun::take_answer() {
  using canopen::SdoStatus;
  if (sdo_.status() == SdoStatus::kBusy) return;
  const bool is_done = sdo_.status() == SdoStatus::kDone, is_refused = sdo_.status() == SdoStatus::kAborted;
  if (asked_ == Asked::kCurrent && is_done) current_permille_ = static_cast<std::int16_t>(sdo_.value());
  if (asked_ == Asked::kCurrent && is_refused) has_current_ = false;
  if (asked_ == Asked::kMode && is_done) mode_ = static_cast<std::int8_t>(sdo_.value());
  if (asked_ == Asked::kMode && is_refused) has_mode_ = false;
  asked_ = Asked::kNothing;
}

// The mode again and again while the drive has power; its current in between.
void JogRun::ask_next(bool wants_current) {
  take_answer();
  if (sdo_.status() == canopen::SdoStatus::kBusy) return;
  const bool is_enabled = decode(seen_.statusword) == DriveState::kOperationEnabled;
  if (!is_enabled) mode_.reset();
  if (has_current_ && wants_current) {
    asked_ = Asked::kCurrent;
    sdo_.start_upload(canopen::on_axis(0x6078, drive_.axis), 0);
  } else if (has_mode_ && is_enabled) {
    asked_ = Asked::kMode;
    sdo_.start_upload(canopen::on_axis(canopen::kModeDisplay, drive_.axis), 0);
  }
}

// A drive in Fault without an emergency message, or from before: 603F has its code.
void JogRun::ask_error_code(Jog& jog) {
  while (sdo_.status() == canopen::SdoStatus::kBusy) cycle(jog);
  asked_ = Asked::kNothing;
  sdo_.start_upload(canopen::on_axis(0x603F, drive_.axis), 0);
  do cycle(jog);
  while (sdo_.status() == canopen::SdoStatus::kBusy);
  if (sdo_.status() == canopen::SdoStatus::kDone) first_emergency_ = static_cast<std::uint16_t>(sdo_.value());
}

JogOutcome JogRun::jog(const JogRequest& request, const std::function<void(const JogSample&)>& tell) {
  Jog jog(request, desk_.rate_hz());
  seen_ = {};
  seen_.heartbeat_age_ticks = 0;
  is_operational_ = true;  // as its last heartbeat said
  first_emergency_ = 0;
  const std::uint64_t tell_ticks = desk_.ticks(kTell_s);
  bool has_stopped = false;
  for (std::uint64_t tick = 0; !jog.is_over(); ++tick) {
    ask_next(tick % tell_ticks == 0);
    cycle(jog);
    if (desk_.is_interrupted() && !has_stopped) jog.interrupt();
    has_stopped = desk_.is_interrupted();
    if (tick % tell_ticks != 0) continue;
    if (seen_.feedback_age_ticks == 0)
      tell({static_cast<double>(tick) / desk_.rate_hz(), seen_, jog.moved_counts(), current_permille_});
  }
  const bool is_off = jog.is_off();
  const bool has_fault = jog.end() == JogResult::kFault || jog.end() == JogResult::kFaultBefore;
  if (has_fault && first_emergency_ == 0) ask_error_code(jog);
  return {jog.end(),          is_off,
          jog.was_enabled(),  jog.start_counts(),
          jog.moved_counts(), max_torque_permille_,
          seen_.statusword,   first_emergency_};
}

}  // namespace liana::commissioning
