// Tremor stage: takes 8 to 12 Hz, where hands tremble, out of a tip target that comes tick by tick.
//
// Three notches in a row: at least 28 dB from 8 to 12 Hz at 250 Hz, no gain above 0 dB anywhere, 35 ms late
// (kTremorLag_s). A notch is its input less a band pass of it. What is kept is that band pass, the offset of the output
// from the input, and it is driven by the input's steps alone: it dies away where the target rests, wherever that is,
// and attitudes, of which steps and offsets are small turns in the base frame, neither drift nor wrap. 540 bytes of
// state; some 1100 instructions a tick.
#pragma once

#include <array>

#include "firmware_like/math/pose.hpp"

namespace liana {

constexpr std::size_t kNotches = 3;
constexpr double kTremorLag_s = 0.035;        // behind a target of constant velocity
constexpr double kLongestNotchTick_s = 0.02;  // longer ticks carry no such frequencies: the target passes as it is

// One notch of three coordinates; metres or radians.
struct NotchState {
  Vec3 step{};     // of its input, at the last tick
  Vec3 offset{};   // of its output from its input, at the last tick
  Vec3 earlier{};  // and at the tick before
};
using NotchChain = std::array<NotchState, kNotches>;

struct TremorState {
  bool begun = false;  // false: the next target is taken for one that has always rested there
  Pose target{};       // of the last tick
  NotchChain linear{};
  NotchChain angular{};
};

// A target without tremor, and how fast it moves.
struct SteadyTarget {
  Pose pose{};
  Vec3 velocity_m_s{};  // in the base frame
  Vec3 rate_rad_s{};    // in the base frame
};

// One tick. `target` has to be a valid pose. One that jumps, by more than 0.25 m or 1 rad in a tick, is no hand's: the
// stage begins anew there.
SteadyTarget without_tremor(const Pose& target, double tick_s, TremorState& state) noexcept;

}  // namespace liana
