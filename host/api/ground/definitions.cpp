#include "host/api/ground/definitions.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <map>

#include "host/base/event/event.hpp"
#include "host/base/svg/svg.hpp"

namespace liana::ground {
namespace {

// One value of a packet, with lists taken apart.
struct Item {
  std::string name;
  const Parameter* parameter;
};

std::string two_digits(std::size_t number) { return (number < 10 ? "0" : "") + std::to_string(number); }

// Axes of a pose, else numbers from 1.
std::string entry_name(const Parameter& parameter, std::size_t i) {
  constexpr std::array kPose{"x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"};
  if (parameter.count == Count::kOne) return parameter.name;
  const bool is_pose = parameter.count == Count::kPose;
  return std::string(parameter.name) + "_" + (is_pose ? kPose[i] : two_digits(i + 1));
}

std::vector<Item> items_of(std::span<const Parameter> parameters, const Sizes& sizes) {
  std::vector<Item> out;
  for (const Parameter& each : parameters) {
    for (std::size_t i = 0; i < sizes.of(each.count); ++i) out.push_back({entry_name(each, i), &each});
  }
  return out;
}

std::string unit_of(std::string_view name) {
  constexpr std::array kUnits{"deg_s", "js_deg", "deg", "kg", "N", "m", "s"};
  for (const std::string_view unit : kUnits) {
    if (name.ends_with("_" + std::string(unit)))
      return unit == "deg_s" ? "deg/s" : unit == "js_deg" ? "deg" : std::string(unit);
  }
  return "";
}

std::string tag(const std::string& name, const std::string& attributes) {
  return "<" + name + (attributes.empty() ? "" : " " + attributes) + "/>\n";
}
std::string tag(const std::string& name, const std::string& attributes, const std::string& inside) {
  return "<" + name + (attributes.empty() ? "" : " " + attributes) + ">\n" + inside + "</" + name + ">\n";
}
std::string leaf(const std::string& name, const std::string& text) {
  return "<" + name + ">" + text + "</" + name + ">\n";
}
std::string attribute(const std::string& name, std::string_view value) {
  return name + "=\"" + svg::escaped(value) + "\"";
}
std::string bits(std::size_t octets) { return attribute("sizeInBits", std::to_string(8 * octets)); }

std::string enumeration(const Parameter& parameter) {
  std::vector<std::string> words(parameter.words.begin(), parameter.words.end());
  if (parameter.type == ValueType::kFlag) words = {"false", "true"};
  std::string list;
  for (std::size_t i = 0; i < words.size(); ++i)
    list += tag("Enumeration", attribute("value", std::to_string(i)) + " " + attribute("label", words[i]));
  return tag("EnumerationList", "", list + tag("Enumeration", R"(value="255" label="not_known")"));
}

std::string text_encoding(std::size_t octets) {
  const std::string fixed = tag("Fixed", "", leaf("FixedValue", std::to_string(8 * octets)));
  return tag("StringDataEncoding", R"(encoding="UTF-8")", tag("SizeInBits", "", fixed + leaf("TerminationChar", "00")));
}

// Types of parameters or of arguments (`kind`), each once: XTCE has them apart from what has them.
class Types {
 public:
  explicit Types(std::string kind) : kind_(std::move(kind)) {}

  // The name of the type of an item.
  std::string of(const Item& item) {
    const Parameter& p = *item.parameter;
    const std::string unit = unit_of(p.name);
    const std::string units = unit.empty() ? tag("UnitSet", "") : tag("UnitSet", "", leaf("Unit", unit));
    switch (p.type) {
      case ValueType::kWhole:
        return unsigned_of(8u * p.bytes);
      case ValueType::kReal: {
        std::string name = "real" + (unit.empty() ? "" : "_" + unit);
        std::replace(name.begin(), name.end(), '/', '_');
        return add(name, "Float", R"(sizeInBits="64")", units + tag("FloatDataEncoding", R"(sizeInBits="64")"));
      }
      case ValueType::kFlag:
        return add("flag", "Enumerated", "", octet() + enumeration(p));
      case ValueType::kWord:
        return add(std::string(p.name) + "_word", "Enumerated", "", octet() + enumeration(p));
      case ValueType::kText:
        return add("text_" + std::to_string(p.bytes), "String", "", tag("UnitSet", "") + text_encoding(p.bytes));
      case ValueType::kTime:
        return kind_ == "Parameter" ? time() : unsigned_of(8 * kTimeBytes);
    }
    return "";
  }
  std::string unsigned_of(unsigned size) {
    const std::string width = attribute("sizeInBits", std::to_string(size));
    return add("unsigned_" + std::to_string(size), "Integer", R"(signed="false" )" + width,
               tag("UnitSet", "") + tag("IntegerDataEncoding", width + R"( encoding="unsigned")"));
  }
  std::string time() {
    const std::string encoding = tag("IntegerDataEncoding", bits(kTimeBytes) + R"( encoding="unsigned")");
    return add("cuc_time", "AbsoluteTime", "",
               tag("Encoding", R"(units="seconds" scale="5.9604644775390625E-8")", encoding) +
                   tag("ReferenceTime", "", leaf("Epoch", "UNIX")));
  }
  std::string text() const { return text_; }

