// Whether the model that verification predicts with still describes the arm: where it is against where it is told to
// be, what its cables pull against what they are planned to.
#pragma once

#include "firmware_like/cable_controller.hpp"
#include "firmware_like/serial_controller.hpp"
#include "host/control/verification/verdict.hpp"

namespace liana::verification {

// Bands of a cable arm, 2.5 and 1.3 times what whole missions show with friction up to 0.12, declared or not.
constexpr double kModelAngle_rad = 0.0175;  // measured against commanded theta: 1 deg
constexpr double kModelTension_N = 30.0;    // measured against planned tension
constexpr double kModelTensionShare =
    0.5;                                 // of the planned one, added to it; where the bend's friction takes more, that,
constexpr double kModelBendShare = 2.0;  // up to so much

// Refuses (M_e 109) a verdict on predictions of a model that does not describe the arm at the start, `now`: the arm
// holds. Where a fault is latched, that says more. `then` is the end of the prediction: the way back (`leads_back`) and
// a motion that straightens the arm are not refused for tensions of its bend, the way back for nothing here.
void judge_model(const cable::RobotParams& table, const cable::Outputs& now, const cable::Outputs& then,
                 bool leads_back, ExecutionVerdict& verdict);
// Serial arms have drives that follow, or a following error: nothing is refused here.
inline void judge_model(const serial::RobotParams&, const serial::Outputs&, const serial::Outputs&, bool,
                        ExecutionVerdict&) {}

}  // namespace liana::verification
