// Emergency messages of the drives (CiA 301), kept until somebody fetches them.
#pragma once

#include <array>
#include <cstdint>

#include "host/drives/bus/can_frame.hpp"

namespace liana::canopen {

struct Emergency {
  int bus = 0;
  std::uint8_t node = 0;
  std::uint16_t code = 0;           // 0 = errors are gone
  std::uint8_t error_register = 0;  // 0x1001
  std::array<std::uint8_t, 5> vendor{};
  std::uint64_t tick = 0;
};

// What a code means, by CiA 301 and 402 (class, or the exact one where it is known).
const char* emergency_text(std::uint16_t code) noexcept;

class EmergencyLog {
 public:
  // A frame with COB-ID 0x080 + node; shorter than 8 bytes is ignored. The oldest is dropped, and counted, when 64 are
  // waiting.
  void on_frame(int bus, std::uint8_t node, const bus::CanFrame& frame, std::uint64_t tick) noexcept;
  // Fetches the oldest; false when there is none.
  bool take(Emergency& emergency) noexcept;
  // The last code of node 1..127, 0 when none or cleared.
  std::uint16_t last_code(std::uint8_t node) const noexcept { return last_code_[node & 0x7F]; }
  std::uint64_t dropped() const noexcept { return dropped_; }

 private:
  static constexpr std::size_t kCapacity = 64;
  std::array<Emergency, kCapacity> ring_{};
  std::array<std::uint16_t, 128> last_code_{};
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace liana::canopen
