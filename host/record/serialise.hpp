// Inputs, Outputs and RobotTable as bytes.
#pragma once

#include <string>
#include <string_view>

#include "firmware_like/cable_controller.hpp"

namespace liana {

// Rebuilds telecommands that were released and recorded; nothing else but Release can make one.
class RecordingDecoder {
 public:
  // Inputs from their recorded bytes; throws std::runtime_error when the length is wrong.
  static cable::Inputs inputs(std::string_view bytes);
};

// Appends the recorded form: every field, little-endian, in the order of visit.hpp.
void append_serialised(std::string& out, const cable::Inputs& inputs);
void append_serialised(std::string& out, const cable::Outputs& outputs);
void append_serialised(std::string& out, const cable::RobotTable& table);

// Back again; throw std::runtime_error when the length is wrong.
cable::Outputs outputs_from(std::string_view bytes);
cable::RobotTable robot_table_from(std::string_view bytes);

// Length of the recorded form in bytes.
std::size_t serialised_inputs_size();
std::size_t serialised_outputs_size();

// Name of the Outputs field at a byte of the recorded form, e.g. "drive[3].target_counts".
std::string outputs_field_at(std::size_t offset);

}  // namespace liana
