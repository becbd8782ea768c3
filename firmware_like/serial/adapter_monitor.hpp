// What the adapter says, and whether it has said it just now.
#pragma once

#include <cstdint>

#include "firmware_like/serial/sensors.hpp"

namespace liana::serial {

constexpr std::uint16_t kAdapterSilentTicks = 12;  // it sends a message every fourth tick
constexpr std::uint8_t kPastFace_01mm = 10;        // a pin so deep has left the mouth of its funnel [0.1 mm]

struct AdapterState {
  AdapterReading last{};                  // newest message; its age is that of the sequence
  bool is_new = false;                    // it came in this tick, with another sequence than the one before
  std::uint32_t repeated = 0;             // messages that came with the sequence of the one before
  std::uint16_t age_ticks = kNeverHeard;  // since a new sequence
};

// Takes the reading of a tick. A message counts once: one with the sequence of the one before says nothing new.
void read_adapter(const AdapterReading& reading, AdapterState& state) noexcept;

// It speaks: a new message came within kAdapterSilentTicks.
inline bool is_heard(const AdapterState& state) noexcept { return state.age_ticks < kAdapterSilentTicks; }

// Every pin is past the adapter's face, as its depth sensors say: what is left to meet is the holes, and they are
// narrow.
bool pins_are_in(const AdapterState& state) noexcept;

// It says in this tick, with a message of its own, that the payload is captured.
inline bool says_captured(const AdapterState& state) noexcept { return state.is_new && state.last.captured != 0; }

}  // namespace liana::serial
