// Inputs, Outputs and tables of both kinds of arm as bytes.
#pragma once

#include <string>
#include <string_view>

#include "firmware_like/cable_controller.hpp"
#include "firmware_like/serial_controller.hpp"
#include "host/storage/recording/visit.hpp"

namespace liana::recording {

// Rebuilds telecommands that were released and recorded; nothing else but Release can make one.
class RecordingDecoder {
 public:
  // Inputs from their serialised bytes; throws std::runtime_error when the length is wrong.
  template <class Arm>
  static Inputs<Arm> inputs(std::string_view bytes);
  // The same from the form that recordings hold (append_recorded).
  template <class Arm>
  static Inputs<Arm> recorded_inputs(std::string_view bytes, const RecordedCounts& counts);
};

// Appends the whole: every field, little-endian, in the order of visit.hpp.
template <class Arm>
void append_serialised(std::string& out, const Inputs<Arm>& inputs);
template <class Arm>
void append_serialised(std::string& out, const Outputs<Arm>& outputs);
void append_serialised(std::string& out, const cable::RobotParams& table);
void append_serialised(std::string& out, const serial::RobotParams& table);

// Appends what recordings hold: of arrays only what the robot has, and of a telecommand that is not there a zero.
template <class Arm>
void append_recorded(std::string& out, const Inputs<Arm>& inputs, const RecordedCounts& counts);
template <class Arm>
void append_recorded(std::string& out, const Outputs<Arm>& outputs, const RecordedCounts& counts);

// Back again; throw std::runtime_error when the length is wrong.
template <class Arm>
Outputs<Arm> outputs_from(std::string_view bytes, const RecordedCounts& counts = {});
template <class Arm>
typename Arm::Table table_from(std::string_view bytes);

// Length of the whole in bytes.
template <class Arm>
std::size_t serialised_inputs_size();
template <class Arm>
std::size_t serialised_outputs_size();

// Name of the Outputs field at a byte of the serialised form with these counts, e.g. "drive[3].target_counts".
template <class Arm>
std::string outputs_field_at(std::size_t offset, const RecordedCounts& counts = {});

}  // namespace liana::recording
