#include <array>
#include <ctime>
#include <limits>

#include "host/drives/bus_simulator/bus_hub.hpp"
#include "host/drives/bus_simulator/bus_listener.hpp"

namespace liana::bus_simulator {
namespace {

constexpr std::uint64_t kForeverNs = std::numeric_limits<std::uint64_t>::max();

// Slows virtual time to the wall clock at slot starts. When computing takes longer than the slot, the rest is shifted:
// no bursts.
class Pacer {
 public:
  explicit Pacer(std::uint64_t period_ns) : period_ns_(period_ns) { clock_gettime(CLOCK_MONOTONIC, &start_); }

  void wait_for_slot(std::uint64_t slot) {
    if (slot == slot_) return;
    add(start_, (slot - slot_) * period_ns_);
    slot_ = slot;
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    if (later(now, start_)) {
      start_ = now;
    } else {
      clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &start_, nullptr);
    }
  }

 private:
  static void add(timespec& time, std::uint64_t ns) {
    const std::uint64_t sum = static_cast<std::uint64_t>(time.tv_nsec) + ns;
    time.tv_sec += static_cast<time_t>(sum / 1'000'000'000);
    time.tv_nsec = static_cast<long>(sum % 1'000'000'000);
  }
  static bool later(const timespec& a, const timespec& b) {
    return a.tv_sec != b.tv_sec ? a.tv_sec > b.tv_sec : a.tv_nsec > b.tv_nsec;
  }

  std::uint64_t period_ns_;
  std::uint64_t slot_ = 0;
  timespec start_{};  // of slot_
};

// Waits until participant `index`, which is awake, has yielded.
void await_yield(BusHub& hub, std::size_t index) {
  Participant& participant = hub.participants()[index];
  do {
    if (bus_stop_requested()) hub.end("stopped by a signal");
    if (hub.ended()) return;
  } while (!hub.read_yield(index, true));
  const wire::Yield& yield = participant.yield();
  if (yield.until_us <= hub.now_ns / 1000) {
    participant.refuse("until_us " + std::to_string(yield.until_us) + " is not later than now, " +
                       std::to_string(hub.now_ns / 1000));
    return hub.end(participant.name() + " asked to be woken in the past");
  }
  participant.awake = false;
  participant.until_ns = yield.until_us > kForeverNs / 1000 ? kForeverNs : yield.until_us * 1000;
  participant.wake_on_sync = (yield.flags & wire::kYieldWakeOnSync) != 0;
}

// Waits until everybody woken has yielded, then queues their frames in the order of the participants, not of their
// arrival.
void collect(BusHub& hub) {
  std::array<bool, 2> was_awake{};
  for (std::size_t i = 0; i < hub.participants().size(); ++i) {
    was_awake[i] = hub.participants()[i].awake;
    if (was_awake[i] && !hub.ended()) await_yield(hub, i);
  }
  for (std::size_t i = 0; i < hub.participants().size() && !hub.ended(); ++i) {
    if (was_awake[i]) hub.queue_yield(i);
  }
}

// A SYNC that cannot reach its bus holds up the answer on the other buses by no more than this share of a slot.
std::uint64_t sync_patience_ns(const BusHub& hub) { return std::uint64_t{hub.period_us()} * 1000 / 8; }

// When the participant wants to run if nothing more happens on the wires.
std::uint64_t wanted_ns(BusHub& hub, std::size_t index) {
  const Participant& participant = hub.participants()[index];
  std::uint64_t wanted = participant.until_ns;
  if (participant.wake_on_sync && participant.sync_seen())
    wanted = std::min(wanted, participant.sync_ns() + sync_patience_ns(hub));
  return std::max(wanted, hub.awake_from_ns(index));
}

bool due(BusHub& hub, std::size_t index) {
  const Participant& participant = hub.participants()[index];
  if (wanted_ns(hub, index) <= hub.now_ns) return true;
  return participant.wake_on_sync && participant.sync_seen() && !hub.sim().is_sync_under_way();
}

// Moves virtual time on to the next moment at which somebody has to run.
void advance(BusHub& hub) {
  for (;;) {
    hub.sim().arbitrate(hub.now_ns);
    std::uint64_t next_ns = hub.sim().next_end_ns();
    for (std::size_t i = 0; i < hub.participants().size(); ++i) next_ns = std::min(next_ns, wanted_ns(hub, i));
    if (next_ns == kForeverNs) return hub.end("nobody wants to run any more");
    hub.now_ns = next_ns;
    hub.sim().finish(next_ns);
    for (std::size_t i = 0; i < hub.participants().size(); ++i) {
      if (due(hub, i)) return;
    }
  }
}

void wake_due(BusHub& hub) {
  const std::uint8_t flags = hub.at_slot_start() ? wire::kWakeSlotStart : 0;
  for (std::size_t i = 0; i < hub.participants().size() && !hub.ended(); ++i) {
    if (due(hub, i)) hub.wake(i, flags, true);
  }
}

}  // namespace

void run_lockstep(BusHub& hub, bool paced) {
  Pacer pacer(std::uint64_t{hub.period_us()} * 1000);
  wake_due(hub);  // nobody has asked for anything yet: all are due at 0
  while (!hub.ended()) {
    collect(hub);
    if (hub.ended()) return;
    advance(hub);
    if (paced) pacer.wait_for_slot(hub.slot());
    wake_due(hub);
  }
}

}  // namespace liana::bus_simulator