 private:
  static std::string octet() {
    return tag("UnitSet", "") + tag("IntegerDataEncoding", R"(sizeInBits="8" encoding="unsigned")");
  }
  std::string add(const std::string& name, const std::string& what, const std::string& attributes,
                  const std::string& inside) {
    if (known_.emplace(name, inside).second)
      text_ +=
          tag(what + kind_ + "Type", attribute("name", name) + (attributes.empty() ? "" : " " + attributes), inside);
    return name;
  }
  std::string kind_, text_;
  std::map<std::string, std::string> known_;
};

struct Bits {
  const char* name;
  unsigned size;
};
constexpr std::array kPrimaryBits{Bits{"version", 3}, Bits{"type", 1},           Bits{"secondary_header", 1},
                                  Bits{"apid", 11},   Bits{"sequence_flags", 2}, Bits{"sequence_count", 14},
                                  Bits{"length", 16}};
constexpr std::array kSecondaryBits{Bits{"pus_version", 4}, Bits{"time_reference", 4}, Bits{"service", 8},
                                    Bits{"subtype", 8},     Bits{"message_count", 16}, Bits{"destination", 16}};

class Xtce {
 public:
  explicit Xtce(const Sizes& sizes) : sizes_(sizes) {}

  std::string text() {
    const std::string telemetry = telemetry_containers();
    const std::string telecommands = meta_commands();
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" +
           tag("SpaceSystem", R"(xmlns="http://www.omg.org/spec/XTCE/20180204" name="Liana")",
               tag("TelemetryMetaData", "",
                   tag("ParameterTypeSet", "", types_.text()) + tag("ParameterSet", "", parameters_) +
                       tag("ContainerSet", "", telemetry)) +
                   tag("CommandMetaData", "",
                       tag("ArgumentTypeSet", "", argument_types_.text()) + tag("MetaCommandSet", "", telecommands)));
  }

 private:
  std::string entry(const std::string& name, const std::string& type, std::string_view doc = "") {
    std::string attributes = attribute("name", name) + " " + attribute("parameterTypeRef", type);
    if (!doc.empty()) attributes += " " + attribute("shortDescription", doc);
    parameters_ += tag("Parameter", attributes);
    return tag("ParameterRefEntry", attribute("parameterRef", name));
  }
  std::string entries(std::span<const Bits> list) {
    std::string out;
    for (const Bits& each : list) out += entry(each.name, types_.unsigned_of(each.size));
    return out;
  }
  static std::string base(const std::string& container, const std::vector<std::pair<std::string, unsigned>>& where) {
    std::string list;
    for (const auto& [name, value] : where)
      list += tag("Comparison", attribute("parameterRef", name) + " " + attribute("value", std::to_string(value)));
    return tag("BaseContainer", attribute("containerRef", container),
               tag("RestrictionCriteria", "", tag("ComparisonList", "", list)));
  }
  static std::string container(const std::string& name, std::string_view doc, bool is_abstract,
                               const std::string& entries, const std::string& base) {
    return tag(
        "SequenceContainer",
        attribute("name", name) + " " + attribute("shortDescription", doc) + (is_abstract ? R"( abstract="true")" : ""),
        tag("EntryList", "", entries) + base);
  }

