// What is told of the way back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "host/base/event/event.hpp"

namespace liana::arbiter {

enum class RetractPhase : std::uint8_t {
  kNone = 0,      // nobody has asked for it, or the arm has moved on since
  kStopping = 1,  // the arm comes to rest first
  kJoining = 2,   // onto the path, from where the arm was enabled beside it
  kBack = 3,      // along the path
  kDone = 4,      // all the way, and at rest there
  kEnded = 5,     // over before its end; the reason says why
};

// snake_case, as the state message has it.
const char* retract_phase_name(RetractPhase phase);

// What a retract is doing, or how the last one went.
struct RetractState {
  RetractPhase phase = RetractPhase::kNone;
  std::size_t points_left = 0;  // of the path, one for each command interval of the way in
  std::size_t points = 0;       // with which it began
  std::string reason;           // of kEnded, one sentence; else empty
};

// What has become of the way back.
struct RetractEvents {
  event::RetractEvent what = event::RetractEvent::kBegins;
  std::size_t points = 0;   // left to go, or kept
  double distance_m = 0.0;  // of the arm from the path, where that is what is told of
  std::string text;         // one sentence for people
};

}  // namespace liana::arbiter
