// The wrist's force sensor: whether it is to be trusted, and what it says above its tare.
#pragma once

#include <cstdint>

#include "firmware_like/serial/sensors.hpp"

namespace liana::serial {

constexpr std::uint16_t kWristSilentTicks = 3;  // without a new sample; it sends one every tick

// Why it is not to be trusted; the numbers are the detail of kWristSensorLost and never change meaning.
enum class WristHealth : std::uint8_t {
  kGood = 0,
  kSilent = 1,  // or it repeats an old sample
  kSaturated = 2,
  kFailed = 3,
  kNoNumber = 4,
  kNotAtRest = 5,  // before a push: what is felt is too much to be a bias, or does not stand still
  kStuck = 6,      // new samples, but always the very same numbers
};

struct WristState {
  Wrench felt{};                            // newest good sample, on the arm, tip frame
  Wrench tare{};                            // what it says when nothing pushes
  WristHealth said = WristHealth::kSilent;  // of the newest sample
  std::uint8_t sequence = 0;                // of the newest sample
  std::uint16_t age_ticks = kNeverHeard;    // since there was a new one
  std::uint16_t same_samples = 0;           // new ones in a row with the very numbers of `felt`
};

// Takes the reading of a tick; a sample that was there before makes nothing fresh. A sensor that lives has noise: after
// `still_samples` new samples with the very same numbers it is stuck, whatever it says of itself; 0: never.
void read_wrist(const WristReading& reading, std::uint16_t still_samples, WristState& state) noexcept;

// Of now.
WristHealth health(const WristState& state) noexcept;

// What the arm gives to the payload's side, in the tip's frame: the negative of what is felt above the tare.
Wrench given_by_arm(const WristState& state) noexcept;

}  // namespace liana::serial
