#include "host/drives/bus/lockstep_bus.hpp"

#include <utility>

namespace liana::bus {
namespace {

constexpr int kTransmitQueue = 64;  // frames per bus, docs/reference/bus-protocol.md

}  // namespace

LockstepBus::LockstepBus(std::unique_ptr<EmbeddedLink> link)
    : link_(std::move(link)), period_us_(link_->welcome().period_us) {}

LockstepBus::~LockstepBus() {
  yield_.flags = wire::kYieldLeave;
  if (awake_ && !ended_) link_->send(yield_, false);
}

timing::TickStart LockstepBus::begin_tick(std::uint64_t tick) noexcept {
  tick_ = tick;
  book_.begin_tick();
  if (!awake_) wait_wake();
  while (!ended_ && now_us_ < tick * period_us_) {
    yield_until(tick * period_us_);
    wait_wake();
  }
  return skip_passed(tick);
}

// A controller that a script has paused goes on at the next deadline, as in real time.
timing::TickStart LockstepBus::skip_passed(std::uint64_t tick) noexcept {
  const std::uint64_t late_us = now_us_ - tick * period_us_;
  if (ended_ || late_us == 0) return {tick, 0, 0, ended_};
  tick_ = (now_us_ + period_us_ - 1) / period_us_;
  while (!ended_ && now_us_ < tick_ * period_us_) {
    yield_until(tick_ * period_us_);
    wait_wake();
  }
  return {tick_, 0, static_cast<std::uint32_t>(tick_ - tick), ended_};
}

SendResult LockstepBus::send(int bus, const CanFrame& frame) noexcept {
  if (stats(bus).state == BusState::kDown) return SendResult::kDown;
  int& queued = queued_[static_cast<std::size_t>(bus)];
  if (queued == kTransmitQueue || yield_.frame_count == wire::kMaxPacketFrames) {
    book_.count_refused(bus, frame, false);
    return SendResult::kQueueFull;
  }
  ++queued;
  yield_.frame[yield_.frame_count++] = wire::to_wire_frame(bus, frame);
  book_.count_sent(bus, frame);
  return SendResult::kOk;
}

void LockstepBus::wait_feedback(int) noexcept {
  const std::uint64_t half_us = tick_ * period_us_ + period_us_ / 2;
  if (ended_ || now_us_ >= half_us) return;
  yield_until(half_us);
  wait_wake();
}

// Yields at once: while the caller does its other work, bus and plant run on to the next tick.
void LockstepBus::end_tick() noexcept {
  if (awake_ && !ended_) yield_until((tick_ + 1) * period_us_);
}

void LockstepBus::yield_until(std::uint64_t until_us) noexcept {
  yield_.until_us = until_us;
  if (!link_->send(yield_, true)) end();
  yield_.frame_count = 0;
  queued_ = {};
  awake_ = false;
}

void LockstepBus::wait_wake() noexcept {
  if (ended_) return;
  if (link_->receive(wake_, true) != EmbeddedLink::Received::kWake) return end();
  awake_ = true;
  now_us_ = wake_.now_us;
  for (std::size_t i = 0; i < wake_.frame_count; ++i) {
    if (wake_.frame[i].bus < bus_count()) book_.take_record(wake_.frame[i]);
  }
  if ((wake_.flags & wire::kWakeShutdown) != 0) end();
}

void LockstepBus::end() noexcept {
  ended_ = true;
  for (int bus = 0; bus < bus_count(); ++bus) book_.stats(bus).state = BusState::kDown;
}

}  // namespace liana::bus
