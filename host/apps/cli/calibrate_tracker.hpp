// `liana calibrate --tracker`.
#pragma once

#include "host/apps/cli/commands.hpp"
#include "host/model/config/config.hpp"

namespace liana::cli {

// Geometry, stiffness and cables' zeros from the poses that an external tracker saw during a run; no arm moves. The
// result is added to the calibration that is given. Exit code 1 when a value is beyond what is plausible.
int calibrate_by_tracker(const CalibrateOptions& options, const config::RobotConfig& robot);

}  // namespace liana::cli
