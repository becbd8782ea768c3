// What a calibration found of the robot table's fields, as `liana calibrate` prints it.
#pragma once

#include "host/base/json/json.hpp"
#include "host/drives/calibration/prior_fit.hpp"

namespace liana::cli {

// Members fields, not_told_apart and problems.
Json fields_json(const calibration::FieldsFound& found);

// A line for each field: table, found and +-; then what cannot be told apart.
void print_fields(const calibration::FieldsFound& found, const cable::RobotParams& table);
// Nothing without problems.
void print_problems(const calibration::FieldsFound& found);

}  // namespace liana::cli
