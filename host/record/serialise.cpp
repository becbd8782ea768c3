#include "host/record/serialise.hpp"

#include "firmware_like/command/release.hpp"
#include "host/record/codec.hpp"

namespace liana {

namespace {

void check_length(std::size_t used, std::size_t given, const char* what) {
  if (used == given) return;
  throw std::runtime_error(std::string("recording: ") + what + " has " + std::to_string(given) + " bytes, expected " +
                           std::to_string(used) + "; it was made by another version");
}

template <class T>
T read_all(std::string_view bytes, const char* what, const RecordedCounts& counts = {}) {
  T value{};
  Reader reader(bytes, counts);
  visit(reader, value);
  check_length(reader.position(), bytes.size(), what);
  return value;
}

template <class T>
std::size_t size_of() {
  std::string bytes;
  append_serialised(bytes, T{});
  return bytes.size();
}

TelecommandFields fields_of(const cable::Telecommand& t) {
  return {t.sequence(), t.first_tick(), t.expiry_tick(), t.owner(), t.setpoint()};
}

}  // namespace

cable::Inputs RecordingDecoder::recorded_inputs(std::string_view bytes, const RecordedCounts& counts) {
  cable::Inputs inputs;
  TelecommandFields fields;
  std::uint8_t present = 0;
  Reader reader(bytes, counts);
  visit(reader, inputs);
  reader("telecommand_present", present);
  if (present != 0) visit(reader, fields);
  check_length(reader.position(), bytes.size(), "inputs");
  inputs.telecommand =
      Release::make(fields.sequence, fields.first_tick, fields.expiry_tick, fields.owner, fields.setpoint);
  return inputs;
}

void append_recorded(std::string& out, const cable::Inputs& inputs, const RecordedCounts& counts) {
  Writer writer(out, counts);
  visit(writer, inputs);
  const bool present = inputs.telecommand.kind() != CommandKind::kNone;
  writer("telecommand_present", static_cast<std::uint8_t>(present ? 1 : 0));
  if (present) writer("telecommand", fields_of(inputs.telecommand));
}

void append_recorded(std::string& out, const cable::Outputs& outputs, const RecordedCounts& counts) {
  Writer writer(out, counts);
  visit(writer, outputs);
}

cable::Inputs RecordingDecoder::inputs(std::string_view bytes) {
  cable::Inputs inputs;
  TelecommandFields fields;
  Reader reader(bytes);
  visit(reader, inputs);
  visit(reader, fields);
  check_length(reader.position(), bytes.size(), "inputs");
  inputs.telecommand =
      Release::make(fields.sequence, fields.first_tick, fields.expiry_tick, fields.owner, fields.setpoint);
  return inputs;
}

void append_serialised(std::string& out, const cable::Inputs& inputs) {
  Writer writer(out);
  visit(writer, inputs);
  writer("telecommand", fields_of(inputs.telecommand));
}

void append_serialised(std::string& out, const cable::Outputs& outputs) {
  Writer writer(out);
  visit(writer, outputs);
}

void append_serialised(std::string& out, const cable::RobotTable& table) {
  Writer writer(out);
  visit(writer, table);
}

cable::Outputs outputs_from(std::string_view bytes, const RecordedCounts& counts) {
  return read_all<cable::Outputs>(bytes, "outputs", counts);
}
cable::RobotTable robot_table_from(std::string_view bytes) { return read_all<cable::RobotTable>(bytes, "robot_table"); }

std::size_t serialised_inputs_size() {
  static const std::size_t kSize = size_of<cable::Inputs>();
  return kSize;
}

std::size_t serialised_outputs_size() {
  static const std::size_t kSize = size_of<cable::Outputs>();
  return kSize;
}

std::string outputs_field_at(std::size_t offset, const RecordedCounts& counts) {
  FieldNamer namer(offset, counts);
  const cable::Outputs outputs;
  visit(namer, outputs);
  return namer.found();
}

}  // namespace liana
