// Received frames waiting to be fetched: fixed storage, oldest first.
#pragma once

#include <array>
#include <cstddef>

#include "host/drives/bus/drive_bus.hpp"

namespace liana::bus {

class RxRing {
 public:
  // False when full; the frame is then lost.
  bool push(const ReceivedFrame& received) noexcept {
    if (count_ == kCapacity) return false;
    ring_[(first_ + count_) % kCapacity] = received;
    ++count_;
    return true;
  }

  // False when empty.
  bool pop(ReceivedFrame& received) noexcept {
    if (count_ == 0) return false;
    received = ring_[first_];
    first_ = (first_ + 1) % kCapacity;
    --count_;
    return true;
  }

 private:
  static constexpr std::size_t kCapacity = 1024;
  std::array<ReceivedFrame, kCapacity> ring_{};
  std::size_t first_ = 0;
  std::size_t count_ = 0;
};

}  // namespace liana::bus