  std::string telemetry_containers() {
    std::string out = container("SpacePacket", "CCSDS 133.0-B-2", true, entries(kPrimaryBits), "");
    out += container("PusTelemetry", "ECSS-E-ST-70-41C", true, entries(kSecondaryBits) + entry("time", types_.time()),
                     base("SpacePacket", {{"type", 0}, {"secondary_header", 1}, {"apid", kArmApid}}));
    parameters_ += tag("Parameter", R"(name="structure" parameterTypeRef=")" + types_.unsigned_of(8) + "\"") +
                   tag("Parameter", R"(name="checksum" parameterTypeRef=")" + types_.unsigned_of(16) + "\"");
    out += container("Housekeeping", "TM[3,25]", true, tag("ParameterRefEntry", R"(parameterRef="structure")"),
                     base("PusTelemetry", {{"service", 3}, {"subtype", 25}}));
    for (const ReportRow& row : reports()) out += report(row);
    return out;
  }
  std::string report(const ReportRow& row) {
    std::string list;
    for (const Item& item : items_of(row.parameters, sizes_))
      list += entry(std::string(row.name) + "_" + item.name, types_.of(item), item.parameter->doc);
    list += tag("ParameterRefEntry", R"(parameterRef="checksum")");
    std::string where = base("PusTelemetry", {{"service", row.service}, {"subtype", row.subtype}});
    if (row.structure != kNoStructure) where = base("Housekeeping", {{"structure", row.structure}});
    if (row.service == 9) where = base("SpacePacket", {{"type", 0}, {"secondary_header", 0}, {"apid", kTimeApid}});
    return container(row.name, row.doc, false, list, where);
  }

  static std::string fixed(std::uint64_t value, std::size_t octets) {
    std::string digits;
    for (std::size_t i = 2 * octets; i-- > 0;) digits += "0123456789ABCDEF"[value >> 4u * i & 15u];
    return tag("FixedValueEntry", attribute("binaryValue", digits) + " " + bits(octets));
  }
  std::string meta_commands() {
    std::string header = fixed(0x1800u | kArmApid, 2) + fixed(0xc000u, 2) + fixed(0, 2) + fixed(0x2f, 1);
    std::string out = tag("MetaCommand", R"(name="Telecommand" abstract="true")",
                          tag("CommandContainer", R"(name="Telecommand")", tag("EntryList", "", header)));
    for (const CommandRow& row : commands()) out += meta_command(row);
    return out;
  }
  std::string meta_command(const CommandRow& row) {
    std::string list = fixed(row.service, 1) + fixed(row.subtype, 1) + fixed(0, 2);
    if (row.function != 0) list += fixed(row.function, 2);
    std::string arguments;
    const std::vector<Parameter> parameters = arguments_of(row);
    for (const Item& item : items_of(parameters, sizes_)) {
      arguments +=
          tag("Argument", attribute("name", item.name) + " " + attribute("argumentTypeRef", argument_types_.of(item)) +
                              " " + attribute("shortDescription", item.parameter->doc));
      list += tag("ArgumentRefEntry", attribute("argumentRef", item.name));
    }
    const std::string container =
        tag("CommandContainer", attribute("name", row.name),
            tag("EntryList", "", list) + tag("BaseContainer", R"(containerRef="Telecommand")"));
    return tag("MetaCommand", attribute("name", row.name) + " " + attribute("shortDescription", row.doc),
               tag("BaseMetaCommand", R"(metaCommandRef="Telecommand")") +
                   (arguments.empty() ? "" : tag("ArgumentList", "", arguments)) + container);
  }

  Sizes sizes_;
  Types types_{"Parameter"}, argument_types_{"Argument"};
  std::string parameters_;
};

// ---- COSMOS ----

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

std::string quoted(std::string text) {
  std::replace(text.begin(), text.end(), '"', '\'');
  return "\"" + text + "\"";
}

struct CosmosType {
  const char* name;
  const char* bounds;  // of a telecommand: min, max, default
};

CosmosType cosmos_type(const Parameter& parameter) {
  if (parameter.type == ValueType::kReal) return {"FLOAT", "MIN MAX 0.0"};
  if (parameter.type == ValueType::kText) return {"STRING", "\"\""};
  return {"UINT", "MIN MAX 0"};
}

std::string states(const Parameter& parameter) {
  std::string out;
  if (parameter.type == ValueType::kFlag) out = "    STATE FALSE 0\n    STATE TRUE 1\n    STATE NOT_KNOWN 255\n";
  if (parameter.type != ValueType::kWord) return out;
  for (std::size_t i = 0; i < parameter.words.size(); ++i)
    out += "    STATE " + upper(parameter.words[i]) + " " + std::to_string(i) + "\n";
  return out + "    STATE NOT_KNOWN 255\n";
}

