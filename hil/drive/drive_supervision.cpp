// The part of a drive that decides about power: CiA 402 commands, faults, lost connections, following error.
#include <algorithm>
#include <cmath>

#include "hil/drive/drive.hpp"

namespace liana::bench {

namespace {

constexpr std::uint16_t kHeartbeatLost = 0x8130;
constexpr std::uint16_t kTargetsLost = 0x8250;
constexpr std::uint16_t kFollowingError = 0x8611;
constexpr std::uint16_t kSafeTorqueOff = 0xFF01;  // vendor code
constexpr std::uint8_t kGenericError = 0x01;
constexpr std::uint8_t kCommunicationError = 0x10;

}  // namespace

// ---- power
// --------------------------------------------------------------------------------------------------------------------

void Drive::act_on_controlword(std::uint16_t controlword) {
  const bool reset_edge = (controlword & 0x80) != 0 && (controlword_ & 0x80) == 0;
  controlword_ = controlword;
  if (power_ == PowerState::kFault) {
    if (!reset_edge) return;
    objects_.set(0x603F, 0, 0);
    objects_.set(0x1001, 0, 0);
    emergencies_.push_back(0);
    return enter_power(PowerState::kSwitchOnDisabled);
  }
  if (safe_torque_off_) return;
  const PowerState next = next_state(power_, decode_command(controlword));
  const bool mode_missing = next == PowerState::kOperationEnabled && !mode_allows_power();
  if (mode_missing) return;
  lead_to(next);
}

// Towards Operation enabled a drive may take its time; back it goes at once.
void Drive::lead_to(PowerState state) {
  const bool is_slow = defects_.power_us != 0 && state > power_ && state <= PowerState::kOperationEnabled;
  if (!is_slow || state == power_) transition_.reset();
  if (state == power_) return;
  if (!is_slow) return enter_power(state);
  if (!transition_ || transition_->to != state) transition_ = Slow{state, now_us_ + defects_.power_us};
}

void Drive::enter_power(PowerState state) {
  power_ = state;
  transition_.reset();
  following_error_ = false;
  following_since_us_ = now_us_;
  switch (state) {
    case PowerState::kOperationEnabled:
      objects_.set(0x6061, 0, objects_.get(0x6060));  // a torque stop has left it at position control
      if (objects_.get(0x6061) != kCyclicSynchronousTorque) return motor_.set_mode(MotorMode::kFollow);
      torque_loop_.reset();
      return motor_.set_mode(MotorMode::kTorque);
    case PowerState::kQuickStopActive:
      ++counts_.quick_stops;
      [[fallthrough]];
    case PowerState::kFaultReactionActive:
      if (is_torque_controlled()) return begin_torque_stop();
      motor_.set_deceleration(static_cast<double>(objects_.get(0x6085)) * settings_.counts_per_speed_unit());
      return motor_.set_mode(MotorMode::kRamp);
    default:
      if (is_torque_controlled()) end_torque();
      return motor_.set_mode(MotorMode::kBraked);
  }
}

// Quick stop when moving, switch-on disabled when only switched on.
void Drive::stop_by_itself() {
  if (power_ == PowerState::kOperationEnabled) return enter_power(PowerState::kQuickStopActive);
  if (power_ == PowerState::kReadyToSwitchOn || power_ == PowerState::kSwitchedOn)
    enter_power(PowerState::kSwitchOnDisabled);
}

void Drive::raise_fault(std::uint16_t emergency_code) {
  if (power_ == PowerState::kFault || power_ == PowerState::kFaultReactionActive) return;
  objects_.set(0x603F, 0, emergency_code);
  objects_.set(0x1001, 0, objects_.get(0x1001) | kGenericError);
  emergencies_.push_back(emergency_code);
  enter_power(PowerState::kFaultReactionActive);
}

void Drive::set_safe_torque_off() {
  if (safe_torque_off_) return;
  safe_torque_off_ = true;
  emergencies_.push_back(kSafeTorqueOff);
  if (power_ != PowerState::kFault) enter_power(PowerState::kSwitchOnDisabled);
}

void Drive::power_off() {
  dead_ = true;
  reset_at_us_.reset();
  answers_.clear();
  enter_power(PowerState::kSwitchOnDisabled);
}

void Drive::power_on() {
  dead_ = false;
  objects_ = make_objects(settings_);
  controlword_ = 0;
  emergencies_.clear();
  rebuild_pdos();
  sample();
  objects_.set(0x607A, 0, objects_.get(0x6064));
  nmt_ = NmtState::kInitialising;
}

void Drive::set_identity(std::uint32_t product) {
  settings_.product = product;
  objects_.set(0x1018, 2, product);
}

void Drive::set_measured(double permille, double position_error_counts) {
  measured_permille_ = permille;
  position_error_counts_ = position_error_counts;
}

// ---- time
// ---------------------------------------------------------------------------------------------------------------------

void Drive::connection_lost(std::uint16_t code, FrameList& out) {
  connection_lost_ = true;
  objects_.set(0x1001, 0, objects_.get(0x1001) | kGenericError | kCommunicationError);
  send_emergency(code, out);
  stop_by_itself();
}

// 0x1029:1 (CiA 301, 7.5.2.32); without it, as with 0.
void Drive::behave_on_lost_heartbeat() {
  const Object* object = objects_.find(0x1029, 1);
  const std::int64_t behaviour = object == nullptr ? 0 : object->value;
  if (behaviour == 0 && nmt_ == NmtState::kOperational) enter_nmt(NmtState::kPreOperational);
  if (behaviour == 2) enter_nmt(NmtState::kStopped);
}

void Drive::connection_back(FrameList& out) {
  const std::uint64_t allowed_us = 1000 * static_cast<std::uint64_t>(objects_.get(0x1016, 1) & 0xFFFF);
  if (allowed_us != 0 && now_us_ - master_.last_us > allowed_us) return;  // only half of it is back
  connection_lost_ = false;
  const bool is_fault = power_ == PowerState::kFault || power_ == PowerState::kFaultReactionActive;
  objects_.set(0x1001, 0, is_fault ? kGenericError : 0);
  send_emergency(0, out);
}

void Drive::supervise_following(std::uint64_t now_us) {
  const double window = static_cast<double>(objects_.get(0x6065));
  const double error =
      std::fabs(static_cast<double>(objects_.get(0x607A)) - encoder_offset_counts_ - motor_.position_counts());
  if (power_ != PowerState::kOperationEnabled || is_torque_controlled() || error <= window) {
    following_since_us_ = now_us;
    following_error_ = false;
    return;
  }
  following_error_ = true;
  if (now_us - following_since_us_ >= 1000 * static_cast<std::uint64_t>(objects_.get(0x6066)))
    raise_fault(kFollowingError);
}

void Drive::tick(std::uint64_t now_us, FrameList& out) {
  if (dead_) return;
  now_us_ = std::max(now_us_, now_us);
  const bool has_power_now = nmt_ == NmtState::kInitialising && !reset_at_us_;
  if (has_power_now) reset_at_us_ = now_us_ + settings_.dictionary.reset_us;
  if (reset_at_us_ && now_us_ < *reset_at_us_) return;
  reset_at_us_.reset();
  if (nmt_ == NmtState::kInitialising) reset_communication(out);
  send_late(out);
  if (transition_ && now_us_ >= transition_->at_us) enter_power(transition_->to);

  const std::uint64_t heartbeat_us = 1000 * static_cast<std::uint64_t>(objects_.get(0x1017));
  if (heartbeat_us != 0 && now_us_ >= next_heartbeat_us_) {
    next_heartbeat_us_ = std::max(next_heartbeat_us_ + heartbeat_us, now_us_ + heartbeat_us / 2);
    send_as_node(nmt_, out);
  }
  const std::uint64_t allowed_us = 1000 * static_cast<std::uint64_t>(objects_.get(0x1016, 1) & 0xFFFF);
  if (master_.armed && allowed_us != 0 && now_us_ - master_.last_us > allowed_us) {
    master_.armed = false;
    connection_lost(kHeartbeatLost, out);
    behave_on_lost_heartbeat();
  }
  const std::uint64_t deadline_us = receive_pdos_[0].deadline_us();
  if (targets_.armed && deadline_us != 0 && now_us_ - targets_.last_us > deadline_us) {
    targets_.armed = false;
    targets_lost_ = true;
    connection_lost(kTargetsLost, out);
  }
  supervise_following(now_us_);

  const bool ramp_done = is_at_rest();
  if (power_ == PowerState::kQuickStopActive && ramp_done) enter_power(PowerState::kSwitchOnDisabled);
  if (power_ == PowerState::kFaultReactionActive && ramp_done) enter_power(PowerState::kFault);
  for (const std::uint16_t code : emergencies_) send_emergency(code, out);
  emergencies_.clear();
}

void Drive::move(double step_s, double load_permille) {
  motor_.step(step_s, load_permille,
              std::min(static_cast<double>(objects_.get(0x6072)), defects_.most_torque_permille));
}

DriveCounts Drive::counts() const {
  DriveCounts counts = counts_;
  counts.sdo_aborts = sdo_.abort_count();
  return counts;
}

}  // namespace liana::bench
