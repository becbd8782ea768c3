// Field lists of what the skeleton of every robot keeps between ticks, for images of a Controller.
#pragma once

#include "firmware_like/command/release.hpp"
#include "firmware_like/controller.hpp"
#include "firmware_like/operator_input/tip_filter.hpp"
#include "host/storage/recording/visit.hpp"

namespace liana::recording {

// A Controller or an arm: it shows its own members.
template <class A, class T>
requires requires(T& state, A& a) { state.visit_state(a); }
void visit(A& a, T& state) { state.visit_state(a); }

// A telecommand as an image holds it: in the open, as TelecommandFields are.
template <class A, class Setpoint, class T>
void visit_telecommand(A& a, T& sequence, T& first_tick, T& expiry_tick, auto& owner, Setpoint& setpoint) {
  a("sequence", sequence);
  a("first_tick", first_tick);
  a("expiry_tick", expiry_tick);
  a("owner", owner);
  a("setpoint", setpoint);
}

template <class A, class Setpoint>
void visit(A& a, const Telecommand<Setpoint>& t) {
  const std::uint64_t sequence = t.sequence(), first_tick = t.first_tick(), expiry_tick = t.expiry_tick();
  const std::uint32_t owner = t.owner();
  visit_telecommand(a, sequence, first_tick, expiry_tick, owner, t.setpoint());
}

// Gives back what was released then.
template <class A, class Setpoint>
void visit(A& a, Telecommand<Setpoint>& t) {
  std::uint64_t sequence = 0, first_tick = 0, expiry_tick = 0;
  std::uint32_t owner = 0;
  Setpoint setpoint{};
  visit_telecommand(a, sequence, first_tick, expiry_tick, owner, setpoint);
  t = Release::make(sequence, first_tick, expiry_tick, owner, setpoint);
}

template <class A, Like<DriveLinkMonitorState> T>
void visit(A& a, T& s) {
  a("seen_mask", s.seen_mask);
  a("unseen_ticks", s.unseen_ticks);
  a("emergency_code", s.emergency_code);
  a("following_ticks", s.following_ticks);
}

template <class A, Like<ClearResult> T>
void visit(A& a, T& s) {
  a("tick", s.tick);
  a("checked", s.checked);
  a("missing", s.missing);
}

template <class A, Like<SupervisorState> T>
void visit(A& a, T& s) {
  a("phase", s.phase);
  a("phase_ticks", s.phase_ticks);
  a("rest_ticks", s.rest_ticks);
  a("wrong_ticks", s.wrong_ticks);
  a("stopped", s.stopped);
  a("clear", s.clear);
}

template <class A, Like<ChannelState> T>
void visit(A& a, T& s) {
  a("velocity", s.velocity);
  a("acceleration", s.acceleration);
}

template <class A, Like<NotchState> T>
void visit(A& a, T& s) {
  a("step", s.step);
  a("offset", s.offset);
  a("earlier", s.earlier);
}

template <class A, Like<TremorState> T>
void visit(A& a, T& s) {
  a("begun", s.begun);
  a("target", s.target);
  a("linear", s.linear);
  a("angular", s.angular);
}

template <class A, Like<TipFilterState> T>
void visit(A& a, T& s) {
  a("pose", s.pose);
  a("linear", s.linear);
  a("angular", s.angular);
  a("speed_limited", s.speed_limited);
  a("accel_limited", s.accel_limited);
  a("tremor", s.tremor);
}

}  // namespace liana::recording
