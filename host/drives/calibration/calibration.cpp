#include "host/drives/calibration/calibration.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "firmware_like/math/convert.hpp"
#include "host/model/config/canonical.hpp"
#include "host/model/config/field.hpp"
#include "host/model/config/sha256.hpp"

namespace liana::calibration {

using namespace cable;
namespace {

using std::chrono::sys_days;

constexpr double kTwoPi = 6.28318530717958647692;
constexpr double kOtherDrumShare = 0.05;  // a drum further from the table's radius is another drum
constexpr double kMaxFriction = 0.5;      // as in robot tables
constexpr const char* kAgain = "run liana calibrate again";

double metres_per_count(const CableCalibration& cable, const config::RobotConfig& robot) {
  return kTwoPi * cable.drum_radius_m / (robot.counts_per_turn * robot.gear);
}

std::string checksum(Json content) {
  content.erase("sha256");
  return config::sha256_hex(config::canonical_json(content));
}

Json json_of(const FrictionOf& friction) { return {{"mu", friction.mu}, {"sd", friction.sd}}; }

Json json_of(const Friction& friction) {
  Json out = json_of(friction.arm);
  out["segments"] = Json::array();
  for (const std::optional<FrictionOf>& segment : friction.segment)
    out["segments"].push_back(segment ? json_of(*segment) : Json());
  return out;
}

Json content_of(const Calibration& calibration) {
  Json cables = Json::array();
  for (const CableCalibration& cable : calibration.cables) {
    cables.push_back({{"serial", cable.serial},
                      {"direction", cable.direction},
                      {"zero_counts", cable.zero_counts},
                      {"drum_radius_m", cable.drum_radius_m},
                      {"pretension_N", cable.pretension_N},
                      {"offset_m", cable.offset_m}});
  }
  Json content = {{"format", 1},
                  {"kind", "calibration"},
                  {"robot", calibration.robot},
                  {"robot_sha256", calibration.robot_sha256},
                  {"date", calibration.date},
                  {"cables", cables}};
  if (calibration.friction) content["friction"] = json_of(*calibration.friction);
  for (const FieldValue& one : calibration.fields)
    content["fields"].push_back({{"field", one.field}, {"value", one.value}, {"sd", one.sd}});
  return content;
}

// Days since 1970-01-01.
sys_days read_date(const config::Field& field) {
  int year = 0;
  unsigned month = 0, day = 0;
  char end = 0;
  const std::string text = field.json().is_string() ? field.json().get<std::string>() : "";
  const bool read = text.size() == 10 && std::sscanf(text.c_str(), "%4d-%2u-%2u%c", &year, &month, &day, &end) == 3;
  const std::chrono::year_month_day date{std::chrono::year{year}, std::chrono::month{month}, std::chrono::day{day}};
  if (!read || !date.ok()) field.refuse("a date such as 2026-01-31", kAgain);
  return date;
}

void check_age(const config::Field& field, const config::RobotConfig& robot, const std::string& today) {
  const Json now = today;
  const auto days = (read_date(config::Field(now, "clock", "today")) - read_date(field)).count();
  const std::string allowed = "0 to " + std::to_string(robot.calibration_days) + " days before today, " + today;
  if (days < 0) field.refuse(allowed, "set the clock of this computer, or " + std::string(kAgain));
  if (days > robot.calibration_days) field.refuse(allowed + " (drives.calibration_days of the robot table)", kAgain);
}

CableCalibration read_cable(const config::Field& field, const config::RobotConfig& robot) {
  field.only({"serial", "direction", "zero_counts", "drum_radius_m", "pretension_N", "offset_m"});
  CableCalibration cable;
  cable.serial = static_cast<std::uint32_t>(field.at("serial").integer(0, 0xffffffff));
  cable.direction = static_cast<std::int32_t>(field.at("direction").integer(-1, 1));
  if (cable.direction == 0) field.at("direction").refuse("1 or -1", kAgain);
  cable.zero_counts = static_cast<std::int32_t>(field.at("zero_counts").integer(-1000000000, 1000000000));
  cable.drum_radius_m =
      field.at("drum_radius_m")
          .number({(1.0 - kOtherDrumShare) * robot.drum_radius_m, (1.0 + kOtherDrumShare) * robot.drum_radius_m});
  cable.pretension_N = field.at("pretension_N").number({0, robot.table.tension.hard_limit_N});
  cable.offset_m = field.at("offset_m").number({-10, 10});
  return cable;
}

FrictionOf read_friction_of(const config::Field& field) {
  return {field.at("mu").number({0, kMaxFriction}), field.at("sd").number({0, kMaxFriction})};
}

Friction read_friction(const config::Field& field, const config::RobotConfig& robot) {
  field.only({"mu", "sd", "segments"});
  Friction out{read_friction_of(field), {}};
  const auto count = static_cast<std::size_t>(robot.table.segment_count);
  const config::Field segments = field.at("segments");
  segments.size(count, count, "one entry per segment, null where it is not known");
  for (std::size_t i = 0; i < count; ++i) {
    const config::Field segment = segments.element(i);
    out.segment.push_back(segment.json().is_null() ? std::nullopt : std::optional(read_friction_of(segment)));
  }
  return out;
}

// In the order of the table's fields, so that none is there twice.
std::vector<FieldValue> read_fields(const config::Field& list, const config::RobotConfig& robot) {
  const std::vector<TableField> fields = table_fields(robot.table);
  const std::size_t count = list.size(1, fields.size(), "leave it out where nothing was measured");
  std::vector<FieldValue> out;
  auto known = fields.begin();
  for (std::size_t i = 0; i < count; ++i) {
    const config::Field entry = list.element(i);
    entry.only({"field", "value", "sd"});
    known =
        std::find_if(known, fields.end(), [&](const TableField& one) { return entry.at("field").json() == one.field; });
    if (known == fields.end())
      entry.at("field").refuse("a field that is measured of this robot, once, in the order of docs/how-to/calibrate.md",
                               kAgain);
    out.push_back({known->field,
                   entry.at("value").number({known->table_value - known->room(), known->table_value + known->room()}),
                   entry.at("sd").number({0, known->table_sd, true})});
    ++known;
  }
  return out;
}

}  // namespace

std::string today_utc() {
  const std::chrono::year_month_day date{std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now())};
  char text[16];
  std::snprintf(text, sizeof text, "%04d-%02u-%02u", static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                static_cast<unsigned>(date.day()));
  return text;
}

