#include "host/bus/bus_book.hpp"

#include "host/bus/frame_bits.hpp"

namespace liana {

void BusBook::store(int bus, const CanFrame& frame) noexcept {
  DriveBusStats& book = stats(bus);
  ++book.received;
  book.bits += frame_bits(frame);
  if (frame.id > 0x180 && frame.id < 0x200) ++feedback_;
  if (!ring_.push({bus, frame})) ++book.dropped;
}

void BusBook::count_sent(int bus, const CanFrame& frame) noexcept {
  DriveBusStats& book = stats(bus);
  ++book.sent;
  book.bits += frame_bits(frame);
}

void BusBook::count_refused(int bus, const CanFrame& frame, bool was_counted) noexcept {
  DriveBusStats& book = stats(bus);
  ++book.refused;
  if (!was_counted) return;
  --book.sent;
  book.bits -= frame_bits(frame);
}

}  // namespace liana
