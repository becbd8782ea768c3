// What a device says of itself in its hello.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "host/api/device/liana_device.h"

namespace liana::device {

enum class Kind : std::uint8_t {
  kNone = 0,
  kHandController = LIANA_HAND_CONTROLLER,
  kVrControllers = LIANA_HANDLES,
  kPointer = LIANA_POINTER,
};

// What use_device calls it: none, hand, vr, pointer.
const char* kind_name(Kind kind);

// What lianad knows of a device before its first sample; ranges stand in liana_device.h.
struct Capability {
  std::string name;
  Kind kind = Kind::kHandController;
  std::uint32_t hands = 1;
  double rate_hz = 1000.0;
  double watchdog_s = 0.1;
  std::array<liana_hand, LIANA_MAX_HANDS> hand{};
};

// Throws std::runtime_error that names the field, its value and the range.
void check(const Capability& capability);

}  // namespace liana::device
