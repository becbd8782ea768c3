// Numbers of the robot table that measurements correct: its geometry (tracker_fit.hpp), its weight and springs
// (load_fit.hpp).
#pragma once

#include <string>
#include <vector>

#include "firmware_like/cable/arm/robot_params.hpp"

namespace liana::calibration {

// How far a table may be off, one standard deviation; a value further from it than kPlausibleDeviations of them is
// refused. Assumed: of the load, the bench draws half of them at most (docs/explanation/arm-control.md).
constexpr double kPlausibleDeviations = 3.0;
constexpr double kPriorLength = 0.02 / kPlausibleDeviations;      // of the table's: a module's printed or turned part
constexpr double kPriorHoleRadius = 0.05 / kPlausibleDeviations;  // of the table's: holes are wider than their cables
constexpr double kPriorEA = 0.1;                                  // of the table's
constexpr double kPriorMass = 0.1;                                // of the table's
constexpr double kPriorCenter_m = 0.01;                           // along a module; of the tool in each axis
constexpr double kPriorStiffness = 0.2;                           // of the table's
constexpr double kPriorGravity = 0.035;                           // of its amount, in each axis: 2 degrees

// One number as it was found, and its standard deviation.
struct FieldValue {
  std::string field;
  double value = 0.0;
  double sd = 0.0;
};

// One number of the robot table.
struct TableField {
  std::string field;  // as the robot table's page names it, of one segment
  double table_value = 0.0;
  double table_sd = 0.0;                     // how far it may be off, > 0
  double known_value = 0.0, known_sd = 0.0;  // before a measurement: the table's, or as know() says
  double* (*slot)(cable::RobotParams&, std::size_t index) = nullptr;
  std::size_t index = 0;  // of segment or axis

  // Most that a value found may differ from the table's.
  double room() const { return kPlausibleDeviations * table_sd; }
};

// Module length and hole radius of each segment, and stiffness of the cables.
std::vector<TableField> geometry_fields(const cable::RobotParams& table);
// With gravity mass and center of each segment's modules and of the tool, and gravity's direction; joint stiffness
// where the table has one. Empty for an arm without weight and springs.
std::vector<TableField> load_fields(const cable::RobotParams& table);
// Both, in the order of a calibration file.
std::vector<TableField> table_fields(const cable::RobotParams& table);

// What an earlier measurement found of them is known before the next one.
void know(const std::vector<FieldValue>& values, std::vector<TableField>& fields);

// The table with those of the fields for which there is a value.
void set_fields(const std::vector<TableField>& fields, const std::vector<FieldValue>& values,
                cable::RobotParams& table);

// All that is known of `fields`: what was found now, and what was known of the others.
std::vector<FieldValue> merged(const std::vector<TableField>& fields, const std::vector<FieldValue>& known,
                               const std::vector<FieldValue>& found);

}  // namespace liana::calibration
