// What a serial arm is told beside its drives: the force sensor at its wrist, and the adapter that it pushes into.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "firmware_like/serial/wrench.hpp"

namespace liana::serial {

constexpr std::uint16_t kNeverHeard = 0xFFFF;  // age of what has not come yet

// Status of a wrist reading as the sensor says it.
enum class WristStatus : std::uint8_t { kGood = 0, kSaturated = 1, kFailed = 2 };

// What the payload's side gives on the arm, about the tip's origin, in its frame. Force and torque are of one sample.
struct WristReading {
  Wrench on_arm{};
  std::uint8_t sequence = 0;  // of the sample
  WristStatus status = WristStatus::kGood;
  std::uint16_t age_ticks = kNeverHeard;  // since it came; 0: in this tick
};

// Where the adapter's latch or lock stands.
enum class CatchState : std::uint8_t { kOpen = 0, kClosing = 1, kClosed = 2, kFailed = 3 };

struct AdapterReading {
  std::uint8_t sequence = 0;  // of the message
  std::uint8_t captured = 0;  // 1: the payload is captured
  CatchState latch = CatchState::kOpen;
  CatchState lock = CatchState::kOpen;
  std::array<std::uint8_t, 3> depth_01mm{};  // of the pins [0.1 mm]
  std::uint16_t age_ticks = kNeverHeard;
};

struct Sensors {
  WristReading wrist{};
  AdapterReading adapter{};
};
static_assert(std::is_trivially_copyable_v<Sensors>);

// The sensors of the next tick as the twin imagines them: what is heard goes on saying what it says, and what is silent
// stays silent.
void predict_sensors(Sensors& sensors) noexcept;

}  // namespace liana::serial
