#include "host/drives/canopen/boot_node.hpp"

#include <algorithm>
#include <cmath>

#include "host/drives/canopen/messages.hpp"

namespace liana::canopen {
namespace {

constexpr int kMaxRestarts = 3;  // a slow drive may see two resets

bool is_identity(const BootObject& object) { return object.index == 0x1000 || object.index == 0x1018; }

}  // namespace

BootTiming boot_timing(double rate_hz, const config::DriveTimes& allowed) {
  const auto ticks = [rate_hz](double seconds) {
    return static_cast<std::uint32_t>(std::max(2.0, std::ceil(seconds * rate_hz)));
  };
  return {ticks(1.0),
          ticks(4.0),
          ticks(allowed.boot_up_s),
          ticks(allowed.sdo_answer_s),
          ticks(0.25),
          ticks(allowed.operational_s)};
}

BootNode::BootNode(std::span<const ExpectedDrive> axes, const BootTiming& timing, bool look_only)
    : bus_(axes.front().bus),
      node_(axes.front().node),
      timing_(timing),
      look_only_(look_only),
      plan_(axes),
      outcomes_(plan_.objects().size()),
      sdo_(node_, timing.sdo_ticks) {}

bool BootNode::has(config::ObjectId object) const noexcept {
  for (std::size_t i = 0; i < outcomes_.size(); ++i) {
    const BootObject& each = plan_.objects()[i];
    if (each.index == object.index && each.sub == object.sub && outcomes_[i].found) return true;
  }
  return false;
}

void BootNode::enter(NodePhase phase) noexcept {
  phase_ = phase;
  waited_ticks_ = 0;
}

bool BootNode::is_missing() const noexcept {
  const BootFailure failure = mismatch_count_ == 0 ? BootFailure::kNone : mismatches_[mismatch_count_ - 1].failure;
  return phase_ == NodePhase::kFailed && (failure == BootFailure::kNoBootUp || failure == BootFailure::kNoAnswer);
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
      send_nmt(kNmtResetCommunication);
      without_boot_up_ = 0;
      reset_wait_ = timing_.reset_ticks;
      return enter(NodePhase::kWaitBootUp);
    case NodePhase::kWaitBootUp:
      return wait_for_boot_up();
    case NodePhase::kObjects:
      if (sdo_.status() != SdoStatus::kBusy) finish_transfer();
      return;
    case NodePhase::kStart:
      send_nmt(kNmtStart);
      return enter(NodePhase::kWaitOperational);
    case NodePhase::kWaitOperational:  // nobody confirms a start: a lost one is sent again
      if (waited_ticks_ >= timing_.operational_ticks) return fail(BootFailure::kNotOperational);
      if (waited_ticks_ % timing_.start_ticks == 0) send_nmt(kNmtStart);
      return;
    case NodePhase::kFailed:  // it may have come without a word: with its cable, after its boot-up message
      if (!is_missing() || waited_ticks_ < timing_.max_reset_ticks) return;
      waited_ticks_ = 0;
      return send_nmt(kNmtResetCommunication);
    case NodePhase::kConfigured:
    case NodePhase::kOperational:
      return;
  }
}

void BootNode::wait_for_boot_up() noexcept {
  if (++without_boot_up_ >= timing_.boot_up_ticks) return fail(BootFailure::kNoBootUp);
  if (waited_ticks_ < reset_wait_) return;
  waited_ticks_ = 0;
  reset_wait_ = std::min(2 * reset_wait_, timing_.max_reset_ticks);
  send_nmt(kNmtResetCommunication);
}

void BootNode::send_nmt(std::uint8_t command) noexcept {
  out_ = nmt_frame(command, node_);
  out_waiting_ = true;
}

void BootNode::begin_object() noexcept {
  // Another drive than expected is only read: nobody knows what a write would do there.
  transfer_.begin(plan_, at_, look_only_ || is_another_, sdo_);
}

void BootNode::finish_transfer() noexcept {
  const std::optional<std::uint32_t> before = at_ == 0 ? std::nullopt : outcomes_[at_ - 1].found;
  const TransferResult end = transfer_.advance(plan_, before, sdo_);
  if (end == TransferResult::kNotYet) return;
  outcomes_[at_] = {transfer_.found(), end != TransferResult::kRight && end != TransferResult::kMissing,
                    transfer_.said_bytes()};
  switch (end) {
    case TransferResult::kAborted:
      return refused(BootFailure::kAborted);
    case TransferResult::kWrong:
      return refused(BootFailure::kValue);
    case TransferResult::kSilent:
      return fail(BootFailure::kNoAnswer);
    case TransferResult::kRight:
      if (transfer_.found()) plan_.keep(at_, *transfer_.found());
      [[fallthrough]];
    case TransferResult::kMissing:
    case TransferResult::kNotYet:
      return next_object();
  }
}

