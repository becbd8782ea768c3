// What input devices deliver: one sample of a hand controller or of a pair of VR handles (docs/api.md,
// docs/formats.md).
#pragma once

#include <cstdint>

#include "firmware_like/math/pose.hpp"

namespace liana::operator_side {

// Hand controller, about 1 kHz; pose in the device frame (parallel to the arm's base frame), metres.
struct ControllerSample {
  std::int64_t t_us = 0;
  bool valid = true;    // false: the pose is the last one known
  bool button = false;  // deadman: held = engaged
  Pose pose{};
};

// One VR handle.
struct VrHandle {
  bool valid = true;     // false: tracking lost, the pose is the last one known
  double trigger = 0.0;  // 0..1; over 0.5 = engaged
  Pose pose{};
};

// Both VR handles, about 90 Hz: right steers the tip, left a node.
struct VrSample {
  std::int64_t t_us = 0;
  VrHandle right{};
  VrHandle left{};
};

}  // namespace liana::operator_side
