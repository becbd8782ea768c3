// The bench's end of the buses: who says when to run, and carries frames.
#pragma once

#include <cstdint>

#include "hil/drive/can_frame.hpp"

namespace liana::bench {

// Why and with what the bench runs now.
struct Wake {
  std::uint64_t now_us = 0;
  std::uint32_t slot = 0;  // lockstep: the slot now_us is in
  FrameList frames;        // in the order they ended
};

class Bus {
 public:
  virtual ~Bus() = default;
  // Waits for work; false when the bus has gone or a signal asks to end.
  virtual bool wait(Wake& wake) = 0;
  // Hands over what is sent now; in lockstep this is the YIELD. Throws std::runtime_error when the bus is broken.
  virtual void send(const FrameList& frames) = 0;
  // True when the bus owns virtual time: then the slot comes from it, else every SYNC is a slot.
  virtual bool lockstep() const = 0;
  virtual std::uint32_t period_us() const = 0;
  // Own frames that did not go out because a queue was full.
  virtual std::uint64_t refused() const = 0;
};

}  // namespace liana::bench
