#include "host/storage/recording/serialise.hpp"

#include "firmware_like/command/release.hpp"
#include "host/storage/recording/codec.hpp"

namespace liana::recording {

namespace {

template <class Arm>
using Fields = TelecommandFields<typename Arm::Setpoint>;

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

}  // namespace

template <class Setpoint>
Telecommand<Setpoint> telecommand_of(const TelecommandFields<Setpoint>& f) {
  return Release::make(f.sequence, f.first_tick, f.expiry_tick, f.owner, f.setpoint);
}

template <class Arm>
Inputs<Arm> RecordingDecoder::recorded_inputs(std::string_view bytes, const RecordedCounts& counts) {
  Inputs<Arm> inputs;
  Fields<Arm> fields;
  std::uint8_t present = 0;
  Reader reader(bytes, counts);
  visit(reader, inputs);
  reader("telecommand_present", present);
  if (present != 0) visit(reader, fields);
  check_length(reader.position(), bytes.size(), "inputs");
  inputs.telecommand = telecommand_of(fields);
  return inputs;
}

template <class Arm>
void append_recorded(std::string& out, const Inputs<Arm>& inputs, const RecordedCounts& counts) {
  Writer writer(out, counts);
  visit(writer, inputs);
  const bool present = inputs.telecommand.kind() != CommandKind::kNone;
  writer("telecommand_present", static_cast<std::uint8_t>(present ? 1 : 0));
  if (present) writer("telecommand", fields_of(inputs.telecommand));
}

template <class Arm>
void append_recorded(std::string& out, const Outputs<Arm>& outputs, const RecordedCounts& counts) {
  Writer writer(out, counts);
  visit(writer, outputs);
}

template <class Arm>
Inputs<Arm> RecordingDecoder::inputs(std::string_view bytes) {
  Inputs<Arm> inputs;
  Fields<Arm> fields;
  Reader reader(bytes);
  visit(reader, inputs);
  visit(reader, fields);
  check_length(reader.position(), bytes.size(), "inputs");
  inputs.telecommand = telecommand_of(fields);
  return inputs;
}

template <class Arm>
void append_serialised(std::string& out, const Inputs<Arm>& inputs) {
  Writer writer(out);
  visit(writer, inputs);
  writer("telecommand", fields_of(inputs.telecommand));
}

template <class Arm>
void append_serialised(std::string& out, const Outputs<Arm>& outputs) {
  Writer writer(out);
  visit(writer, outputs);
}

void append_serialised(std::string& out, const cable::RobotParams& table) {
  Writer writer(out);
  visit(writer, table);
}

void append_serialised(std::string& out, const serial::RobotParams& table) {
  Writer writer(out);
  visit(writer, table);
}

template <class Arm>
Outputs<Arm> outputs_from(std::string_view bytes, const RecordedCounts& counts) {
  return read_all<Outputs<Arm>>(bytes, "outputs", counts);
}

template <class Arm>
typename Arm::Table table_from(std::string_view bytes) {
  return read_all<typename Arm::Table>(bytes, "robot_table");
}

template <class Arm>
std::size_t serialised_inputs_size() {
  static const std::size_t kSize = size_of<Inputs<Arm>>();
  return kSize;
}

template <class Arm>
std::size_t serialised_outputs_size() {
  static const std::size_t kSize = size_of<Outputs<Arm>>();
  return kSize;
}

template <class Arm>
std::string outputs_field_at(std::size_t offset, const RecordedCounts& counts) {
  std::string found;
  std::size_t at = 0;
  const auto look = [&](const std::string& path, std::size_t bytes) {
    if (at <= offset && offset < at + bytes) found = path;
    at += bytes;
  };
  FieldWalker walker(look, counts);
  const Outputs<Arm> outputs;
  visit(walker, outputs);
  return found;
}

#define LIANA_SERIALISED(Arm)                                                                           \
  template Telecommand<Arm::Setpoint> telecommand_of(const TelecommandFields<Arm::Setpoint>&);          \
  template Inputs<Arm> RecordingDecoder::recorded_inputs<Arm>(std::string_view, const RecordedCounts&); \
  template Inputs<Arm> RecordingDecoder::inputs<Arm>(std::string_view);                                 \
  template void append_recorded(std::string&, const Inputs<Arm>&, const RecordedCounts&);               \
  template void append_recorded(std::string&, const Outputs<Arm>&, const RecordedCounts&);              \
  template void append_serialised(std::string&, const Inputs<Arm>&);                                    \
  template void append_serialised(std::string&, const Outputs<Arm>&);                                   \
  template Outputs<Arm> outputs_from<Arm>(std::string_view, const RecordedCounts&);                     \
  template Arm::Table table_from<Arm>(std::string_view);                                                \
  template std::size_t serialised_inputs_size<Arm>();                                                   \
  template std::size_t serialised_outputs_size<Arm>();                                                  \
  template std::string outputs_field_at<Arm>(std::size_t, const RecordedCounts&);
LIANA_SERIALISED(cable::CableArm)
LIANA_SERIALISED(serial::SerialArm)
#undef LIANA_SERIALISED

}  // namespace liana::recording
