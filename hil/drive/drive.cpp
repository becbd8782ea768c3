#include "hil/drive/drive.hpp"

#include <algorithm>
#include <cmath>

namespace liana::bench {

namespace {

constexpr std::uint16_t kPdoTooShort = 0x8210;

}  // namespace

Drive::Drive(const DriveSettings& settings, double start_counts)
    : settings_(settings),
      objects_(make_objects(settings)),
      sdo_(
          objects_, [this](const Object& o, std::int64_t v) { return guard(o, v); },
          [this](const Object& o) { written(o); }),
      motor_(settings.servo_time_constant_s, settings.pull_direction, start_counts, settings.holds_both_ways) {
  rebuild_pdos();
  sample();
  objects_.set(0x607A, 0, objects_.get(0x6064));
}

// ---- frames
// -------------------------------------------------------------------------------------------------------------------

void Drive::receive(const CanFrame& frame, FrameList& out) {
  if (dead_ || reset_at_us_) return;
  ++counts_.received;
  now_us_ = std::max(now_us_, frame.time_us);
  const auto node = static_cast<std::uint32_t>(settings_.node);
  if (frame.id == 0x000) return handle_nmt(frame, out);
  if (frame.id == 0x080) return handle_sync(out);
  if (frame.id == 0x600 + node) return handle_sdo(frame, out);
  if (frame.id > 0x700 && frame.id < 0x780) return handle_heartbeat(frame, out);
  handle_rpdo(frame, out);
}

void Drive::handle_sdo(const CanFrame& request, FrameList& out) {
  CanFrame response;
  response.id = 0x580 + static_cast<std::uint32_t>(settings_.node);
  const bool listens = nmt_ == NmtState::kPreOperational || nmt_ == NmtState::kOperational;
  if (!listens || !answers_sdo(request)) return;
  sample();
  if (!sdo_.answer(request, response)) return;
  answers_.push_back({now_us_ + std::max(defects_.sdo_us, settings_.dictionary.sdo_us), response});
  send_late(out);
}

// The node's one server: each axis answers for its own objects, the first one also for the node's. What is written to
// the node holds for its other axes, too.
bool Drive::answers_sdo(const CanFrame& request) {
  const unsigned command = request.data[0] >> 5;
  const bool names_object = command == 1 || command == 2 || command == 4;
  if (request.length != 8 || settings_.axes == 1) return true;
  const int axis = axis_of_object(static_cast<std::uint16_t>(get_little_endian(&request.data[1], 2)));
  if (names_object) sdo_axis_ = std::max(1, axis);
  const bool is_write_to_node = command == 1 && axis == 0 && (request.data[0] & 2) != 0;
  CanFrame unsaid;
  if (settings_.axis != 1 && is_write_to_node) sdo_.answer(request, unsaid);
  return sdo_axis_ == settings_.axis;
}

void Drive::send_as_node(NmtState state, FrameList& out) {
  if (settings_.axis != 1) return;
  CanFrame heartbeat;
  heartbeat.id = 0x700 + static_cast<std::uint32_t>(settings_.node);
  heartbeat.length = 1;
  heartbeat.data[0] = static_cast<std::uint8_t>(state);
  send(heartbeat, out);
}

void Drive::send(CanFrame frame, FrameList& out) {
  if (defects_.silent || dead_) return;
  frame.bus = settings_.bus;
  out.push_back(frame);
  ++counts_.sent;
  if (!defects_.twice) return;
  if ((frame.id & 0x580) == 0x180) frame.data[3] ^= 0x40;  // the other one stands elsewhere
  out.push_back(frame);
}

void Drive::send_late(FrameList& out) {
  for (; !answers_.empty() && answers_.front().at_us <= now_us_; answers_.pop_front())
    send(answers_.front().frame, out);
}

void Drive::send_emergency(std::uint16_t code, FrameList& out) {
  ++counts_.emergencies;
  CanFrame frame;
  frame.id = 0x080 + static_cast<std::uint32_t>(settings_.node);
  frame.length = 8;
  put_little_endian(frame.data.data(), 2, code);
  // Bit 0 stands for any error (CiA 301, 7.5.2.2), also for one that leaves no trace.
  frame.data[2] = static_cast<std::uint8_t>(objects_.get(0x1001) | (code == 0 ? 0 : 1));
  send(frame, out);
  if (code == 0) return;
  objects_.set(0x1003, 0, 1);
  objects_.set(0x1003, 1, code);
}

// ---- network management
// -------------------------------------------------------------------------------------------------------

void Drive::handle_nmt(const CanFrame& frame, FrameList& out) {
  if (frame.length != 2 || (frame.data[1] != 0 && frame.data[1] != settings_.node)) return;
  switch (frame.data[0]) {
    case 0x01:
      return enter_nmt(NmtState::kOperational);
    case 0x02:
      return enter_nmt(NmtState::kStopped);
    case 0x80:
      return enter_nmt(NmtState::kPreOperational);
    case 0x81:
    case 0x82:
      return begin_reset(frame.data[0] == 0x81, out);
    default:
      return;
  }
}

void Drive::enter_nmt(NmtState state) {
  nmt_ = state;
  targets_.armed = false;
  pending_ = {};
  last_sent_ = {};
  late_.clear();
  if (state != NmtState::kOperational) stop_by_itself();  // 6007: without PDOs nobody steers
}

void Drive::begin_reset(bool of_node, FrameList& out) {
  if (of_node) reset_node();
  answers_.clear();
  const std::uint64_t takes_us = std::max(defects_.reset_us, settings_.dictionary.reset_us);
  if (takes_us == 0) return reset_communication(out);
  enter_nmt(NmtState::kInitialising);
  reset_at_us_ = now_us_ + takes_us;  // tick() ends it
}

// Application objects get their power-on values, too, and a fault is forgotten (CiA 301, 7.3.2.2).
void Drive::reset_node() {
  if (is_torque_controlled()) enter_power(PowerState::kSwitchOnDisabled);  // before its objects forget what it did
  objects_ = make_objects(settings_);
  controlword_ = 0;
  following_error_ = false;
  emergencies_.clear();
  sample();
  objects_.set(0x607A, 0, objects_.get(0x6064));
  enter_power(PowerState::kSwitchOnDisabled);
}

// Both resets: communication objects get their power-on values, the brake closes, boot-up is sent again.
void Drive::reset_communication(FrameList& out) {
  const ObjectDictionary fresh = make_objects(settings_);
  for (std::uint16_t number = 0; number < kPdoCount; ++number) {
    for (const int page : {0x1400, 0x1600, 0x1800, 0x1A00}) {
      const auto index = static_cast<std::uint16_t>(page + number);
      for (std::uint8_t sub = 0; sub <= 8; ++sub)
        if (const Object* object = fresh.find(index, sub)) objects_.set(index, sub, object->value);
    }
  }
  objects_.set(0x1016, 1, fresh.get(0x1016, 1));
  objects_.set(0x1017, 0, fresh.get(0x1017));
  if (const Object* behaviour = fresh.find(0x1029, 1)) objects_.set(0x1029, 1, behaviour->value);
  objects_.set(0x1001, 0, 0);
  rebuild_pdos();
  master_ = {};
  targets_ = {};
  pending_ = {};
  last_sent_ = {};
  late_.clear();
  connection_lost_ = targets_lost_ = false;
  if (power_ != PowerState::kFault) enter_power(PowerState::kSwitchOnDisabled);
  send_as_node(NmtState::kInitialising, out);
  nmt_ = NmtState::kPreOperational;
}

void Drive::handle_heartbeat(const CanFrame& frame, FrameList& out) {
  const auto producer = static_cast<std::uint32_t>(objects_.get(0x1016, 1) >> 16) & 0x7F;
  if (producer == 0 || frame.id != 0x700 + producer) return;
  master_ = {true, now_us_};
  if (connection_lost_ && !targets_lost_) connection_back(out);
}

// ---- objects
// ------------------------------------------------------------------------------------------------------------------

std::uint32_t Drive::guard(const Object& object, std::int64_t value) const {
  if (is_pdo_object(object.index)) {
    if (nmt_ != NmtState::kPreOperational) return abort_code::kDeviceState;
    return check_pdo_write(objects_, object, value);
  }
  if (object.index != 0x6060 || value == kCyclicSynchronousPosition) return abort_code::kNone;
  if (!settings_.is_torque_controlled || value != kCyclicSynchronousTorque) return abort_code::kValue;
  return power_ == PowerState::kOperationEnabled ? abort_code::kDeviceState : abort_code::kNone;  // without power only
}

void Drive::written(const Object& object) {
  if (is_pdo_object(object.index)) return rebuild_pdos();
  if (object.index == 0x1016) master_ = {};
  if (object.index == 0x1017) next_heartbeat_us_ = now_us_;
  if (object.index == 0x6060) change_mode();
  if (object.index == 0x6040) act_on_controlword(static_cast<std::uint16_t>(object.value));
}

// To position control also with power: it takes over where the joint is, and ends what torque was on.
void Drive::change_mode() {
  const std::int64_t mode = objects_.get(0x6060);
  if (is_torque_controlled() && mode == kCyclicSynchronousPosition) {
    end_torque();
    if (power_ == PowerState::kOperationEnabled) motor_.set_mode(MotorMode::kFollow);
    motor_.set_target(static_cast<double>(objects_.get(0x607A)) - encoder_offset_counts_);
  }
  objects_.set(0x6061, 0, mode);
}

void Drive::rebuild_pdos() {
  receive_pdos_.clear();
  transmit_pdos_.clear();
  for (std::uint16_t number = 0; number < kPdoCount; ++number) {
    receive_pdos_.emplace_back(objects_, number, true);
    transmit_pdos_.emplace_back(objects_, number, false);
  }
}

// ---- process data
// -------------------------------------------------------------------------------------------------------------

void Drive::handle_rpdo(const CanFrame& frame, FrameList& out) {
  if (nmt_ != NmtState::kOperational) return;
  for (std::size_t i = 0; i < receive_pdos_.size(); ++i) {
    const Pdo& pdo = receive_pdos_[i];
    if (!pdo.enabled() || pdo.length() == 0 || pdo.cob_id() != frame.id) continue;
    if (frame.length < pdo.length()) return send_emergency(kPdoTooShort, out);
    ++counts_.rpdos;
    pending_[i] = frame;
    if (i == 0) targets_ = {true, now_us_};
    targets_lost_ = false;
    if (connection_lost_) connection_back(out);
  }
}

// Targets that came since the last SYNC act now, and what is sent is what is now.
void Drive::handle_sync(FrameList& out) {
  ++counts_.syncs;
  if (nmt_ != NmtState::kOperational) return;
  for (std::size_t i = 0; i < pending_.size(); ++i) {
    if (!pending_[i]) continue;
    receive_pdos_[i].unpack(*pending_[i]);
    pending_[i].reset();
    act_on_controlword(static_cast<std::uint16_t>(objects_.get(0x6040)));
  }
  if (!defects_.mode) motor_.set_target(static_cast<double>(objects_.get(0x607A)) - encoder_offset_counts_);
  sample();
  send_process_data(out);
}

void Drive::send_process_data(FrameList& out) {
  FrameList sampled;
  for (std::size_t i = 0; i < transmit_pdos_.size(); ++i) {
    const Pdo& pdo = transmit_pdos_[i];
    if (!pdo.enabled() || pdo.length() == 0 || defects_.no_reports) continue;
    const CanFrame frame = pdo.pack();
    if (!is_due(i, frame)) continue;
    sampled.push_back(frame);
    last_sent_[i] = frame;
  }
  late_.push_back(std::move(sampled));
  if (late_.size() <= defects_.late_cycles) return;
  for (CanFrame frame : late_[late_.size() - 1 - defects_.late_cycles]) {
    frame.length = defects_.pdo_length.value_or(frame.length);
    send(frame, out);
  }
  while (late_.size() > defects_.late_cycles) late_.pop_front();
}

// Type 0 sends at a SYNC before which something has changed, 1 to 240 at every n-th (CiA 301, 7.5.2.37).
bool Drive::is_due(std::size_t pdo, const CanFrame& sampled) const {
  const std::uint32_t every = transmit_pdos_[pdo].every_nth_sync();
  if (every != 0) return counts_.syncs % every == 0;
  return !last_sent_[pdo] || last_sent_[pdo]->data != sampled.data;
}

void Drive::sample() {
  if (!defects_.stuck) {
    objects_.set(0x6064, 0, std::llround(motor_.position_counts() + encoder_offset_counts_ + position_error_counts_));
    objects_.set(0x606C, 0, std::llround(motor_.velocity_counts_per_s()));
    objects_.set(0x6077, 0, std::clamp<std::int64_t>(std::llround(measured_permille_), -32768, 32767));
    objects_.set(0x6078, 0, objects_.get(0x6077));  // torque goes with current
  }
  objects_.set(0x6062, 0, objects_.get(0x607A));
  objects_.set(0x60F4, 0, objects_.get(0x607A) - objects_.get(0x6064));
  objects_.set(0x6041, 0, statusword());
  if (defects_.mode) objects_.set(0x6061, 0, *defects_.mode);
}

std::uint16_t Drive::statusword() const {
  unsigned word = state_bits(power_);
  if (!safe_torque_off_) word |= 0x0010;                                               // voltage enabled
  if (nmt_ == NmtState::kOperational) word |= 0x0200;                                  // remote
  if (motor_.at_torque_limit()) word |= 0x0800;                                        // internal limit
  if (power_ == PowerState::kOperationEnabled && mode_allows_power()) word |= 0x1000;  // follows the target
  if (following_error_) word |= 0x2000;
  return static_cast<std::uint16_t>(word);
}

}  // namespace liana::bench
