// Numbers events and hands each of them on. What stands is one event with a count, and one interval adds only so much.
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <optional>
#include <string_view>

#include "host/base/event/event.hpp"
#include "host/base/event/standing.hpp"

namespace liana::event {

class EventLog {
 public:
  using Sink = std::function<void(const Event&)>;
  static constexpr std::size_t kShown = 10;
  // Of one kind in one interval: more than any robot has drives. Who floods fills neither disk nor readers.
  static constexpr std::uint32_t kMaxPerInterval = 40;

  static constexpr double kOver_s = 2.0;    // what did not come for so long is over
  static constexpr double kAgain_s = 60.0;  // what stands is told so often
  // Of what somebody does (requests, stops) so many are told before they are counted; of what is wrong one.
  static constexpr std::uint32_t kDoings = 10;

  // `sink` gets every event, in order, within add() or begin_interval(). `period_s`: of a tick.
  EventLog(Sink sink, double period_s);

  // Gives the event its sequence and this tick. One that stands (of the same kind, number and subject as one before,
  // and within kOver_s of it) is counted: when it is over, and every kAgain_s, one event tells the newest of them with
  // what was counted (`times`, `last_tick`, `over` 1 or 0; `count` is their sum). Faults are over with a clear,
  // everything is with a shutdown. Beyond kMaxPerInterval of its kind it is only counted as left out. False: it was
  // not told.
  bool add(std::uint64_t tick, Event event);
  // A command interval begins: tells what is due, and one event for each kind of which some were left out in the one
  // before.
  void begin_interval(std::uint64_t tick);

  // The newest events for people, at most kShown, oldest first: without what a state tells elsewhere (faults, boot
  // problems, the owner, that the arm is homed, what the operator says) and refused requests, which their client was
  // told.
  const std::deque<Event>& shown() const { return shown_; }

 private:
  void number_and_hand_on(std::uint64_t tick, Event event);
  bool tell_or_count(std::uint64_t tick, Event event);
  void tell_due(std::uint64_t tick, std::optional<std::string_view> ended = std::nullopt);

  Sink sink_;
  Standing<Event> standing_;
  std::uint64_t newest_ = 0;
  std::array<std::uint32_t, kEventKinds> in_interval_{};
  std::deque<Event> shown_;
};

}  // namespace liana::event
