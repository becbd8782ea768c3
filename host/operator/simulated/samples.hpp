// Both hands of a person at one moment, as a pair of VR handles tells them, about 90 Hz.
#pragma once

#include "host/api/device/sample.hpp"

namespace liana::simulated {

constexpr double kGripped = 0.5;  // of a trigger: from here on the deadman is held

// Both samples bear the same time.
struct BothHands {
  device::Sample right{};          // steers the tip
  device::Sample left{.hand = 1};  // steers a node
};

}  // namespace liana::simulated
