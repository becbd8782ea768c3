#include "host/drives/bus/bus_entry.hpp"

#include <linux/can/error.h>

#include "host/drives/bus/frame_bits.hpp"

namespace liana::bus {

void BusEntry::store(int bus, const CanFrame& frame) noexcept {
  DriveBusStats& book = stats(bus);
  if ((frame.id & kCanErrorFlag) != 0) return note_error_frame(book, frame);
  if (book.state == BusState::kDown) book.state = BusState::kActive;
  ++book.received;
  book.bits += frame_bits(frame);
  const std::uint32_t page = frame.id & ~0x7FU;
  if ((page == 0x180 || page == 0x380) && frame.id != page) ++feedback_;
  if (!ring_.push({bus, frame})) ++book.dropped;
}

void BusEntry::note_error_frame(DriveBusStats& book, const CanFrame& frame) noexcept {
  ++book.errors;
  constexpr std::uint8_t kPassive = CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE;
  constexpr std::uint8_t kActive = CAN_ERR_CRTL_ACTIVE | CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING;
  const std::uint8_t controller = (frame.id & CAN_ERR_CRTL) != 0 ? frame.data[1] : std::uint8_t{0};
  if ((frame.id & CAN_ERR_BUSOFF) != 0) {
    book.state = BusState::kBusOff;
  } else if ((controller & kPassive) != 0) {
    book.state = BusState::kErrorPassive;
  } else if ((frame.id & CAN_ERR_RESTARTED) != 0 ||
             (book.state == BusState::kErrorPassive && (controller & kActive) != 0)) {
    book.state = BusState::kActive;
  }
}

void BusEntry::take_record(const wire::Frame& record) noexcept {
  const CanFrame frame = wire::to_can_frame(record);
  if ((record.flags & wire::kFrameRefused) != 0) return count_refused(record.bus, frame, true);
  if ((record.flags & wire::kFrameLink) == 0) return store(record.bus, frame);
  stats(record.bus).state = frame.data[0] != 0 ? BusState::kActive : BusState::kDown;
}

void BusEntry::count_sent(int bus, const CanFrame& frame) noexcept {
  DriveBusStats& book = stats(bus);
  ++book.sent;
  book.bits += frame_bits(frame);
}

void BusEntry::count_refused(int bus, const CanFrame& frame, bool was_counted) noexcept {
  DriveBusStats& book = stats(bus);
  ++book.refused;
  if (!was_counted) return;
  --book.sent;
  book.bits -= frame_bits(frame);
}

}  // namespace liana::bus
