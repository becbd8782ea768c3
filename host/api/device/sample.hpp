// What every input device delivers: one hand at one moment, whoever the device is.
#pragma once

#include <cstdint>

#include "firmware_like/math/pose.hpp"

namespace liana::device {

struct Twist {
  Vec3 linear_m_s{};
  Vec3 angular_rad_s{};
};

// The device frame is parallel to the arm's base frame.
struct Sample {
  std::int64_t t_us = 0;      // when it was measured, by the device's clock
  std::uint32_t hand = 0;     // 0 moves the tip, 1 a node of the arm
  bool valid = true;          // false: tracking lost, the pose is the last one known
  bool deadman = false;       // held: the arm follows
  bool stale = false;         // the device has told nothing new: what this says is old, whatever its time
  std::uint32_t buttons = 0;  // bit i: button i is pressed
  double trigger = 0.0;       // 0 open .. 1 closed
  Pose pose{};                // of the hand in the device frame
  Twist twist{};              // zeros where it is not sensed
};

}  // namespace liana::device