std::string calibration_json(const Calibration& calibration) {
  Json content = content_of(calibration);
  content["sha256"] = checksum(content);
  return config::canonical_json(content) + "\n";
}

Calibration parse_calibration(const std::string& text, const std::string& file, const config::RobotConfig& robot,
                              const std::string& today) {
  const Json content = config::parse_json(text, file, kAgain);
  const config::Field table(content, file, "");
  if (!content.is_object()) table.refuse("a calibration file", "give a file that liana calibrate --out has written");
  config::check_kind(table, "calibration");
  const config::Field sum = table.at("sha256");
  if (sum.json() != checksum(content)) {
    sum.refuse(checksum(content),
               "the file was changed or damaged after it was written; take a good copy, or " + std::string(kAgain));
  }
  table.only({"format", "kind", "robot", "robot_sha256", "date", "cables", "friction", "fields", "sha256"});
  Calibration out;
  out.robot = table.at("robot").name(40);
  if (out.robot != robot.name)
    table.at("robot").refuse("\"" + robot.name + "\"", "it is the calibration of another robot; take that of this one");
  out.robot_sha256 = table.at("robot_sha256").name(64);
  if (out.robot_sha256 != config::sha256_hex(robot.canonical_json)) {
    table.at("robot_sha256")
        .refuse("\"" + config::sha256_hex(robot.canonical_json) + "\"",
                "the robot table was changed since; " + std::string(kAgain));
  }
  check_age(table.at("date"), robot, today);
  out.date = table.at("date").json().get<std::string>();
  const auto count = static_cast<std::size_t>(robot.table.cable_count());
  const config::Field cables = table.at("cables");
  cables.size(count, count, "one entry per cable, those of segment 1 first");
  for (std::size_t i = 0; i < count; ++i) out.cables.push_back(read_cable(cables.element(i), robot));
  if (content.contains("friction")) out.friction = read_friction(table.at("friction"), robot);
  if (content.contains("fields")) out.fields = read_fields(table.at("fields"), robot);
  return out;
}

Calibration load_calibration(const std::string& path, const config::RobotConfig& robot, const std::string& today) {
  return parse_calibration(config::read_text_file(path), path, robot, today);
}

void shift_zeros(const CableVector& longer_m, const config::RobotConfig& robot, Calibration& calibration) {
  for (std::size_t i = 0; i < calibration.cables.size(); ++i) {
    CableCalibration& cable = calibration.cables[i];
    const double counts = longer_m[i] / metres_per_count(cable, robot);
    cable.zero_counts -= cable.direction * to_counts(counts).value;
    cable.offset_m += longer_m[i];
  }
}

void apply(const Calibration& calibration, config::RobotConfig& robot) {
  if (calibration.friction) robot.table.friction_mu = calibration.friction->arm.mu;
  set_fields(table_fields(robot.table), calibration.fields, robot.table);
  robot.drive_serials.clear();
  for (std::size_t i = 0; i < calibration.cables.size(); ++i) {
    const CableCalibration& cable = calibration.cables[i];
    DriveParams& drive = robot.table.drive[i];
    drive.direction = cable.direction;
    drive.zero_counts = cable.zero_counts;
    drive.metres_per_count = metres_per_count(cable, robot);
    robot.drive_serials.push_back(cable.serial);
  }
}

}  // namespace liana::calibration
