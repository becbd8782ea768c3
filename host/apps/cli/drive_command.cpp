// `liana drive`: one motor on a desk, before there is a robot table.
#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>

#include "host/apps/cli/arguments.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/cli/drive_session.hpp"
#include "host/apps/cli/drive_value.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/base/json/json.hpp"
#include "host/drives/canopen/cob_id.hpp"
#include "host/model/config/drive_type.hpp"
#include "host/model/config/field.hpp"

namespace liana::cli {
namespace {

config::ObjectId object_of(const std::string& text) {
  const Json json = text;
  return launcher::checked([&] { return config::parse_object(config::Field(json, "drive", "OBJECT"), text); });
}

Json found_json(DriveSession& session, commissioning::Place at) {
  Json out = {{"bus", session.buses.buses[static_cast<std::size_t>(at.bus)].name}, {"node", at.node}, {"axis", 1}};
  const commissioning::Answer type = session.desk.read(at, 0x1000, 0);
  if (type.odd_length) out["answer_bytes"] = *type.odd_length;
  const auto add = [&](const char* key, std::uint16_t index, std::uint8_t sub) {
    const commissioning::Answer answer = session.desk.read(at, index, sub);
    if (!answer.is_done()) return;
    if (const std::optional<std::string> text = text_of(answer.bytes)) {
      out[key] = *text;
    } else if (answer.bytes.size() <= 4) {
      out[key] = answer.value();
    }
  };
  add("device_type", 0x1000, 0);
  add("vendor", 0x1018, 1);
  add("product", 0x1018, 2);
  add("revision", 0x1018, 3);
  add("serial", 0x1018, 4);
  add("name", 0x1008, 0);
  add("modes", 0x6502, 0);
  return out;
}

// Appends a node, once for each axis that has modes: identity and name are the node's.
void add_found(DriveSession& session, commissioning::Place at, Json& all) {
  Json found = found_json(session, at);
  const bool is_drive = found.contains("modes");
  all.push_back(found);
  for (std::uint8_t axis = 2; is_drive && axis <= config::kMaxAxes; ++axis) {
    const commissioning::Answer modes = session.desk.read(at, canopen::on_axis(0x6502, axis), 0);
    if (!modes.is_done()) return;
    found["axis"] = axis;
    found["modes"] = modes.value();
    all.push_back(found);
  }
}

std::string place_of(const Json& found) {
  const int axis = found["axis"].get<int>();
  return found["bus"].text() + " node " + std::to_string(found["node"].get<int>()) +
         (axis > 1 ? ", axis " + std::to_string(axis) : "");
}

std::string described(const Json& found) {
  const auto number = [&](const char* key) {
    return found.contains(key) ? hex(found[key].get<std::uint32_t>(), 1) : std::string("-");
  };
  const bool has_csp = (found.value<std::uint32_t>("modes", 0) & 0x80) != 0;
  if (found.contains("answer_bytes"))
    return place_of(found) + ": answers with " + std::to_string(found["answer_bytes"].get<int>()) +
           " bytes, and an SDO answer has 8 (CiA 301)";
  return place_of(found) + ": vendor " + number("vendor") + ", product " + number("product") + ", revision " +
         number("revision") + ", serial " + number("serial") +
         (found.contains("name") && found["name"].is_string() ? ", \"" + found["name"].text() + "\"" : "") +
         (found.contains("modes") ? (has_csp ? ", has csp" : ", has no csp") : ", is no CiA 402 drive");
}

bool is_of_another_size(const commissioning::Answer& answer) {
  constexpr std::array<std::uint32_t, 3> kLengths{0x06070010, 0x06070012, 0x06070013};
  return std::find(kLengths.begin(), kLengths.end(), answer.abort_code) != kLengths.end();
}

}  // namespace

int drive_scan_command(const DriveOptions& options) {
  const auto first = static_cast<std::uint8_t>(parse_whole("--first", options.first, 1, kMaxNode));
  const auto last = static_cast<std::uint8_t>(parse_whole("--last", options.last, first, kMaxNode));
  DriveSession session(options);
  Json all = Json::array();
  for (const commissioning::Place at : session.desk.scan(first, last)) add_found(session, at, all);
  if (options.json) {
    std::printf("%s\n", all.dump().c_str());
  } else {
    for (const Json& each : all) std::printf("%s\n", described(each).c_str());
    if (all.empty()) std::printf("nobody answers: check supply, bit rate, termination and node ids\n");
  }
  return all.empty() ? kNobodyAnswers : launcher::ExitCode::kExitOk;
}

int drive_read_command(const DriveOptions& options) {
  const config::ObjectId object = object_of(options.object);
  const std::uint8_t node = node_of(options);
  DriveSession session(options);
  const commissioning::Place at = session.place(node);
  const commissioning::Answer answer = session.desk.read(at, object.index, object.sub);
  if (!answer.is_done())
    return tell_failure(session, at, "reading " + config::object_name(object), answer, options.json);
  if (options.json) {
    Json said = value_json(answer);
    said["node"] = at.node;
    said["object"] = config::object_name(object);
    said["ok"] = true;
    std::printf("%s\n", said.dump().c_str());
  } else {
    std::printf("%s = %s\n", config::object_name(object).c_str(), value_text(answer).c_str());
  }
  return launcher::ExitCode::kExitOk;
}

int drive_write_command(const DriveOptions& options) {
  const config::ObjectId object = object_of(options.object);
  const std::int64_t bits = parse_whole("--bits", options.bits, 8, 32, ": 8, 16 or 32");
  if (bits != 8 && bits != 16 && bits != 32)
    throw launcher::BadInput("--bits: '" + options.bits + "': allowed 8, 16 or 32, the size of the object");
  const std::int64_t most = (std::int64_t{1} << bits) - 1;
  const std::int64_t value = value_of(options.value, bits);
  if (object.index == 0x6040 || object.index == 0x6060)
    throw launcher::BadInput("OBJECT: " + options.object + ": this switches torque: allowed is any other object");
  const std::uint8_t node = node_of(options);
  std::array<std::uint8_t, 4> bytes{};
  for (std::size_t i = 0; i < 4; ++i) bytes[i] = static_cast<std::uint8_t>(value >> (8 * i));
  DriveSession session(options);
  refuse_beside_a_master(session);
  const commissioning::Place at = session.place(node);
  const std::string what = "writing " + options.value + " to " + config::object_name(object);
  const commissioning::Answer written =
      session.desk.write(at, object.index, object.sub, {bytes.data(), static_cast<std::size_t>(bits / 8)});
  if (!written.is_done()) {
    const char* remedy =
        is_of_another_size(written) ? ": give --bits as liana drive read says them of this object" : "";
    return tell_failure(session, at, what, written, options.json, remedy);
  }
  const commissioning::Answer answer = session.desk.read(at, object.index, object.sub);
  const bool kept = answer.is_done() && answer.value() == (static_cast<std::uint32_t>(value) & most);
  if (options.json) {
    Json said = value_json(answer);
    said["node"] = at.node;
    said["object"] = config::object_name(object);
    said["ok"] = kept;
    std::printf("%s\n", said.dump().c_str());
  } else {
    std::printf("%s = %s%s\n", config::object_name(object).c_str(), value_text(answer).c_str(),
                kept ? "" : ": the drive did not keep it");
  }
  return kept ? launcher::ExitCode::kExitOk : launcher::ExitCode::kExitFailure;
}

int drive_watch_command(const DriveOptions& options) {
  const config::ObjectId object = object_of(options.object);
  const double period_s = 1.0 / parse_number_in("--rate", options.rate_hz, 0.1, 20.0, "Hz");
  const double seconds = parse_number_in("--seconds", options.seconds, 0.1, 86400.0, "s");
  const std::uint8_t node = node_of(options);
  DriveSession session(options);
  const commissioning::Place at = session.place(node);
  for (double at_s = 0.0; at_s < seconds; at_s += period_s) {
    const commissioning::Answer answer = session.desk.read(at, object.index, object.sub);
    if (!answer.is_done())
      return tell_failure(session, at, "reading " + config::object_name(object), answer, options.json);
    if (options.json) {
      Json said = value_json(answer);
      said["time_s"] = at_s;
      std::printf("%s\n", said.dump().c_str());
    } else {
      std::printf("%8.2f s  %s\n", at_s, value_text(answer).c_str());
    }
    std::fflush(stdout);
    session.desk.wait(period_s);
  }
  return launcher::ExitCode::kExitOk;
}

}  // namespace liana::cli
