// A slow dither of the tensions: all cables together pull in turn tighter and looser, in proportion, which turns no
// joint and frees what friction holds. What is measured after it is the force itself
// (docs/explanation/contact-force.md).
#pragma once

#include "firmware_like/cable/arm/robot_params.hpp"

namespace liana::cable {

constexpr double kDitherMost = 0.3;  // share of the planned tensions, either way
constexpr double kDither_hz = 1.0;
constexpr double kDitherSlew_1_s = 0.6;   // the share changes no faster, so that nothing jumps at begin and end
constexpr double kDitherFade_1_s = 10.0;  // friction that is held is freed at this rate times the share
constexpr double kDitherSettle_s = 2.0;   // until torques have followed, after its end

struct DitherState {
  double share = 0.0;     // of the planned tensions, now
  double turn = 0.0;      // of the oscillation, 0 to 1
  double settle_s = 0.0;  // left after its end
};

// One tick towards `wanted`; tensions are those planned times 1 plus the result.
double advance_dither(double wanted, double tick_s, DitherState& state) noexcept;

// True while it is under way or has only just ended.
inline bool is_dithering(const DitherState& state) noexcept { return state.share > 0.0 || state.settle_s > 0.0; }

// Every planned tension stays within floor and ceiling of free motion.
bool dither_fits(const RobotParams& table, const CableVector& planned_N, double share) noexcept;

}  // namespace liana::cable
