#include "host/drives/bus/embedded_realtime_bus.hpp"

#include <utility>

namespace liana::bus {

EmbeddedRealtimeBus::EmbeddedRealtimeBus(std::unique_ptr<EmbeddedLink> link)
    : RealtimeBus(link->welcome().period_us), link_(std::move(link)) {
  watch(link_->descriptor());
}

SendResult EmbeddedRealtimeBus::send(int bus, const CanFrame& frame) noexcept {
  if (stats(bus).state == BusState::kDown) return SendResult::kDown;
  if (yield_.frame_count == wire::kMaxPacketFrames) {
    book().count_refused(bus, frame, false);
    return SendResult::kQueueFull;
  }
  yield_.frame[yield_.frame_count++] = wire::to_wire_frame(bus, frame);
  book().count_sent(bus, frame);
  return SendResult::kOk;
}

void EmbeddedRealtimeBus::flush() noexcept {
  if (yield_.frame_count == 0 || ended_) return;
  const bool sent = link_->send(yield_, false);
  for (std::size_t i = 0; !sent && i < yield_.frame_count; ++i) {
    book().count_refused(yield_.frame[i].bus, wire::to_can_frame(yield_.frame[i]), true);
  }
  yield_.frame_count = 0;
}

void EmbeddedRealtimeBus::drain() noexcept {
  EmbeddedLink::Received got = EmbeddedLink::Received::kNothing;
  while ((got = link_->receive(wake_, false)) == EmbeddedLink::Received::kWake) {
    for (std::size_t i = 0; i < wake_.frame_count; ++i) {
      if (wake_.frame[i].bus < bus_count()) book().take_record(wake_.frame[i]);
    }
    if ((wake_.flags & wire::kWakeShutdown) != 0) return end();
  }
  if (got == EmbeddedLink::Received::kEnded) end();
}

void EmbeddedRealtimeBus::end() noexcept {
  ended_ = true;
  for (int bus = 0; bus < bus_count(); ++bus) book().stats(bus).state = BusState::kDown;
}

}  // namespace liana::bus
