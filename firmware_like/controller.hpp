// The control core: one door, `tick`. What is true of every robot is here; what is true of its arm is the arm's
// (arm.hpp). A trivially copyable value, so that the twin is a copy of it.
#pragma once

#include <cstdint>
#include <type_traits>

#include "firmware_like/arm.hpp"
#include "firmware_like/controller_io.hpp"

namespace liana {

// Everything the core remembers between ticks.
template <Arm A>
class Controller {
 public:
  using Table = typename A::Table;

  // The table must have passed the loader; no other checks are made here.
  explicit Controller(const Table& table) noexcept
      : arm_(table), gate_limits_(arm_.gate_limits()), link_limits_(arm_.link_limits()) {}

  // One control cycle. Never fails: what is wrong is in the faults and limits of the result. Inputs must come one per
  // tick, in order.
  Outputs<A> tick(const Inputs<A>& inputs) noexcept {
    limits_ = 0;
    arm_.read(inputs.drive, inputs.sensors);
    const std::int32_t wrong = watch(inputs);
    if (inputs.request != Request::kNone) [[unlikely]]
      arm_.answer(inputs.request, faults_);
    const Orders orders = supervise(link_limits_, inputs, arm_.status(), active_.kind(), wrong, supervisor_, faults_);
    take_telecommand(inputs);        // what is in force now
    move(orders);                    // filter, IK, limiter: where the arm should be
    command_drives(inputs, orders);  // what each drive should do, the gate, CiA 402
    return report(inputs, orders);
  }

  const Table& table() const noexcept { return arm_.table(); }
  const A& arm() const noexcept { return arm_; }
  // What the last clear or enable looked at (bits of Condition).
  const SupervisorState& supervisor() const noexcept { return supervisor_; }

  // Shows `v(name, member)` every member that the table alone does not give, in a fixed order: the one way in which a
  // Controller is written and read back. Whoever writes to members must have checked what he writes.
  template <class V>
  void visit_state(V& v) {
    visit_members(*this, v);
  }
  template <class V>
  void visit_state(V& v) const {
    visit_members(*this, v);
  }

 private:
  template <class Self, class V>
  static void visit_members(Self& self, V& v) {
    v("arm", self.arm_);
    v("link", self.link_);
    v("faults", self.faults_);
    v("supervisor", self.supervisor_);
    v("active", self.active_);
    v("pending", self.pending_);
    v("last_sequence", self.last_sequence_);
    v("limits", self.limits_);
    v("sent", self.sent_);
  }

  using Command = Telecommand<typename A::Setpoint>;

  std::int32_t watch(const Inputs<A>& inputs) noexcept;
  void offer(const Command& offered, std::uint64_t tick) noexcept;
  void take_telecommand(const Inputs<A>& inputs) noexcept;
  void move(const Orders& orders) noexcept;
  void command_drives(const Inputs<A>& inputs, const Orders& orders) noexcept;
  Outputs<A> report(const Inputs<A>& inputs, const Orders& orders) const noexcept;

  A arm_;
  GateLimits gate_limits_;
  LinkLimits link_limits_;

  DriveLinkMonitorState link_{};
  FaultList faults_{};
  SupervisorState supervisor_{};

  Command active_{};
  Command pending_{};
  std::uint64_t last_sequence_ = 0;
  std::uint32_t limits_ = 0;  // LimitBit of this tick

  DriveCommands sent_{};
};

// What is wrong with drives, buses, clock and arm; returns how many of it are wrong now.
template <Arm A>
std::int32_t Controller<A>::watch(const Inputs<A>& inputs) noexcept {
  const WatchScope scope = watch_scope(supervisor_);
  Watch out(inputs.tick, faults_);
  watch_cycle(scope, inputs, out);
  watch_from_start(link_limits_, link_);
  for (std::int32_t drive = 0; drive < link_limits_.drive_count; ++drive) {
    const std::size_t i = as_index(drive);
    watch_drive(link_limits_, scope, inputs.drive[i], drive, link_, out);
    arm_.watch_drive(scope, link_.following_ticks[i] == 0, drive, out);
    const WatchScope following{scope.powered && !arm_.lets_go(drive), scope.prepared};
    watch_following(link_limits_, following, inputs.drive[i], sent_[i], drive, link_, out);
  }
  arm_.watch(scope, inputs.tick, faults_);
  return out.active();
}

// A command with a new sequence waits for its first tick, or is a fault when the arm cannot use it.
template <Arm A>
void Controller<A>::offer(const Command& offered, std::uint64_t tick) noexcept {
  if (offered.kind() == CommandKind::kNone || offered.sequence() <= last_sequence_) return;
  last_sequence_ = offered.sequence();
  if (arm_.accepts(offered.setpoint())) {
    pending_ = offered;
  } else {
    latch(faults_, {FaultNumber::kCommandInvalid, -1, narrow<std::uint16_t>(offered.sequence() & 0xFFFFu), tick});
  }
}

template <Arm A>
void Controller<A>::take_telecommand(const Inputs<A>& inputs) noexcept {
  offer(inputs.telecommand, inputs.tick);
  if (pending_.kind() != CommandKind::kNone && pending_.first_tick() <= inputs.tick) {
    active_ = pending_;
    pending_ = Command{};
    if (is_motion(active_.kind())) {
      arm_.take(active_.setpoint());
    } else {
      arm_.brake();  // hold or stop
    }
  }
  if (active_.sequence() != 0 && active_.expiry_tick() <= inputs.tick) {
    if (!arm_.is_braking()) limits_ |= kLimitExpired;
    arm_.brake();
  }
}

template <Arm A>
void Controller<A>::move(const Orders& orders) noexcept {
  if (!orders.live_targets) {
    arm_.stand();
    active_ = Command{};
    return;
  }
  const bool allowed = is_let_move(orders.may_move, active_.kind());
  if (!allowed) arm_.brake();
  limits_ |= arm_.advance(allowed);
}

template <Arm A>
void Controller<A>::command_drives(const Inputs<A>& inputs, const Orders& orders) noexcept {
  DriveProposals proposals{};
  limits_ |= arm_.propose(orders, sent_, faults_.count == 0, proposals);
  const GateResult result = gate(gate_limits_, orders.goal, orders.live_targets, proposals, sent_, inputs.drive);
  if (result.check != GateCheck::kPassed) {
    limits_ |= kLimitGate;
    latch(faults_, gate_fault(result, inputs.tick));
  }
  sent_ = result.command;
}

template <Arm A>
Outputs<A> Controller<A>::report(const Inputs<A>& inputs, const Orders& orders) const noexcept {
  const ArmStatus arm = arm_.status();
  Outputs<A> out;
  arm_.report(out);
  out.tick = inputs.tick;
  out.state = orders.state;
  out.stop_category = orders.stop_category;
  out.limits = limits_;
  out.at_rest = arm.at_rest ? 1 : 0;
  out.homed = arm.homed ? 1 : 0;
  out.active_sequence = arm_.is_braking() ? 0 : active_.sequence();
  out.faults = faults_;
  out.drive = sent_;
  return out;
}

}  // namespace liana
