// Inputs, Outputs and RobotTable as bytes.
#pragma once

#include <string>
#include <string_view>

#include "firmware_like/cable_controller.hpp"
#include "host/record/visit.hpp"

namespace liana {

// Rebuilds telecommands that were released and recorded; nothing else but Release can make one.
class RecordingDecoder {
 public:
  // Inputs from their serialised bytes; throws std::runtime_error when the length is wrong.
  static cable::Inputs inputs(std::string_view bytes);
  // The same from the form that recordings hold (append_recorded).
  static cable::Inputs recorded_inputs(std::string_view bytes, const RecordedCounts& counts);
};

// Appends the whole: every field, little-endian, in the order of visit.hpp.
void append_serialised(std::string& out, const cable::Inputs& inputs);
void append_serialised(std::string& out, const cable::Outputs& outputs);
void append_serialised(std::string& out, const cable::RobotTable& table);

// Appends what recordings hold: of arrays only what the robot has, and of a telecommand that is not there a zero.
void append_recorded(std::string& out, const cable::Inputs& inputs, const RecordedCounts& counts);
void append_recorded(std::string& out, const cable::Outputs& outputs, const RecordedCounts& counts);

// Back again; throw std::runtime_error when the length is wrong.
cable::Outputs outputs_from(std::string_view bytes, const RecordedCounts& counts = {});
cable::RobotTable robot_table_from(std::string_view bytes);

// Length of the whole in bytes.
std::size_t serialised_inputs_size();
std::size_t serialised_outputs_size();

// Name of the Outputs field at a byte of the serialised form with these counts, e.g. "drive[3].target_counts".
std::string outputs_field_at(std::size_t offset, const RecordedCounts& counts = {});

}  // namespace liana
