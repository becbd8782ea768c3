// What crosses the link between hand and arm every 20 ms. Times are of the side that sends, by its own clock: nothing
// here compares two clocks.
#pragma once

#include <cstdint>

#include "host/control/virtual_fixtures/hand_motion.hpp"

namespace liana::haptics {

// To the arm.
struct CommandPacket {
  std::uint32_t sequence = 0;
  std::int64_t sent_us = 0;  // by the hand's clock
  Vec3 position_m{};         // where the tip shall be, arm's base frame
};

// From the arm.
struct StatePacket {
  std::uint32_t sequence = 0;
  std::int64_t answers_us = -1;  // `sent_us` of the newest command that the arm has had, < 0: none yet
  std::int64_t held_us = 0;      // how long it had had it when this was sent, by the arm's clock
  Motion tip{};                  // arm's base frame
};

// Lets packets through in rising sequence, so that what comes late or twice is dropped. Sequences may wrap.
class Newest {
 public:
  bool accept(std::uint32_t sequence) noexcept {
    const bool newer = !begun_ || static_cast<std::int32_t>(sequence - last_) > 0;
    dropped_ += newer ? 0 : 1;
    if (newer) last_ = sequence;
    begun_ = true;
    return newer;
  }
  std::int64_t dropped() const { return dropped_; }

 private:
  bool begun_ = false;
  std::uint32_t last_ = 0;
  std::int64_t dropped_ = 0;
};

}  // namespace liana::haptics