// A number of a header; `id`: what the packet is known by.
std::string cosmos_item(bool is_command, const std::string& name, std::size_t size, std::uint64_t value, bool id) {
  const std::string number = std::to_string(value);
  const std::string what = is_command ? "PARAMETER " : "ITEM ";
  std::string out = std::string("  APPEND_") + (id ? "ID_" : "") + what + upper(name) + " " + std::to_string(size);
  out += " UINT";
  if (is_command) out += " " + number + " " + number + " " + number;
  if (!is_command && id) out += " " + number;
  return out + "\n";
}

std::string cosmos_values(bool is_command, std::span<const Parameter> parameters, const Sizes& sizes) {
  std::string out;
  for (const Item& item : items_of(parameters, sizes)) {
    const CosmosType type = cosmos_type(*item.parameter);
    out += std::string("  APPEND_") + (is_command ? "PARAMETER " : "ITEM ") + upper(item.name) + " " +
           std::to_string(8u * item.parameter->bytes) + " " + type.name +
           (is_command ? std::string(" ") + type.bounds : "") + " " + quoted(item.parameter->doc) + "\n" +
           states(*item.parameter);
    if (const std::string unit = unit_of(item.parameter->name); !unit.empty())
      out += "    UNITS " + unit + " " + unit + "\n";
  }
  return out;
}

// What a row fixes of the header: places of kPrimaryBits and kSecondaryBits with their values.
using Fixed = std::map<std::string, std::uint64_t>;

std::string cosmos_header(std::span<const Bits> list, const Fixed& fixed) {
  std::string out;
  for (const Bits& each : list) {
    const auto found = fixed.find(each.name);
    out += cosmos_item(false, "ccsds_" + std::string(each.name), each.size, found == fixed.end() ? 0 : found->second,
                       found != fixed.end());
  }
  return out;
}

std::string cosmos_report(const ReportRow& row, const Sizes& sizes) {
  std::string out = "TELEMETRY LIANA " + upper(row.name) + " BIG_ENDIAN " + quoted(row.doc) + "\n";
  if (row.service == 9) {
    out += cosmos_header(kPrimaryBits, {{"apid", kTimeApid}});
  } else {
    out += cosmos_header(kPrimaryBits, {{"apid", kArmApid}});
    out += cosmos_header(kSecondaryBits, {{"service", row.service}, {"subtype", row.subtype}});
    out += cosmos_item(false, "cuc_seconds", 32, 0, false) + cosmos_item(false, "cuc_fraction", 24, 0, false);
  }
  if (row.structure != kNoStructure) out += cosmos_item(false, "structure", 8, row.structure, true);
  return out + cosmos_values(false, row.parameters, sizes) + cosmos_item(false, "checksum", 16, 0, false) + "\n";
}

std::string cosmos_command(const CommandRow& row, const Sizes& sizes) {
  std::string out = "COMMAND LIANA " + upper(row.name) + " BIG_ENDIAN " + quoted(row.doc) + "\n";
  out += cosmos_item(true, "ccsds_packet_id", 16, 0x1800u | kArmApid, true);
  out += "  APPEND_PARAMETER CCSDS_SEQUENCE_CONTROL 16 UINT 49152 65535 49152\n";
  out += "  APPEND_PARAMETER CCSDS_LENGTH 16 UINT MIN MAX 0\n";
  out += cosmos_item(true, "pus_version", 4, 2, false);
  out += "  APPEND_PARAMETER ACKNOWLEDGE 4 UINT 0 15 15\n";
  out += cosmos_item(true, "service", 8, row.service, true) + cosmos_item(true, "subtype", 8, row.subtype, true);
  out += "  APPEND_PARAMETER SOURCE 16 UINT MIN MAX 0\n";
  if (row.function != 0) out += cosmos_item(true, "function", 16, row.function, true);
  return out + cosmos_values(true, arguments_of(row), sizes) + "  APPEND_PARAMETER CHECKSUM 16 UINT MIN MAX 0\n\n";
}

// ---- the page ----

