// The one table of packets between ground and arm: codec, XTCE, COSMOS definitions and the page of the docs follow from
// it. Arguments of functions are those of the table of requests.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/api/ground/packet.hpp"
#include "host/base/json/json_fwd.hpp"

namespace liana::ground {

// How a value is written. Not known: all bits 1 for whole numbers, flags and words; not a number for kReal; an empty
// text.
enum class ValueType : std::uint8_t {
  kWhole,  // unsigned, `bytes` octets
  kReal,   // IEEE 754, 8 octets
  kFlag,   // one octet, 0 or 1
  kWord,   // one octet: place in `words`, from 0
  kText,   // UTF-8, `bytes` octets, filled with 0
  kTime,   // CUC, 7 octets
};

// How many values of a kind there are: a number, or a figure of the robot.
enum class Count : std::uint8_t { kOne = 1, kThree = 3, kPose = 7, kAngles = 100, kCables = 101 };

using Words = std::span<const char* const>;

struct Parameter {
  const char* name = "";  // the unit is in it
  ValueType type = ValueType::kWhole;
  std::uint8_t bytes = 1;  // of one value
  const char* doc = "";
  const char* path = "";  // housekeeping: where in the state, with dots; "#" behind it: how many entries
  Count count = Count::kOne;
  Words words{};
};

// What of a robot says how long lists are.
struct Sizes {
  std::uint8_t angles = 0, cables = 0;
  std::size_t of(Count count) const;
};
// From a robot's canonical JSON. Throws JsonError when a figure is missing, or is over 64.
Sizes sizes_of(const Json& robot);

constexpr std::uint8_t kNoStructure = 0;

// One kind of telemetry packet.
struct ReportRow {
  const char* name = "";
  std::uint8_t service = 0, subtype = 0;
  std::uint8_t structure = kNoStructure;  // of housekeeping, its first octet
  const char* doc = "";
  std::span<const Parameter> parameters{};
};
std::span<const ReportRow> reports();
// Housekeeping of a structure, or nullptr.
const ReportRow* find_structure(std::uint64_t structure);
// The row that telemetry of these octets belongs to, or nullptr.
const ReportRow* find_report(const Telemetry& telemetry);

// What ends a function with success.
enum class Completes : std::uint8_t {
  kAnswer,    // lianad's answer
  kMotion,    // the arm is at rest, and not busy
  kEnabled,   // the arm is enabled and at rest
  kDisabled,  // the arm is disabled
  kCleared,   // no fault and no emergency stop is latched
  kHomed,
  kRetracted,  // the retract is done
  kStopped,    // an emergency stop is in force, and the arm no longer enabled
  kTool,       // the tool has done it
};

// One kind of telecommand; `function` counts from 1 for those of service 8.
struct CommandRow {
  const char* name = "";
  std::uint8_t service = 0, subtype = 0;
  std::uint16_t function = 0;
  const char* doc = "";
  std::span<const Parameter> parameters{};  // of services other than 8
  const char* op = "";                      // of service 8: the request of the API
  const char* command = "";                 // its field `command`, where that is fixed
  std::span<const char* const> fields{};    // of its fields, those that are arguments
  Completes completes = Completes::kAnswer;
  double limit_s = 10.0;  // by when it is completed
};
std::span<const CommandRow> commands();
const CommandRow* find_command(std::uint8_t service, std::uint8_t subtype, std::uint64_t function);
// Whether there is any telecommand of this service and subtype.
bool is_known(std::uint8_t service, std::uint8_t subtype);
// The arguments of a command, in their order on the line.
std::vector<Parameter> arguments_of(const CommandRow& row);

// Severity of an event, as the subtype of its report: 1 informative, 2 low, 3 medium, 4 high.
std::uint8_t severity_of(std::string_view kind, std::int64_t number);
// The event definition of a kind of event of lianad; 0 for an unknown kind.
std::uint16_t definition_of(std::string_view kind);
// Event definitions that the on-board end has itself.
enum class OwnEvent : std::uint16_t { kLinkLost = 101, kControllerGone = 102, kControllerThere = 103 };
struct OwnEventRow {
  OwnEvent event{};
  std::uint8_t severity = 0;  // as of severity_of()
  const char* meaning = "";
};
std::span<const OwnEventRow> own_events();
const OwnEventRow& row_of(OwnEvent event);

// What a failure code means, for people; empty for those of other pages.
std::string_view meaning_of(Failure failure);
std::span<const Failure> own_failures();

// ---- values as octets ----

// Octets that these values take.
std::size_t bytes_of(std::span<const Parameter> parameters, const Sizes& sizes);
// Appends one parameter; what `value` is not, or does not hold, is written as not known.
void append_value(std::string& out, const Parameter& parameter, const Sizes& sizes, const Json& value);
// Housekeeping of a structure, from a state of the API.
std::string record_of(const ReportRow& row, const Sizes& sizes, const Json& state);
// The values by name; unknown ones are left out (null within a list). Throws JsonError when the length is wrong, a flag
// or a word has no meaning, or a text is no UTF-8.
Json values_of(std::span<const Parameter> parameters, const Sizes& sizes, std::string_view bytes);
// The request of the API that a function of service 8 with these arguments is, without `id`. An argument that may be
// left out is left out where all its octets are 0. Throws JsonError as values_of().
Json request_of(const CommandRow& row, const Sizes& sizes, std::string_view bytes);
// What telemetry says: its header and, where the dictionary has its row, `name` and `values`.
Json report_json(const Telemetry& telemetry, const Sizes& sizes);

}  // namespace liana::ground
