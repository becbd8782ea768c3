#include "host/api/ground/dictionary.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "firmware_like/safety/supervisor.hpp"
#include "host/api/server/request_bounds.hpp"
#include "host/api/server/request_table.hpp"
#include "host/base/event/event.hpp"
#include "host/base/json/json.hpp"
#include "host/base/text/printable.hpp"

namespace liana::ground {
namespace {

// The name of a value, what of a state it is (`path`), and what it means.
constexpr Parameter whole(const char* name, std::uint8_t bytes, const char* path, const char* doc) {
  return {name, ValueType::kWhole, bytes, doc, path};
}
constexpr Parameter real(const char* name, const char* path, const char* doc, Count count = Count::kOne) {
  return {name, ValueType::kReal, 8, doc, path, count};
}
constexpr Parameter flag(const char* name, const char* path, const char* doc) {
  return {name, ValueType::kFlag, 1, doc, path};
}
constexpr Parameter word(const char* name, Words words, const char* path, const char* doc) {
  return {name, ValueType::kWord, 1, doc, path, Count::kOne, words};
}
constexpr Parameter text(const char* name, std::uint8_t bytes, const char* path, const char* doc) {
  return {name, ValueType::kText, bytes, doc, path};
}
constexpr Parameter time(const char* name, const char* doc) {
  return {name, ValueType::kTime, static_cast<std::uint8_t>(kTimeBytes), doc};
}

// BOOTING is lianad's alone: the controller does not run yet.
constexpr auto kStates = [] {
  std::array<const char*, 1 + kOperatingStateNames.size()> out{"BOOTING"};
  std::copy(kOperatingStateNames.begin(), kOperatingStateNames.end(), out.begin() + 1);
  return out;
}();
constexpr std::array kStops{"none", "hold", "stop", "off"};
constexpr std::array kRetractPhases{"none", "stopping", "joining", "back", "done", "ended"};
constexpr std::array kServoPhases{"standby", "approaching", "dwelling", "done", "lost", "timed_out"};
constexpr std::array kToolPhases{"none", "asked", "acting", "done", "failed"};
constexpr std::array kLevels{"free", "slow", "refuse"};

constexpr Parameter kTick = whole("tick", 8, "tick", "number of the control tick");
constexpr Parameter kArmTime = real("time_s", "time_s", "arm time");

constexpr std::array kArm{
    kTick,
    kArmTime,
    word("state", kStates, "state", "operating state"),
    word("stop_category", kStops, "stop_category", "stop category in force"),
    flag("is_homed", "is_homed", "the joint angles are known"),
    flag("is_busy", "is_busy", "a motion is under way"),
    flag("at_rest", "at_rest", "the arm is at rest"),
    flag("emergency_stop", "stop?", "an emergency stop is in force"),
    whole("faults", 1, "faults#", "number of latched faults"),
    whole("first_fault", 2, "faults.0.number", "number of the first latched fault"),
    whole("overruns", 4, "overruns", "missed deadlines"),
    whole("refusals", 4, "refusals", "refused commands"),
    whole("refused_motions", 4, "refused_motions", "refusals that ended a motion"),
    whole("verdict_sequence", 8, "verdict.sequence", "number of the last command that was verified"),
    whole("verdict_code", 2, "verdict.code", "its refusal code; 0: issued"),
    real("verdict_share", "verdict.share", "share of the limit that the motion comes nearest to"),
    text("owner", 32, "owner", "client that owns motion"),
};
constexpr std::array kJoints{
    kTick,
    real("setpoint_js_deg", "setpoint_js_deg", "commanded joint angles", Count::kAngles),
    real("measured_js_deg", "measured_js_deg", "measured joint angles", Count::kAngles),
    real("setpoint_cp", "setpoint_cp", "commanded pose of the tip: x, y, z [m], quaternion w, x, y, z", Count::kPose),
    real("measured_cp", "measured_cp", "measured pose of the tip, in the same form", Count::kPose),
};
constexpr std::array kForces{
    kTick,
    real("tension_N", "tension_N", "measured cable tensions; cable arms", Count::kCables),
    real("clearance_m", "clearance.distance_m", "distance between arm and scene"),
    real("clearance_bound_m", "clearance.bound_m", "its guaranteed lower bound"),
    word("clearance_level", kLevels, "clearance.level", "what the clearance allows"),
    real("contact_force_N", "contact.force_N", "force on the tip along the axes of the base frame", Count::kThree),
    real("friction_mu", "friction.mu", "estimated friction coefficient"),
};
constexpr std::array kWork{
    kTick,
    whole("step", 2, "step.index", "index of the mission's step"),
    text("step_name", 48, "step.name", "name of the step"),
    word("retract_phase", kRetractPhases, "retract.phase", "phase of the retract"),
    whole("retract_points", 4, "retract.points_left", "points left of the retract path"),
    word("servo_phase", kServoPhases, "servo.phase", "phase of the visual servo"),
    word("tool_phase", kToolPhases, "tool.phase", "phase of the tool's last command"),
    text("device", 16, "device", "input device in use"),
    flag("device_engaged", "device_engaged", "its deadman is held"),
};
constexpr std::array kGround{
    whole("received", 4, "received", "telecommands received"),
    whole("rejected", 4, "rejected", "telecommands that failed acceptance or routing"),
    whole("unreadable", 4, "unreadable", "datagrams or streams without a packet header"),
    whole("count_jumps", 4, "count_jumps", "telecommands out of sequence"),
    whole("open", 2, "open", "telecommands that are not completed yet"),
    whole("sent", 8, "sent", "telemetry packets sent, resent ones not counted"),
    whole("stored", 4, "stored", "telemetry packets in the packet store"),
    whole("dropped", 8, "dropped", "telemetry packets that left the store for newer ones"),
    whole("links_lost", 4, "links_lost", "times that the link was lost while the ground owned motion"),
};

constexpr std::array kRequest{
    whole("packet_id", 2, "", "first two octets of the telecommand"),
    whole("sequence_control", 2, "", "its third and fourth octet"),
};
constexpr std::array kRequestFailure{
    kRequest[0],
    kRequest[1],
    whole("code", 2, "", "failure code"),
    whole("detail", 4, "", "a number of it: length in octets, place of the argument, tick"),
    text("text", 96, "", "what happened, for people"),
};
constexpr std::array kEvent{
    whole("definition", 2, "", "event definition"), whole("sequence", 8, "", "number of the event in lianad's log"),
    whole("tick", 8, "", "tick of the event"),      whole("number", 4, "", "depends on the kind of event"),
    text("subject", 48, "", "what it is about"),    text("text", 160, "", "a sentence"),
};
constexpr std::array kTimeReport{
    whole("exponent", 1, "", "a time packet comes every 2^exponent s"),
    time("time", "on-board time when it was made"),
    whole("status", 1, "", "0: not known to be synchronized"),
};

constexpr std::array kReports{
    ReportRow{"acceptance", 1, 1, 0, "A telecommand is accepted.", kRequest},
    ReportRow{"acceptance_failure", 1, 2, 0, "A telecommand is not accepted.", kRequestFailure},
    ReportRow{"start", 1, 3, 0, "Execution has begun: lianad took the request.", kRequest},
    ReportRow{"start_failure", 1, 4, 0, "lianad refused the request.", kRequestFailure},
    ReportRow{"completion", 1, 7, 0, "Execution is completed.", kRequest},
    ReportRow{"completion_failure", 1, 8, 0, "Execution has ended without success.", kRequestFailure},
    ReportRow{"routing_failure", 1, 10, 0, "No application process has this APID.", kRequestFailure},
    ReportRow{"arm", 3, 25, 1, "State of the arm and its verification.", kArm},
    ReportRow{"joints", 3, 25, 2, "Joint angles and pose of the tip.", kJoints},
    ReportRow{"forces", 3, 25, 3, "Tensions, clearance and contact.", kForces},
    ReportRow{"work", 3, 25, 4, "Mission, retract, servo, tool and device.", kWork},
    ReportRow{"ground", 3, 25, 5, "Counters of the on-board end.", kGround},
    ReportRow{"event_informative", 5, 1, 0, "An event of normal operation.", kEvent},
    ReportRow{"event_low", 5, 2, 0, "An anomaly of low severity.", kEvent},
    ReportRow{"event_medium", 5, 3, 0, "An anomaly of medium severity.", kEvent},
    ReportRow{"event_high", 5, 4, 0, "An anomaly of high severity.", kEvent},
    ReportRow{"time", 9, 2, 0, "On-board time, under APID 0 and without a secondary header.", kTimeReport},
    ReportRow{"alive", 17, 2, 0, "The answer to the connection test.", {}},
};

constexpr Parameter kOneOf = whole("entries", 1, "", "number of entries that follow: 1");
constexpr Parameter kStructure = whole("structure", 1, "", "structure of housekeeping, 1 to 5");
constexpr std::array kStructureOnly{kOneOf, kStructure};
constexpr std::array kInterval{kOneOf, kStructure,
                               whole("interval", 4, "", "command intervals from report to report, 1 to 1000000")};
constexpr std::array kExponent{whole("exponent", 1, "", "a time packet comes every 2^exponent s; 0 to 8")};
constexpr std::array kRange{kOneOf, whole("store", 1, "", "packet store: 1"), time("from", "first time to resend"),
                            time("to", "last time to resend")};

constexpr double kLong_s = 3600.0;  // the slowest motions take minutes
constexpr std::array kFrom{"from"};
constexpr std::array kGoalAngles{"goal_deg", "rate_deg_s"};
constexpr std::array kGoal{"goal"};
constexpr std::array kUntil{"until_tick"};
constexpr std::array kReason{"reason"};
constexpr std::array kCommandOnly{"command"};
constexpr std::array kMass{"mass_kg", "center_m"};

constexpr CommandRow function(std::uint16_t id, const char* name, const char* op, const char* command, Words fields,
                              Completes completes, double limit_s, const char* doc) {
  return {name, 8, 1, id, doc, {}, op, command, fields, completes, limit_s};
}

constexpr std::array kCommandRows{
    CommandRow{"hk_enable", 3, 5, 0, "Send a structure of housekeeping periodically.", kStructureOnly},
    CommandRow{"hk_disable", 3, 6, 0, "Send it no longer.", kStructureOnly},
    CommandRow{"hk_once", 3, 27, 0, "Send it once, now; structure 5 also without lianad.", kStructureOnly},
    CommandRow{"hk_interval", 3, 31, 0, "How often it is sent.", kInterval},
    function(1, "acquire", "acquire", "", kFrom, Completes::kAnswer, 10, "Own motion."),
    function(2, "release", "release", "", {}, Completes::kAnswer, 10, "Give motion back; the arm holds."),
    function(3, "enable", "state_command", "enable", {}, Completes::kEnabled, 60, "Enable the arm."),
    function(4, "disable", "state_command", "disable", {}, Completes::kDisabled, 60, "Disable the arm."),
    function(5, "clear", "state_command", "clear", {}, Completes::kCleared, 10, "Clear faults and emergency stop."),
    function(6, "home", "state_command", "home", {}, Completes::kHomed, 60, "Take the joint angles from the drives."),
    function(7, "move_jp", "move_jp", "", kGoalAngles, Completes::kMotion, kLong_s, "Move to joint angles."),
    function(8, "move_cp", "move_cp", "", kGoal, Completes::kMotion, kLong_s, "Move the tip along a line to a pose."),
    function(9, "hold", "hold", "", {}, Completes::kMotion, 60, "Stop along the path and stay enabled."),
    function(10, "retract", "retract", "", kUntil, Completes::kRetracted, kLong_s, "Go back along the verified path."),
    function(11, "estop", "stop", "", kReason, Completes::kStopped, 10, "Emergency stop; never refused."),
    function(12, "mission", "mission_control", "", kCommandOnly, Completes::kAnswer, 10,
             "Pause, resume, step, confirm or abort the mission that runs."),
    function(13, "tool", "tool", "", kCommandOnly, Completes::kTool, 300, "A command to the tool at the tip."),
    function(14, "payload", "payload", "", kMass, Completes::kAnswer, 10, "What the arm carries from now on."),
    CommandRow{"time_rate", 9, 1, 0, "How often the time is sent.", kExponent},
    CommandRow{"resend",
               15,
               9,
               0,
               "Resend the stored packets of a span of time.",
               kRange,
               "",
               "",
               {},
               Completes::kAnswer,
               600},
    CommandRow{"ping", 17, 1, 0, "Are you alive?"},
};

constexpr std::array kOwnEvents{
    OwnEventRow{OwnEvent::kLinkLost, 3, "the link is lost"},
    OwnEventRow{OwnEvent::kControllerGone, 3, "lianad is gone"},
    OwnEventRow{OwnEvent::kControllerThere, 1, "lianad is there"},
};

constexpr std::array kOwnFailures{Failure::kLength,   Failure::kChecksum,       Failure::kHeader,     Failure::kApid,
                                  Failure::kService,  Failure::kFunction,       Failure::kArgument,   Failure::kTooMany,
                                  Failure::kAway,     Failure::kNoConfirmation, Failure::kNotReached, Failure::kStopped,
                                  Failure::kNotOwner, Failure::kLinkLost};

constexpr std::size_t kMaxList = 64;

std::size_t field_bytes(double high) { return high > 4294967294.0 ? 8 : 4; }

// An argument as the request's field has it.
Parameter argument_of(const api::RequestField& field) {
  using api::FieldType;
  switch (field.type) {
    case FieldType::kInteger:
      return whole(field.name, static_cast<std::uint8_t>(field_bytes(field.high.factor)), "", field.doc);
    case FieldType::kFlag:
      return flag(field.name, "", field.doc);
    case FieldType::kText:
      return text(field.name, static_cast<std::uint8_t>(field.high.factor), "", field.doc);
    case FieldType::kWord:
      return word(field.name, field.words, "", field.doc);
    case FieldType::kAngles:
      return real(field.name, "", field.doc, Count::kAngles);
    case FieldType::kPoint:
      return real(field.name, "", field.doc, Count::kThree);
    case FieldType::kPose:
      return real(field.name, "", field.doc, Count::kPose);
    default:
      return real(field.name, "", field.doc);
  }
}

const api::RequestField& field_of(const CommandRow& row, std::string_view name) {
  const auto fields = api::find_request(row.op)->fields;
  return *std::find_if(fields.begin(), fields.end(), [name](const auto& each) { return each.name == name; });
}

const Json& entry_or_null(const Json& list, std::size_t i) {
  static const Json kNull;
  return list.is_array() && i < list.size() ? list[i] : kNull;
}

// The value at a path of a state, or null.
Json at_path(const Json& state, std::string_view path) {
  const char last = path.empty() ? '\0' : path.back();
  if (last == '#' || last == '?') path.remove_suffix(1);
  const Json* value = &state;
  while (!path.empty()) {
    const std::string_view key = path.substr(0, path.find('.'));
    path.remove_prefix(std::min(path.size(), key.size() + 1));
    value = key == "0" ? &entry_or_null(*value, 0) : &value->member_or_null(key);
  }
  if (last == '#') return value->is_array() ? Json(static_cast<std::uint64_t>(value->size())) : Json();
  if (last == '?') return !value->is_null();
  return *value;
}

constexpr std::uint64_t none_of(std::size_t bytes) { return bytes >= 8 ? ~std::uint64_t{0} : (1ull << 8 * bytes) - 1; }

std::uint64_t whole_of(const Json& value, std::size_t bytes) {
  if (!value.is_number()) return none_of(bytes);
  const double number = value.get<double>();
  if (!(number >= 0.0)) return none_of(bytes);
  const std::uint64_t high = none_of(bytes) - 1;
  if (number >= static_cast<double>(high)) return high;
  return value.is_number_integer() ? value.get<std::uint64_t>() : static_cast<std::uint64_t>(number);
}

std::uint64_t word_of(const Json& value, Words words) {
  if (!value.is_string()) return none_of(1);
  const auto found = std::find(words.begin(), words.end(), value.text());
  return found == words.end() ? none_of(1) : static_cast<std::uint64_t>(found - words.begin());
}

void append_one(std::string& out, const Parameter& parameter, const Json& value) {
  switch (parameter.type) {
    case ValueType::kWhole:
      return append_whole(out, whole_of(value, parameter.bytes), parameter.bytes);
    case ValueType::kReal: {
      constexpr std::uint64_t kNotANumber = 0x7ff8000000000000u;
      return append_whole(out, value.is_number() ? std::bit_cast<std::uint64_t>(value.get<double>()) : kNotANumber, 8);
    }
    case ValueType::kFlag:
      return append_whole(out, value.is_boolean() ? (value.get<bool>() ? 1u : 0u) : none_of(1), 1);
    case ValueType::kWord:
      return append_whole(out, word_of(value, parameter.words), 1);
    case ValueType::kText: {
      std::string text(value.is_string() ? text::whole_characters(value.text(), parameter.bytes) : std::string_view());
      text.resize(parameter.bytes, '\0');
      out += text;
      return;
    }
    case ValueType::kTime:
      return append_time(out, value.is_number_unsigned() ? value.get<std::uint64_t>() : 0);
  }
}

[[noreturn]] void refuse(const Parameter& parameter, std::uint64_t value, const std::string& allowed) {
  throw JsonError(std::string(parameter.name) + ": " + std::to_string(value) + ": allowed " + allowed);
}

Json word_from(const Parameter& parameter, std::uint64_t value) {
  if (value == none_of(1)) return nullptr;
  if (parameter.type == ValueType::kFlag) {
    if (value > 1) refuse(parameter, value, "0 or 1");
    return value == 1;
  }
  if (value >= parameter.words.size()) refuse(parameter, value, "0 to " + std::to_string(parameter.words.size() - 1));
  return parameter.words[value];
}

Json text_from(const Parameter& parameter, std::string_view bytes) {
  const std::string text(bytes.substr(0, bytes.find('\0')));
  try {
    (void)Json(text).dump();
  } catch (const JsonError&) {
    throw JsonError(std::string(parameter.name) + ": is no UTF-8: send the text in UTF-8");
  }
  return text.empty() ? Json() : Json(text);
}

Json value_from(const Parameter& parameter, std::string_view bytes) {
  const std::uint64_t value = read_whole(bytes.substr(0, std::min<std::size_t>(bytes.size(), 8)));
  switch (parameter.type) {
    case ValueType::kWhole:
      return value == none_of(bytes.size()) ? Json() : Json(value);
    case ValueType::kReal: {
      const auto number = std::bit_cast<double>(value);
      return number == number ? Json(number) : Json();
    }
    case ValueType::kFlag:
    case ValueType::kWord:
      return word_from(parameter, value);
    case ValueType::kText:
      return text_from(parameter, bytes);
    case ValueType::kTime:
      return read_time(bytes);
  }
  return nullptr;
}

bool is_empty(const Json& list) {
  return std::all_of(list.begin(), list.end(), [](const Json& each) { return each.is_null(); });
}

}  // namespace

std::size_t Sizes::of(Count count) const {
  if (count == Count::kAngles) return angles;
  if (count == Count::kCables) return cables;
  return static_cast<std::size_t>(count);
}

Sizes sizes_of(const Json& robot) {
  const api::RequestBounds bounds = api::request_bounds(robot);
  const std::size_t drives = robot.at("drives").at("zero_counts").size();
  const std::size_t cables = bounds.arm == api::kCableArm ? drives : 0;
  if (bounds.angle_deg.size() > kMaxList || cables > kMaxList)
    throw JsonError("robot: more than 64 angles or cables fit into no packet: describe a smaller robot");
  return {static_cast<std::uint8_t>(bounds.angle_deg.size()), static_cast<std::uint8_t>(cables)};
}

std::span<const ReportRow> reports() { return kReports; }

const ReportRow* find_structure(std::uint64_t structure) {
  const auto found = std::find_if(kReports.begin(), kReports.end(), [structure](const ReportRow& row) {
    return row.structure != kNoStructure && row.structure == structure;
  });
  return found == kReports.end() ? nullptr : &*found;
}

const ReportRow* find_report(const Telemetry& telemetry) {
  const bool is_time = !telemetry.primary.has_secondary;
  if (is_time != (telemetry.primary.apid == kTimeApid)) return nullptr;
  const std::uint8_t service = is_time ? 9 : telemetry.service, subtype = is_time ? 2 : telemetry.subtype;
  const std::uint8_t first = telemetry.data.empty() ? 0 : static_cast<std::uint8_t>(telemetry.data[0]);
  const auto found = std::find_if(kReports.begin(), kReports.end(), [&](const ReportRow& row) {
    return row.service == service && row.subtype == subtype &&
           (row.structure == kNoStructure || row.structure == first);
  });
  return found == kReports.end() ? nullptr : &*found;
}

std::span<const CommandRow> commands() { return kCommandRows; }

const CommandRow* find_command(std::uint8_t service, std::uint8_t subtype, std::uint64_t function) {
  const auto found = std::find_if(kCommandRows.begin(), kCommandRows.end(), [&](const CommandRow& row) {
    return row.service == service && row.subtype == subtype && row.function == function;
  });
  return found == kCommandRows.end() ? nullptr : &*found;
}

bool is_known(std::uint8_t service, std::uint8_t subtype) {
  return std::any_of(kCommandRows.begin(), kCommandRows.end(),
                     [&](const CommandRow& row) { return row.service == service && row.subtype == subtype; });
}

std::vector<Parameter> arguments_of(const CommandRow& row) {
  std::vector<Parameter> out(row.parameters.begin(), row.parameters.end());
  for (const char* name : row.fields) out.push_back(argument_of(field_of(row, name)));
  return out;
}

std::uint8_t severity_of(std::string_view kind, std::int64_t number) {
  constexpr std::uint8_t kInformative = 1, kLow = 2, kMedium = 3, kHigh = 4;
  if (kind == "fault" || kind == "boot_problem" || kind == "stop") return kHigh;
  if (kind == "emergency" || kind == "host_warning" || kind == "left_out") return kMedium;
  if (kind == "verdict" || kind == "refusal" || kind == "client") return kLow;
  if (kind == "boot" || kind == "homing") return number == 1 ? kInformative : kMedium;
  if (kind == "friction" || kind == "load_cell" || kind == "clear") return number == 0 ? kInformative : kLow;
  if (kind == "path" && number == 0) return kLow;
  return kInformative;
}

std::uint16_t definition_of(std::string_view kind) {
  const auto known = event::event_kind_from(kind);
  return known ? static_cast<std::uint16_t>(static_cast<unsigned>(*known) + 1) : std::uint16_t{0};
}

std::span<const OwnEventRow> own_events() { return kOwnEvents; }

const OwnEventRow& row_of(OwnEvent event) {
  return *std::find_if(kOwnEvents.begin(), kOwnEvents.end(), [event](const auto& row) { return row.event == event; });
}

std::string_view meaning_of(Failure failure) {
  switch (failure) {
    case Failure::kLength:
      return "the packet has another length than its header says, or than is allowed";
    case Failure::kChecksum:
      return "the packet error control is wrong";
    case Failure::kHeader:
      return "version, type, sequence flags or secondary header are not those of a telecommand";
    case Failure::kApid:
      return "no application process has this APID";
    case Failure::kService:
      return "there is no such service type or subtype";
    case Failure::kFunction:
      return "there is no such function, structure or packet store";
    case Failure::kArgument:
      return "the arguments have another length or a value that is not allowed";
    case Failure::kTooMany:
      return "64 telecommands are not completed yet, or a resend is under way";
    case Failure::kAway:
      return "lianad is not there, or left before its answer";
    case Failure::kNoConfirmation:
      return "the completion was not seen in time";
    case Failure::kNotReached:
      return "it ended before its goal";
    case Failure::kStopped:
      return "an emergency stop ended it";
    case Failure::kNotOwner:
      return "another client owns motion now, or a later telecommand replaced this one";
    case Failure::kLinkLost:
      return "the link to the ground was lost";
    default:
      return "";
  }
}

std::span<const Failure> own_failures() { return kOwnFailures; }

std::size_t bytes_of(std::span<const Parameter> parameters, const Sizes& sizes) {
  std::size_t out = 0;
  for (const Parameter& each : parameters) out += each.bytes * sizes.of(each.count);
  return out;
}

void append_value(std::string& out, const Parameter& parameter, const Sizes& sizes, const Json& value) {
  if (parameter.count == Count::kOne) return append_one(out, parameter, value);
  for (std::size_t i = 0; i < sizes.of(parameter.count); ++i) append_one(out, parameter, entry_or_null(value, i));
}

std::string record_of(const ReportRow& row, const Sizes& sizes, const Json& state) {
  std::string out;
  if (row.structure != kNoStructure) append_whole(out, row.structure, 1);
  for (const Parameter& each : row.parameters) append_value(out, each, sizes, at_path(state, each.path));
  return out;
}

Json values_of(std::span<const Parameter> parameters, const Sizes& sizes, std::string_view bytes) {
  if (const std::size_t wanted = bytes_of(parameters, sizes); bytes.size() != wanted) {
    throw JsonError("values of " + std::to_string(bytes.size()) + " octets: allowed " + std::to_string(wanted) +
                    ": send as many as the packet's definition has");
  }
  Json out = Json::object();
  for (const Parameter& each : parameters) {
    Json list = Json::array();
    for (std::size_t i = 0; i < sizes.of(each.count); ++i) {
      list.push_back(value_from(each, bytes.substr(0, each.bytes)));
      bytes.remove_prefix(each.bytes);
    }
    if (list.empty() || is_empty(list)) continue;
    out[each.name] = each.count == Count::kOne ? list[0] : list;
  }
  return out;
}

Json request_of(const CommandRow& row, const Sizes& sizes, std::string_view bytes) {
  const std::vector<Parameter> arguments = arguments_of(row);
  Json out = values_of(arguments, sizes, bytes);
  for (const Parameter& each : arguments) {
    const std::string_view own = bytes.substr(0, each.bytes * sizes.of(each.count));
    bytes.remove_prefix(own.size());
    const bool is_required = field_of(row, each.name).need == api::Need::kRequired;
    if (!is_required && own.find_first_not_of('\0') == std::string_view::npos) out.erase(each.name);
  }
  out["op"] = row.op;
  if (*row.command != '\0') out["command"] = row.command;
  return out;
}

Json report_json(const Telemetry& telemetry, const Sizes& sizes) {
  Json out{{"apid", telemetry.primary.apid}, {"count", telemetry.primary.count}};
  if (telemetry.primary.has_secondary) {
    out["service"] = telemetry.service;
    out["subtype"] = telemetry.subtype;
    out["time_us"] = telemetry.time_us;
    out["destination"] = telemetry.destination;
  }
  const ReportRow* row = find_report(telemetry);
  if (row == nullptr) return out;
  out["name"] = row->name;
  const std::string_view data = telemetry.data;
  out["values"] = values_of(row->parameters, sizes, data.substr(row->structure == kNoStructure ? 0 : 1));
  return out;
}

}  // namespace liana::ground
