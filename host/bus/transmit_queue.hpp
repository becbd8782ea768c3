// The transmit queue of one participant on one bus: bounded, lowest identifier first, first come first served among equals.
#pragma once

#include <array>
#include <cstddef>

#include "host/bus/frame_bits.hpp"

namespace liana {

constexpr std::size_t kTransmitQueueFrames = 64;

class TransmitQueue {
 public:
  // False when full.
  bool push(const CanFrame& frame) {
    if (count_ == kTransmitQueueFrames) return false;
    const std::uint32_t key = arbitration_key(frame);
    std::size_t at = count_++;
    // Kept in falling order, so that the next frame to go is the last.
    for (; at > 0 && queue_[at - 1].key <= key; --at) queue_[at] = queue_[at - 1];
    queue_[at] = {key, frame};
    return true;
  }

  bool empty() const { return count_ == 0; }
  // Priority of the next frame; not empty.
  std::uint32_t next_key() const { return queue_[count_ - 1].key; }
  // Takes the next frame; not empty.
  CanFrame pop() { return queue_[--count_].frame; }

 private:
  struct Entry {
    std::uint32_t key = 0;
    CanFrame frame;
  };
  std::array<Entry, kTransmitQueueFrames> queue_{};
  std::size_t count_ = 0;
};

}  // namespace liana
