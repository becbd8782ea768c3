// The day of the calibrations that these tests make.
#pragma once

namespace liana::calibration {

constexpr const char* kDay = "2026-06-15";

}  // namespace liana::calibration
