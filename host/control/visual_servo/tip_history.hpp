// Where the tip was by measured joint angles, for some seconds back: an image is as old as its camera is late.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "firmware_like/math/pose.hpp"

namespace liana::visual_servo {

constexpr std::size_t kHistoryLength = 256;  // command intervals of 20 ms: 5 s

class TipHistory {
 public:
  // Where the tip was at `time_s`; times not after the last one begin the history anew.
  void note(double time_s, const Pose& tip_in_base);
  // Where it was then, between two notes on a straight line; nothing for a time outside of what is remembered.
  std::optional<Pose> at(double time_s) const;

 private:
  struct Note {
    double time_s = 0.0;
    Pose tip_in_base{};
  };
  const Note& back(std::size_t notes) const;

  std::array<Note, kHistoryLength> notes_{};
  std::size_t next_ = 0;
  std::size_t count_ = 0;
};

}  // namespace liana::visual_servo