std::string octets(const Parameter& parameter, const Sizes& sizes) {
  const std::string one = std::to_string(parameter.bytes);
  if (parameter.count == Count::kOne) return one;
  const std::string times = parameter.count == Count::kAngles   ? "angles"
                            : parameter.count == Count::kCables ? "cables"
                                                                : std::to_string(sizes.of(parameter.count));
  return times + " x " + one;
}

std::string kind_of(const Parameter& parameter) {
  if (parameter.type == ValueType::kWord) {
    std::string out;
    for (std::size_t i = 0; i < parameter.words.size(); ++i)
      out += (i == 0 ? "" : ", ") + std::to_string(i) + " " + parameter.words[i];
    return out;
  }
  constexpr std::array kNames{"whole", "real", "flag", "", "text", "time"};
  return kNames[static_cast<std::size_t>(parameter.type)];
}

std::string parameter_table(std::span<const Parameter> parameters, const Sizes& sizes) {
  std::string out = "| name | octets | kind | meaning |\n|---|---|---|---|\n";
  for (const Parameter& each : parameters)
    out += "| `" + std::string(each.name) + "` | " + octets(each, sizes) + " | " + kind_of(each) + " | " + each.doc +
           " |\n";
  return out;
}

std::string bracket(unsigned service, unsigned subtype) {
  return "[" + std::to_string(service) + "," + std::to_string(subtype) + "]";
}

std::string report_section(const Sizes& sizes) {
  std::string out = "| report | name | when |\n|---|---|---|\n", details;
  std::string last;
  for (const ReportRow& row : reports()) {
    const std::string title = "TM" + bracket(row.service, row.subtype) +
                              (row.structure == kNoStructure ? "" : " structure " + std::to_string(row.structure));
    out += "| " + title + " | `" + row.name + "` | " + row.doc + " |\n";
    const std::string table = parameter_table(row.parameters, sizes);
    if (row.parameters.empty() || table == last) continue;
    details += "\n### Values of `" + std::string(row.name) + "`\n" + table;
    last = table;
  }
  return out +
         "\nReports of service 1 have the values of `acceptance`; failures have those of `acceptance_failure`.\n"
         "All events have the values of `event_informative`.\n" +
         details;
}

std::string command_section(const Sizes& sizes) {
  std::string out = "| telecommand | function | name | what it does |\n|---|---|---|---|\n", details;
  for (const CommandRow& row : commands()) {
    out += "| TC" + bracket(row.service, row.subtype) + " | " +
           (row.function == 0 ? "" : std::to_string(row.function)) + " | `" + row.name + "` | " + row.doc + " |\n";
    const std::vector<Parameter> arguments = arguments_of(row);
    if (!arguments.empty())
      details += "\n### Arguments of `" + std::string(row.name) + "`\n" + parameter_table(arguments, sizes);
  }
  return out + details;
}

std::string code_section() {
  std::string out = "| code | meaning |\n|---|---|\n";
  for (const Failure each : own_failures())
    out += "| " + std::to_string(static_cast<unsigned>(each)) + " | " + std::string(meaning_of(each)) + " |\n";
  return out;
}

std::string event_section() {
  std::string out = "| definition | event | severity |\n|---|---|---|\n";
  for (std::size_t i = 0; i < event::kEventKinds; ++i) {
    const char* name = event::event_kind_name(static_cast<event::EventKind>(i));
    const unsigned zero = severity_of(name, 0), one = severity_of(name, 1);
    out += "| " + std::to_string(definition_of(name)) + " | `" + name + "` | " +
           (zero == one ? std::to_string(one) : std::to_string(zero) + " for number 0, else " + std::to_string(one)) +
           " |\n";
  }
  for (const OwnEventRow& row : own_events())
    out += "| " + std::to_string(static_cast<unsigned>(row.event)) + " | " + row.meaning + " | " +
           std::to_string(row.severity) + " |\n";
  return out;
}

constexpr const char* kPageBegin = R"(# Ground packets

<!-- made by ./dev docs from host/api/ground/dictionary.cpp -->

For people who connect a ground station: every packet between `liana ground` and the ground.
[fly-it-from-a-ground-station.md](../how-to/fly-it-from-a-ground-station.md) says how to begin.
`liana ground --xtce` and `--cosmos` write the same dictionary for other programs.

