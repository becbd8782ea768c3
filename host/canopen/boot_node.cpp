#include "host/canopen/boot_node.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "host/canopen/messages.hpp"

namespace liana::canopen {
namespace {

constexpr int kAttempts = 3;     // per transfer: every object may be read or written twice
constexpr int kMaxRestarts = 3;  // a slow drive may see two resets

}  // namespace

BootTiming boot_timing(double rate_hz) {
  const auto ticks = [rate_hz](double seconds) {
    return static_cast<std::uint32_t>(std::max(2.0, std::ceil(seconds * rate_hz)));
  };
  return {ticks(0.5), ticks(10.0), ticks(0.3), ticks(0.25), ticks(1.0)};
}

BootNode::BootNode(const DriveExpectation& drive, const BootTiming& timing)
    : bus_(drive.bus), node_(drive.node), timing_(timing), plan_(drive), sdo_(drive.node, timing.sdo_ticks) {}

void BootNode::enter(NodePhase phase) noexcept {
  phase_ = phase;
  waited_ticks_ = 0;
}

void BootNode::allow_start() noexcept {
  if (phase_ == NodePhase::kConfigured) enter(NodePhase::kStart);
}

bool BootNode::step(bus::CanFrame& frame) noexcept {
  sdo_.tick();
  advance();
  if (!out_waiting_) out_waiting_ = sdo_.take_request(out_);
  frame = out_;
  return out_waiting_;
}

void BootNode::sent(bool accepted) noexcept { out_waiting_ = !accepted; }

void BootNode::advance() noexcept {
  ++waited_ticks_;
  switch (phase_) {
    case NodePhase::kReset:
      out_ = nmt_frame(kNmtResetCommunication, node_);
      out_waiting_ = true;
      return enter(NodePhase::kWaitBootUp);
    case NodePhase::kWaitBootUp:
      if (++without_boot_up_ >= timing_.boot_up_ticks) return fail(BootFailure::kNoBootUp);
      if (waited_ticks_ >= timing_.reset_ticks) enter(NodePhase::kReset);
      return;
    case NodePhase::kObjects:
      if (sdo_.status() != SdoStatus::kBusy) finish_transfer();
      return;
    case NodePhase::kStart:
      send_start();
      return enter(NodePhase::kWaitOperational);
    case NodePhase::kWaitOperational:  // nobody confirms a start: a lost one is sent again
      if (waited_ticks_ >= timing_.operational_ticks) return fail(BootFailure::kNotOperational, last_state_);
      if (waited_ticks_ % timing_.start_ticks == 0) send_start();
      return;
    case NodePhase::kConfigured:
    case NodePhase::kOperational:
    case NodePhase::kFailed:
      return;
  }
}

void BootNode::send_start() noexcept {
  out_ = nmt_frame(kNmtStart, node_);
  out_waiting_ = true;
}

void BootNode::begin_object() noexcept {
  attempts_ = 0;
  reading_back_ = false;
  if (!object().write) return begin_read();
  std::array<std::uint8_t, 4> bytes{};
  put_u32(bytes.data(), 4, object().value);
  sdo_.start_download(object().index, object().sub, {bytes.data(), object().bytes});
}

void BootNode::begin_read() noexcept { sdo_.start_upload(object().index, object().sub); }

void BootNode::finish_transfer() noexcept {
  if (sdo_.status() == SdoStatus::kTimeout) {
    if (++attempts_ >= kAttempts) return fail(BootFailure::kNoAnswer);
    const int attempts = attempts_;
    if (reading_back_) {
      begin_read();
    } else {
      begin_object();
    }
    attempts_ = attempts;
    return;
  }
  if (sdo_.status() == SdoStatus::kAborted) {
    const bool missing = sdo_.abort_code() == kAbortNoObject || sdo_.abort_code() == kAbortNoSubIndex;
    if (object().may_be_missing && missing) return next_object();
    return fail(BootFailure::kAborted);
  }
  if (object().write && !reading_back_) {
    reading_back_ = true;
    attempts_ = 0;
    return begin_read();
  }
  const std::uint32_t found = sdo_.value();
  if ((found & object().mask) != (object().value & object().mask)) return fail(BootFailure::kValue, found);
  plan_.keep(at_, found);
  next_object();
}

void BootNode::next_object() noexcept {
  if (++at_ == plan_.objects().size()) return enter(NodePhase::kConfigured);
  begin_object();
}

void BootNode::on_heartbeat(std::uint8_t state, bool all_were_operational) noexcept {
  last_state_ = state & 0x7F;
  if (last_state_ == kStateOperational && phase_ == NodePhase::kWaitOperational) return enter(NodePhase::kOperational);
  if (last_state_ == kStateBootUp) restart(all_were_operational);
}

// A boot-up message: the first one is what we wait for; after a later one everything we wrote is gone.
void BootNode::restart(bool all_were_operational) noexcept {
  if (phase_ == NodePhase::kOperational || (all_were_operational && phase_ == NodePhase::kFailed)) {
    restarts_ = 0;
    mismatch_ = BootMismatch{};
    enter(NodePhase::kConfigured);
  }
  const bool waiting = phase_ == NodePhase::kWaitBootUp && !out_waiting_;
  const bool configured =
      phase_ == NodePhase::kObjects || phase_ == NodePhase::kConfigured || phase_ == NodePhase::kWaitOperational;
  if (!waiting && !configured) return;
  if (configured && ++restarts_ > kMaxRestarts) return fail(BootFailure::kRestarts);
  at_ = 0;
  out_waiting_ = false;
  enter(NodePhase::kObjects);
  begin_object();
}

void BootNode::on_sdo_response(const bus::CanFrame& frame) noexcept {
  if (phase_ == NodePhase::kObjects) sdo_.on_response(frame);
}

void BootNode::fail(BootFailure failure, std::uint32_t found) noexcept {
  mismatch_ = {failure, bus_, node_};
  mismatch_.found = found;
  if (phase_ == NodePhase::kObjects) {
    mismatch_.index = object().index;
    mismatch_.sub = object().sub;
    mismatch_.written = object().write;
    mismatch_.object_name = object().name;
    mismatch_.expected = object().value & object().mask;
    mismatch_.found = found & object().mask;
    mismatch_.abort_code = sdo_.abort_code();
  }
  enter(NodePhase::kFailed);
}

}  // namespace liana::canopen
