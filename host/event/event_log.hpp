// Numbers events and hands each of them on; bounds what one interval may add.
#pragma once

#include <array>
#include <deque>
#include <functional>

#include "host/event/event.hpp"

namespace liana::event {

class EventLog {
 public:
  using Sink = std::function<void(const Event&)>;
  static constexpr std::size_t kShown = 10;
  // Of one kind in one interval: more than any robot has drives. Who floods fills neither disk nor readers.
  static constexpr std::uint32_t kMostPerInterval = 40;

  // `sink` gets every event, in order, within add() or begin_interval().
  explicit EventLog(Sink sink) : sink_(std::move(sink)) {}

  // Gives the event its sequence and this tick. Beyond kMostPerInterval of its kind it is only counted.
  void add(std::uint64_t tick, Event event);
  // A command interval begins: one event for each kind of which some were left out in the one before.
  void begin_interval(std::uint64_t tick);

  // The newest events for people, at most kShown, oldest first: without what a state tells elsewhere (faults, boot
  // problems, the owner, that the arm is homed, what the operator says) and refused requests, which their client was
  // told.
  const std::deque<Event>& shown() const { return shown_; }

 private:
  void number_and_hand_on(std::uint64_t tick, Event event);

  Sink sink_;
  std::uint64_t newest_ = 0;
  std::array<std::uint32_t, kEventKinds> in_interval_{};
  std::deque<Event> shown_;
};

}  // namespace liana::event
