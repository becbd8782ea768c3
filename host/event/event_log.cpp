#include "host/event/event_log.hpp"

namespace liana::event {
namespace {

// What a state tells elsewhere, or its client was told, pushes nothing else out of the few that are shown.
bool is_shown(const Event& event) {
  if (event.kind == EventKind::kOwner) return event.number != number_of(OwnerEvent::kAcquired);
  if (event.kind == EventKind::kHoming) return event.number != number_of(HomingEvent::kHomed);
  return event.kind != EventKind::kFault && event.kind != EventKind::kBootProblem &&
         event.kind != EventKind::kRefusal && event.kind != EventKind::kOperator;
}

}  // namespace

void EventLog::number_and_hand_on(std::uint64_t tick, Event event) {
  event.sequence = ++newest_;
  event.tick = tick;
  if (is_shown(event)) shown_.push_back(event);
  if (shown_.size() > kShown) shown_.pop_front();
  sink_(event);
}

void EventLog::add(std::uint64_t tick, Event event) {
  if (++in_interval_[static_cast<std::size_t>(event.kind)] > kMostPerInterval) return;
  number_and_hand_on(tick, std::move(event));
}

void EventLog::begin_interval(std::uint64_t tick) {
  for (std::size_t k = 0; k < kEventKinds; ++k) {
    if (in_interval_[k] > kMostPerInterval) {
      const std::uint32_t count = in_interval_[k] - kMostPerInterval;
      const char* name = event_kind_name(static_cast<EventKind>(k));
      number_and_hand_on(tick, {.kind = EventKind::kLeftOut,
                                .number = count,
                                .subject = name,
                                .values = {{"count", static_cast<double>(count)}},
                                .text = std::to_string(count) + " more events of kind " + name +
                                        " came within one command interval and were left out"});
    }
    in_interval_[k] = 0;
  }
}

}  // namespace liana::event