// The rest of the plan is gone through all the same, so that what else does not fit is told at once.
void BootNode::refused(BootFailure failure) noexcept {
  BootMismatch mismatch;
  mismatch.failure = failure;
  mismatch.bus = bus_;
  mismatch.node = node_;
  mismatch.axis = object().axis;
  mismatch.index = object().index;
  mismatch.sub = failure == BootFailure::kValue ? plan_.sub_to_blame(at_, *transfer_.found()) : object().sub;
  mismatch.written = object().write && !look_only_;
  mismatch.object_name = object().name.c_str();
  mismatch.rule = object().rule;
  mismatch.expected_before = object().before;
  mismatch.found_before = at_ == 0 ? 0 : outcomes_[at_ - 1].found.value_or(0);
  mismatch.expected = object().value;
  mismatch.mask = object().mask | ~all_bits(object().bytes);
  mismatch.found = transfer_.found().value_or(0);
  mismatch.has_found = transfer_.found().has_value();
  mismatch.abort_code = failure == BootFailure::kAborted ? transfer_.abort_code() : 0;
  if (is_identity(object())) is_another_ = true;
  note(mismatch);
  next_object();
}

// Objects that cannot be right when others are not, and those of a list that has ended, are left out.
void BootNode::next_object() noexcept {
  const bool list_ends = object().ends_list_if_missing && !outcomes_[at_].found && !outcomes_[at_].is_refused;
  const std::string& list = object().name;
  for (++at_; at_ < plan_.objects().size(); ++at_) {
    if (list_ends && object().name == list) continue;
    if (!lacks_what_it_needs()) return begin_object();
    outcomes_[at_] = {std::nullopt, true};
  }
  enter(mismatch_count_ == 0 ? NodePhase::kConfigured : NodePhase::kFailed);
}

bool BootNode::lacks_what_it_needs() const noexcept {
  for (std::size_t i = object().needs_from; i < object().needs_to && !look_only_; ++i)
    if (outcomes_[i].is_refused) return true;
  return false;
}

void BootNode::on_heartbeat(const bus::CanFrame& frame) noexcept {
  if (frame.length != 1) {
    odd_heartbeat_ = frame.length;
    return;
  }
  last_state_ = frame.data[0];
  const int state = frame.data[0] & kNmtStateMask;
  if (state == kStateOperational && phase_ == NodePhase::kWaitOperational) return enter(NodePhase::kOperational);
  if (state == kStateBootUp) restart();
}

void BootNode::begin_plan() noexcept {
  at_ = 0;
  is_another_ = false;
  forget_mismatches();
  std::fill(outcomes_.begin(), outcomes_.end(), BootOutcome{});
  out_waiting_ = false;
  enter(NodePhase::kObjects);
  begin_object();
}

// A boot-up message: the first one is what we wait for; after a later one everything we wrote is gone.
void BootNode::restart() noexcept {
  switch (phase_) {
    case NodePhase::kReset:
      return;
    case NodePhase::kWaitBootUp:
      if (!out_waiting_) begin_plan();
      return;
    case NodePhase::kFailed:
      if (mismatch_count_ > 0 && mismatches_[mismatch_count_ - 1].failure == BootFailure::kRestarts) return;
      [[fallthrough]];
    case NodePhase::kOperational:
      restarts_ = 0;
      return begin_plan();
    case NodePhase::kObjects:
    case NodePhase::kConfigured:
    case NodePhase::kStart:
    case NodePhase::kWaitOperational:
      if (++restarts_ > kMaxRestarts) return fail(BootFailure::kRestarts);
      return begin_plan();
  }
}

void BootNode::recover(NodeSeen seen) noexcept {
  const bool is_booted = phase_ == NodePhase::kOperational;
  const bool waits_long = phase_ == NodePhase::kWaitBootUp && waited_ticks_ >= timing_.reset_ticks;
  if (is_booted && seen == NodeSeen::kWell) return;
  if (!is_booted && !waits_long && phase_ != NodePhase::kFailed) return;
  restarts_ = 0;
  if (is_booted && seen == NodeSeen::kPreOperational) return begin_plan();
  forget_mismatches();
  enter(NodePhase::kReset);
}

void BootNode::on_sdo_response(const bus::CanFrame& frame) noexcept {
  if (phase_ == NodePhase::kObjects) sdo_.on_response(frame);
}

void BootNode::fail(BootFailure failure) noexcept {
  BootMismatch mismatch;
  mismatch.failure = failure;
  mismatch.bus = bus_;
  mismatch.node = node_;
  const bool of_sdo = failure == BootFailure::kNoAnswer;
  const bool of_heartbeat = failure == BootFailure::kNoBootUp || failure == BootFailure::kNotOperational;
  if (of_sdo) mismatch.odd_length = sdo_.odd_length();
  if (of_heartbeat) mismatch.odd_length = odd_heartbeat_;
  if (phase_ == NodePhase::kObjects) {
    mismatch.index = object().index;
    mismatch.sub = object().sub;
    mismatch.object_name = object().name.c_str();
  }
  mismatch.found = last_state_.value_or(0);
  mismatch.has_found = last_state_.has_value();
  note(mismatch);
  enter(NodePhase::kFailed);
}

// The last place is for what ended the plan.
void BootNode::note(const BootMismatch& mismatch) noexcept {
  if (mismatch_count_ == kMaxMismatches) {
    ++more_mismatches_;
    --mismatch_count_;
  }
  mismatches_[mismatch_count_++] = mismatch;
}

void BootNode::forget_mismatches() noexcept {
  mismatch_count_ = 0;
  more_mismatches_ = 0;
}

}  // namespace liana::canopen
