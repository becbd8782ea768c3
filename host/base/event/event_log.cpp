#include "host/base/event/event_log.hpp"

namespace liana::event {
namespace {

// What a state tells elsewhere, or its client was told, pushes nothing else out of the few that are shown.
bool is_shown(const Event& event) {
  if (event.kind == EventKind::kOwner) return event.number != number_of(OwnerEvent::kAcquired);
  if (event.kind == EventKind::kHoming) return event.number != number_of(HomingEvent::kHomed);
  return event.kind != EventKind::kFault && event.kind != EventKind::kBootProblem &&
         event.kind != EventKind::kRefusal && event.kind != EventKind::kOperator;
}

// Whether it is something wrong, which stands, rather than something that somebody or something does.
bool is_condition(EventKind kind) {
  return kind == EventKind::kFault || kind == EventKind::kBootProblem || kind == EventKind::kEmergency ||
         kind == EventKind::kHostWarning || kind == EventKind::kFriction || kind == EventKind::kLoadCell ||
         kind == EventKind::kLeftOut;
}

// What people or missions say is the same where the words are.
bool is_said(EventKind kind) {
  return kind == EventKind::kStep || kind == EventKind::kOperator || kind == EventKind::kTool ||
         kind == EventKind::kStop || kind == EventKind::kClear || kind == EventKind::kHoming;
}

std::string key_of(EventKind kind) { return std::string(event_kind_name(kind)) + "/"; }

std::string shared_key_of(const Event& event) {
  return key_of(event.kind) + (event.kind == EventKind::kLeftOut ? "" : std::to_string(event.number)) + "/";
}

// An interface that changes from one state to another does not stand still.
std::string full_key_of(const Event& event) {
  std::string key = shared_key_of(event) + event.subject + "/" + (is_said(event.kind) ? event.text : "");
  for (const EventValue& value : event.values) {
    if (value.name == "state") key += std::to_string(value.value);
  }
  return key;
}

double* count_of(Event& event) {
  for (EventValue& value : event.values) {
    if (value.name == "count") return &value.value;
  }
  return nullptr;
}

// The newest of several cases, with the sum of their counts.
void keep_newest(Event& kept, Event newer, bool is_first) {
  const double* const before = is_first ? nullptr : count_of(kept);
  const double sum = before == nullptr ? 0.0 : *before;
  kept = std::move(newer);
  if (double* const count = count_of(kept)) *count += sum;
  if (kept.kind == EventKind::kLeftOut) kept.number = static_cast<std::int64_t>(*count_of(kept));
}

Event told_with_count(const Standing<Event>::Entry& entry) {
  Event event = entry.what;
  const std::string times = std::to_string(entry.times), last = std::to_string(entry.last);
  event.text += " (" + times + (entry.times == 1 ? " more time" : " more times") + ", last at tick " + last +
                (entry.is_over ? "; over)" : "; it goes on)");
  event.values.push_back({"times", static_cast<double>(entry.times)});
  event.values.push_back({"last_tick", static_cast<double>(entry.last)});
  event.values.push_back({"over", entry.is_over ? 1.0 : 0.0});
  return event;
}

Standing<Event>::Rule rule_of(double period_s) {
  const auto ticks = [period_s](double time_s) { return static_cast<std::uint64_t>(time_s / period_s); };
  return {ticks(EventLog::kOver_s), ticks(EventLog::kAgain_s)};
}

}  // namespace

EventLog::EventLog(Sink sink, double period_s) : sink_(std::move(sink)), standing_(rule_of(period_s)) {}

void EventLog::number_and_hand_on(std::uint64_t tick, Event event) {
  event.sequence = ++newest_;
  event.tick = tick;
  if (is_shown(event)) shown_.push_back(event);
  if (shown_.size() > kShown) shown_.pop_front();
  sink_(event);
}

bool EventLog::tell_or_count(std::uint64_t tick, Event event) {
  const std::uint32_t burst = is_condition(event.kind) ? 1 : kDoings;
  if (auto* counted = standing_.take(full_key_of(event), shared_key_of(event), tick, burst)) {
    keep_newest(counted->what, std::move(event), counted->times == 1);
    return false;
  }
  number_and_hand_on(tick, std::move(event));
  return true;
}

void EventLog::tell_due(std::uint64_t tick, std::optional<std::string_view> ended) {
  for (const auto& entry : standing_.due(tick, ended)) number_and_hand_on(tick, told_with_count(entry));
}

bool EventLog::add(std::uint64_t tick, Event event) {
  if (event.kind == EventKind::kShutdown) tell_due(tick, "");
  if (event.kind == EventKind::kClear && event.number == 0) tell_due(tick, key_of(EventKind::kFault));
  if (++in_interval_[static_cast<std::size_t>(event.kind)] > kMaxPerInterval) return false;
  return tell_or_count(tick, std::move(event));
}

void EventLog::begin_interval(std::uint64_t tick) {
  tell_due(tick);
  for (std::size_t k = 0; k < kEventKinds; ++k) {
    if (in_interval_[k] > kMaxPerInterval) {
      const std::uint32_t count = in_interval_[k] - kMaxPerInterval;
      const char* name = event_kind_name(static_cast<EventKind>(k));
      tell_or_count(tick, {.kind = EventKind::kLeftOut,
                           .number = count,
                           .subject = name,
                           .values = {{"count", static_cast<double>(count)}},
                           .text = "too many events of kind " + std::string(name) +
                                   " came within one command interval; some were left out"});
    }
    in_interval_[k] = 0;
  }
}

}  // namespace liana::event
