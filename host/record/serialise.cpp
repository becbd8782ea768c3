#include "host/record/serialise.hpp"

#include "host/record/codec.hpp"

namespace liana {

namespace {

void check_length(std::size_t used, std::size_t given, const char* what) {
  if (used == given) return;
  throw std::runtime_error(std::string("recording: ") + what + " has " + std::to_string(given) + " bytes, expected " +
                           std::to_string(used) + "; it was made by another version");
}

template <class T>
T read_all(std::string_view bytes, const char* what) {
  T value{};
  Reader reader(bytes);
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

}  // namespace

Inputs RecordingDecoder::inputs(std::string_view bytes) {
  Inputs inputs;
  TelecommandFields fields;
  Reader reader(bytes);
  visit(reader, inputs);
  visit(reader, fields);
  check_length(reader.position(), bytes.size(), "inputs");
  inputs.telecommand =
      Telecommand(fields.sequence, fields.first_tick, fields.expiry_tick, fields.owner, fields.setpoint);
  return inputs;
}

void append_serialised(std::string& out, const Inputs& inputs) {
  const Telecommand& t = inputs.telecommand;
  const TelecommandFields fields{t.sequence(), t.first_tick(), t.expiry_tick(), t.owner(), t.setpoint()};
  Writer writer(out);
  visit(writer, inputs);
  visit(writer, fields);
}

void append_serialised(std::string& out, const Outputs& outputs) {
  Writer writer(out);
  visit(writer, outputs);
}

void append_serialised(std::string& out, const RobotTable& table) {
  Writer writer(out);
  visit(writer, table);
}

Outputs outputs_from(std::string_view bytes) { return read_all<Outputs>(bytes, "outputs"); }
RobotTable robot_table_from(std::string_view bytes) { return read_all<RobotTable>(bytes, "robot_table"); }

std::size_t serialised_inputs_size() {
  static const std::size_t kSize = size_of<Inputs>();
  return kSize;
}

std::size_t serialised_outputs_size() {
  static const std::size_t kSize = size_of<Outputs>();
  return kSize;
}

std::string outputs_field_at(std::size_t offset) {
  FieldNamer namer(offset);
  const Outputs outputs;
  visit(namer, outputs);
  return namer.found();
}

}  // namespace liana
