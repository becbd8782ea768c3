// What length and tension of a cable say about each other: a cable that slipped on its drum, an encoder that jumped, a
// reading that scatters, lengths that contradict each other. Derivation and measured limits:
// docs/explanation/fault-detection.md.
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/cable/arm/robot_params.hpp"
#include "firmware_like/safety/faults.hpp"

namespace liana::cable {

constexpr std::uint8_t kJumpConfirmTicks = 3;  // a jump has to stay this long, the tick it came in included
constexpr std::uint8_t kContradictionTicks =
    25;  // in a row: whatever is quick is named by what it does, not by what it contradicts
constexpr std::uint8_t kScatterReversals = 3;      // a reading that jumped back so often scatters
constexpr std::uint64_t kScatterForgetTicks = 64;  // one reversal is forgotten in so many ticks

// Limits derived once from the robot table.
struct CableWatchLimits {
  std::int32_t cable_count = 0;
  double jump_N = 0.0;            // most that tension may change in a tick without length or planned pose to explain it
  CableVector stiffness_N_m{};    // from drum to anchor; 0 beyond the last cable
  CableVector contradiction_m{};  // most that the part of a length that no angles explain may change while enabled
  CableVector hidden_m_N{};  // and more for each newton: stretch that friction hides, told wrong by as much as it is
};

// Limits of a checked table. `zero_payout_m` per cable: path at the zero pose plus lead.
CableWatchLimits make_cable_watch_limits(const RobotParams& table, const CableVector& zero_payout_m) noexcept;

struct CableMonitorState {
  bool watching = false;    // the members below are of this enabling
  std::uint8_t newest = 0;  // of the two levels
  std::array<CableVector, 2>
      level_N{};  // measured tension less what the stretch at the planned pose explains: this tick's, the last one's
  CableVector residual_m{};             // the estimator's when watching began
  std::int32_t segment = 0, cable = 0;  // whose contradiction is looked at next, and its first cable
  std::uint8_t contradicts_ticks = 0;   // of that segment, in a row
  std::int32_t suspect = -1;            // cable that jumped
  std::uint8_t suspect_ticks = 0;       // since its last jump
  bool suspect_rose = false;            // direction of that jump
  double suspect_from_N = 0.0;          // its level before
  std::uint8_t reversals = 0;           // jumps back, less what was forgotten
};

// What one tick knows about the cables.
struct CableReadings {
  const CableVector& payout_m;    // measured
  const CableVector& tension_N;   // measured
  const CableVector& path_m;      // at the planned pose
  const CableVector& residual_m;  // of the estimator
};

// Looks for jumps of any cable and at the contradiction of one segment; latches what it finds. `usable`: the arm is
// enabled, every reading is of this tick, nothing is latched; otherwise watching begins anew. Cost: seven instructions
// a cable.
void watch_cables(const RobotParams& table, const CableWatchLimits& limits, const CableReadings& now, bool usable,
                  std::uint64_t tick, CableMonitorState& state, FaultList& faults) noexcept;

}  // namespace liana::cable
