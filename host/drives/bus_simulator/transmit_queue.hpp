// The transmit queue of one participant on one bus: bounded, lowest identifier first, first come first served among
// equals.
#pragma once

#include <array>
#include <cstddef>

#include "host/drives/bus/frame_bits.hpp"

namespace liana::bus_simulator {

constexpr std::size_t kTransmitQueueFrames = 64;

// A frame that waits for the wire.
struct WaitingFrame {
  std::uint32_t key = 0;  // arbitration
  bus::CanFrame frame;
  bool sent_before = false;
};

class TransmitQueue {
 public:
  // False when full.
  bool push(const bus::CanFrame& frame) {
    if (count_ >= kTransmitQueueFrames) return false;
    const WaitingFrame waiting{bus::arbitration_key(frame), frame, false};
    // Kept in falling order, so that the next frame to go is the last.
    insert(waiting, [&](const WaitingFrame& other) { return other.key <= waiting.key; });
    return true;
  }

  // A frame that has left the queue comes back, before its equals: there is always room for it.
  void put_back(WaitingFrame waiting) {
    waiting.sent_before = true;
    insert(waiting, [&](const WaitingFrame& other) { return other.key < waiting.key; });
  }

  bool empty() const { return count_ == 0; }
  void clear() { count_ = 0; }
  bool holds(std::uint32_t id) const {
    for (std::size_t i = 0; i < count_; ++i) {
      if (queue_[i].frame.id == id) return true;
    }
    return false;
  }
  // Priority of the next frame; not empty.
  std::uint32_t next_key() const { return queue_[count_ - 1].key; }
  // Takes the next frame; not empty.
  WaitingFrame pop() { return queue_[--count_]; }

 private:
  template <typename Yields>
  void insert(const WaitingFrame& waiting, const Yields& yields) {
    std::size_t at = count_++;
    for (; at > 0 && yields(queue_[at - 1]); --at) queue_[at] = queue_[at - 1];
    queue_[at] = waiting;
  }

  std::array<WaitingFrame, kTransmitQueueFrames + 1> queue_{};  // one more for the frame that is on the wire
  std::size_t count_ = 0;
};

}  // namespace liana::bus_simulator
