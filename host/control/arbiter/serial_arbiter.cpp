#include "host/control/arbiter/serial_arbiter.hpp"

#include "host/api/server/request_error.hpp"

namespace liana::arbiter {

void SerialArbiter::require_rest(const Now& now) const {
  require_free(now);
  if (now.at_rest == 0) throw api::RequestError("busy", "it starts from rest: wait for it or send hold");
}

void SerialArbiter::push(const Now& now, const serial::Push& push) {
  require_rest(now);
  Base::hold();
  asked_.emplace();
  asked_->kind = CommandKind::kPush;
  asked_->push = push;
  asked_->push.number = now.push.number + 1;
}

void SerialArbiter::follow(const Now& now) {
  require_rest(now);
  Base::hold();
  asked_.emplace();
  asked_->kind = CommandKind::kFollow;
}

void SerialArbiter::hold(const std::string& why) {
  asked_.reset();
  Base::hold(why);
}

// With a fault the Controller lets nothing but a retract move: what was asked for here has ended.
std::optional<SerialArbiter::Setpoint> SerialArbiter::next_setpoint(std::uint64_t tick, const Now& now) {
  const bool ready = begin_interval(tick, now);
  if (!ready || now.faults.count > 0) asked_.reset();
  if (!ready) return std::nullopt;
  std::optional<Setpoint> setpoint = asked_ ? asked_ : ask(now);
  if (setpoint) setpoint->payload_at_tip = payload_at_tip_;
  return setpoint;
}

bool SerialArbiter::refused(const std::string& why, bool may_pass_slower) {
  if (!asked_) return Base::refused(why, may_pass_slower);
  asked_.reset();
  return false;
}

}  // namespace liana::arbiter
