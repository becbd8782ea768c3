// One cell of the stability map: a hand, a wall and a delay under one law, with a layer or without, judged at the
// device's port by energy and speed. Where it drifts to is reported and not judged: a free hand may rest anywhere.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "host/operator/haptics/feedback_law.hpp"

namespace liana::numbers {

inline constexpr std::array kMasses_kg{0.5, 2.0};
inline constexpr std::array kHands_N_m{0.0, 100.0, 300.0, 1000.0};
inline constexpr std::array kWalls_N_m{0.0, 500.0, 5000.0, 20000.0};
inline constexpr std::array kDelays_s{0.0, 0.1, 0.5, 1.0, 2.0, 4.0};  // there and back; the task is 0 to 2 s
constexpr double kStill_m_s = 0.002;                                  // peak speed that counts as rest
constexpr double kDecaying = 0.6;                                     // of the peak speed 15 s before
constexpr double kAllowed_J = -0.1;

// What stands between the law and the motors besides clamp and rate limit.
enum class Layer : std::uint8_t { kNone, kTank, kTankAndDamping };
constexpr std::array<std::string_view, 3> kLayerNames{"none", "tank", "tank and damping"};

struct Cell {
  double hand_kg = 0.0;
  double hand_N_m = 0.0;
  double wall_N_m = 0.0;
  double delay_s = 0.0;
};

struct Verdict {
  double speed_m_s = 0.0;            // peak in the last 15 s
  double before_m_s = 0.0;           // peak in the 15 s before
  double least_J = 0.0;              // energy at the port, least of all times
  double drift_m = 0.0;              // from the beginning to the end of the last 15 s
  double drag_N = 0.0;               // felt of the arm on the way out (4 s), mean; without a wall it should be nothing
  double held_N = 0.0;               // felt at the end of pressing, mean of 1 s
  double taken_pressing_N = 0.0;     // RMS of what the tank took from the force in 5 s of pressing
  double taken_withdrawing_N = 0.0;  // and in the 2 s after

  bool moving() const { return speed_m_s > kStill_m_s && speed_m_s > kDecaying * before_m_s; }
  bool active() const { return least_J < kAllowed_J; }
  bool unstable() const { return moving() || active(); }
};

// All 192, by delay, hand, mass, wall.
std::vector<Cell> cells();

// 43 s of the reach of the rig and what follows; the same bits for the same arguments.
Verdict judge(haptics::Law law, Layer layer, const Cell& cell, std::uint64_t seed);

struct Judged {
  haptics::Law law{};
  Layer layer{};
  Cell cell{};
  Verdict verdict{};
};

}  // namespace liana::numbers