## Packets
- Each packet is a Space Packet (CCSDS 133.0-B-2) of at most 4096 octets, never segmented.
- The APID of the arm is 100, both ways. The highest octet comes first.
- Telecommands and telemetry have the secondary headers of PUS-C (ECSS-E-ST-70-41C, clause 7.4), version 2.
- Telecommands have a source of 2 octets and no spare octets.
- In the acknowledgement flags, bit 0 (the lowest) asks for acceptance, 1 for start, 2 for progress and 3 for
  completion.
  Failures are always reported, progress never is.
- Telemetry has a message count for each service and subtype, a destination, and the time.
- Time is CUC (CCSDS 301.0-B-4) without a preamble: 4 octets of seconds since 1970-01-01, and 3 octets of
  their fraction.
  It is the clock of the computer of `liana ground`; leap seconds are not counted.
- The last two octets are the packet error control: CRC-16-CCITT, which begins with FFFFh.
- TCP carries packets one after another without anything between. A UDP datagram is one packet.
- Sequence counts of telecommands are counted in `count_jumps`. No telecommand is refused because of its count.

## How values are written
- A *real* is an IEEE 754 number of 8 octets; *not a number* stands for a value that is not known.
- A *whole* number has no sign; all bits 1 stand for not known. So do they for a flag or a word.
- A *text* is UTF-8, filled with 0; empty stands for not known.
- `angles` and `cables` are the numbers of the robot: 10 and 15 for `zhu2022`. A serial arm has no cables.
- An argument that may be left out is left out where all its octets are 0.

)";

constexpr const char* kPageFunctions = R"(
## Telecommands
After the secondary header, service 8 has the function in 2 octets, then its arguments.
lianad takes a function as a request of the API ([api.md](api.md)) from a client with the name `ground`.
So ownership of motion, ranges and verification are those of every other client.

)";

constexpr const char* kPageCodes = R"(
## Failure codes
| code | meaning |
|---|---|
| 1 to 8 | error code of [api.md](api.md), in its order: 1 is `bad_request`, 8 `no_device` |
| 101 to 299 | refusal code of verification ([refusals.md](refusals.md)) |
| 1000 and more | fault that ended it ([faults.md](faults.md)) |

The on-board end itself has these:

)";

constexpr const char* kPageServices = R"(
## Services
- Service 1: acceptance says that the packet can be read, start that lianad has taken the request.
  Completion says that the arm has done it. A motion that verification refuses fails with the refusal code.
- Service 3: structures 1 and 2 are sent every second, 5 every ten seconds, the others when enabled.
  Each telecommand names one structure.
- Service 5: reports cannot be switched off.
- Service 9: the time packet comes every 8 s at first.
- Service 15 is reduced to subtype 9: there is one packet store, number 1, and it is always on.
  It holds the newest 64 MB of telemetry, unless `--store-mb` says otherwise.
  Resent packets are the same octets again, on the same connections. A span of time counts by the time in the packets.
- Service 17: only subtype 1.
- An unknown APID has a routing failure TM[1,10]. What has no readable header is counted only.
- Missions are started on the computer of the arm; telecommand `mission` controls the one that runs.

## Loss of the link
The link is lost when no telecommand comes for 10 s (`--silence-s`), or when the last TCP connection for
telecommands ends.
Service 15 does not count: a store that fills its gaps does not fly the arm.
If `ground` owns motion then, the on-board end leaves lianad. Its owner is gone for lianad: the arm holds.
All telecommands that are not completed fail with code 34, and an event 101 follows.
Send TC[17,1] every few seconds to keep the link.
)";

}  // namespace

std::string xtce(const Sizes& sizes) { return Xtce(sizes).text(); }

std::string cosmos(const Sizes& sizes) {
  std::string out =
      "# Telecommands and telemetry of Liana, made by liana ground --cosmos.\n"
      "# The interface fills CCSDS_LENGTH and CHECKSUM: CRC-16-CCITT, which begins with 0xFFFF.\n\n";
  for (const CommandRow& row : commands()) out += cosmos_command(row, sizes);
  for (const ReportRow& row : reports()) out += cosmos_report(row, sizes);
  return out;
}

std::string ground_page(const Sizes& sizes) {
  return std::string(kPageBegin) + "## Telemetry\n" + report_section(sizes) + kPageFunctions + command_section(sizes) +
         kPageCodes + code_section() + kPageServices +
         "\n## Events\nSeverity 1 is informative, 2 low, 3 medium, 4 high.\n\n" + event_section();
}

}  // namespace liana::ground
