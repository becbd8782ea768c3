// `liana drive check`: what a boot would refuse of one drive, or of all drives of a robot table; by reading, or with
// --try by writing.
#include <cstdio>

#include "host/apps/cli/drive_session.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/base/json/json.hpp"
#include "host/drives/canopen/boot_mismatch.hpp"
#include "host/drives/commissioning/boot_check.hpp"
#include "host/model/config/drive_type.hpp"

namespace liana::cli {
namespace {

constexpr std::uint16_t kFollowingWindow = 0x6065;  // of axis 1

std::string name_of(const canopen::BootObject& object) {
  return config::object_name({object.index, object.sub}) + " (" + object.name + ")";
}

bool is_pdo_object(const canopen::BootObject& object) {
  return (object.index & 0xFD00) == 0x1400 || (object.index & 0xFC00) == 0x1800;
}

// What the boot would find missing, and what it would write over something else. Without a robot nobody knows the
// window.
Json outlook(const canopen::BootNode& node) {
  Json missing = Json::array(), written = Json::array();
  int pdo_writes = 0;
  const std::span<const canopen::BootObject> objects = node.plan().objects();
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const canopen::BootObject& object = objects[i];
    const canopen::BootOutcome& outcome = node.outcomes()[i];
    const bool spare_pdo = object.keep != 0 && object.may_be_missing;
    if (!outcome.found && !outcome.is_refused && !spare_pdo) missing.push_back(name_of(object));
    const bool differs = outcome.found && ((*outcome.found ^ object.value) & object.mask) != 0;
    const bool is_unknown =
        object.index == canopen::on_axis(kFollowingWindow, std::max(std::uint8_t{1}, object.axis)) && object.value == 0;
    if (!object.write || !differs || is_unknown) continue;
    if (is_pdo_object(object)) {
      ++pdo_writes;
      continue;
    }
    written.push_back({{"object", name_of(object)},
                       {"found", *outcome.found},
                       {"to", object.value | (*outcome.found & object.keep)}});
  }
  return {{"not_there", missing}, {"would_be_written", written}, {"pdo_writes", pdo_writes}};
}

void print_outlook(const Json& said) {
  for (const Json& each : said["not_there"]) std::printf("  not there, so not checked: %s\n", each.text().c_str());
  for (const Json& each : said["would_be_written"])
    std::printf("  would be written: %s: %u, now %u\n", each["object"].text().c_str(), each["to"].get<std::uint32_t>(),
                each["found"].get<std::uint32_t>());
}

// What a look at the boot of this drive has found.
Json looked_at(DriveSession& session, const std::string& who, const canopen::ExpectedDrive& drive,
               canopen::BootReference reference, bool tries) {
  const commissioning::BootCheck check =
      tries ? commissioning::check_by_trial(session.desk, drive) : commissioning::check_by_reading(session.desk, drive);
  Json said = outlook(*check.node);
  said["node"] = drive.node;
  said["axis"] = drive.axis;
  said["name"] = who;
  said["type"] = drive.type.name;
  said["ok"] = said["would_boot"] = check.would_boot();
  said["writes_tried"] = tries;
  said["mode_watched"] = check.is_watched;
  said["not_restored"] = check.not_restored;
  said["stops_by_itself"] = drive.type.stops_by_itself();
  if (const std::string warning = nothing_stops(drive.type); !warning.empty()) said["warning"] = warning;
  said["refusals"] = Json::array();
  for (const canopen::BootMismatch& mismatch : check.node->mismatches())
    said["refusals"].push_back(canopen::describe({&mismatch, 1}, 0, who, reference));
  for (const std::string& refusal : check.more) said["refusals"].push_back(who + ": " + refusal);
  return said;
}

// Refusals, or that it would boot; then what was not tried or not put back.
void print_verdict(const Json& said) {
  for (const Json& each : said["refusals"]) std::printf("refused: %s\n", each.text().c_str());
  const std::string who = said["name"].text(), type = said["type"].text();
  const bool is_tried = said.value("writes_tried", false);
  if (said["ok"].get<bool>()) {
    const std::size_t untried =
        said["would_be_written"].size() + static_cast<std::size_t>(said["pdo_writes"].get<int>());
    std::printf("%s would boot as type %s: %s", who.c_str(), type.c_str(),
                is_tried ? "its boot was carried out, and taken back\n" : "all that reading shows is as it has to be");
    if (!is_tried) std::printf("; nothing was written, %zu writes are untried (--try tries them)\n", untried);
  } else if (said.contains("not_there")) {
    std::printf("%s would not boot as type %s\n", who.c_str(), type.c_str());
  }
  for (const Json& each : said.value("not_restored", Json::array()))
    std::printf("warning: %s: %s, did not take its old value back: switch the drive off and on\n", who.c_str(),
                each.text().c_str());
  if (!said.value("mode_watched", true))
    std::printf("  6061 is not there: whether %s stays in its mode is not watched\n", who.c_str());
  if (said.contains("warning")) std::printf("warning: %s\n", said["warning"].text().c_str());
}

int check_one(DriveSession& session, const DriveOptions& options, std::uint8_t node, std::uint8_t axis) {
  const commissioning::Place at = session.place(node, axis);
  if (const commissioning::Answer there = session.desk.read(at, 0x1000, 0); !there.is_done())
    return tell_failure(session, at, "reading 1000", there, options.json);
  const Json said = looked_at(session, session.where(at), expected_drive(session, at, options),
                              canopen::BootReference::kDesk, options.tries);
  if (options.json) {
    std::printf("%s\n", said.dump().c_str());
  } else {
    print_verdict(said);
    print_outlook(said);
  }
  return said["ok"].get<bool>() ? launcher::ExitCode::kExitOk : launcher::ExitCode::kExitFailure;
}

std::vector<canopen::ExpectedDrive> drives_of_robot(const std::string& name, const config::BusesConfig& buses) {
  const std::string robot = launcher::evaluate_table("robot", name);
  return launcher::checked([&] {
    if (config::robot_kind(robot, name) == "serial")
      return canopen::drive_expectations(config::parse_serial_robot(robot, name), buses);
    return canopen::drive_expectations(config::parse_robot(robot, name, "nominal", buses), buses);
  });
}

Json silent(const std::string& who, const canopen::ExpectedDrive& drive, const commissioning::Answer& answer) {
  const std::string why =
      answer.odd_length ? failure_text(answer) : "no answer within 1 s: it is missing, or has another id or bit rate";
  return {{"node", drive.node},  {"name", who},      {"type", drive.type.name},       {"ok", false},
          {"would_boot", false}, {"answers", false}, {"refusals", {who + ": " + why}}};
}

void print_robot(const std::string& robot, const Json& all, int good) {
  for (const Json& said : all) {
    print_verdict(said);
    if (said["ok"].get<bool>() && said["not_there"].size() > 0)
      std::printf("  %zu objects are not there, so not checked\n", said["not_there"].size());
  }
  std::printf("%s: %d of %zu drives would boot\n", robot.c_str(), good, all.size());
}

int check_robot(DriveSession& session, const DriveOptions& options, const std::vector<canopen::ExpectedDrive>& drives) {
  Json all = Json::array();
  int good = 0, answering = 0;
  for (const canopen::ExpectedDrive& drive : drives) {
    const commissioning::Place at{drive.bus, drive.node};
    const commissioning::Answer there = session.desk.read(at, 0x1000, 0);
    const bool answers = there.status != canopen::SdoStatus::kTimeout;
    const std::string who = canopen::name_of(drive) + " on " + session.bus_of(at);
    all.push_back(answers ? looked_at(session, who, drive, canopen::BootReference::kRobotTable, options.tries)
                          : silent(who, drive, there));
    answering += answers ? 1 : 0;
    good += all.back()["ok"].get<bool>() ? 1 : 0;
  }
  const bool is_good = good == static_cast<int>(drives.size());
  if (options.json) {
    std::printf("%s\n", Json{{"ok", is_good}, {"robot", options.robot}, {"drives", all}}.dump().c_str());
  } else {
    print_robot(options.robot, all, good);
  }
  if (answering == 0) return kNobodyAnswers;
  return is_good ? launcher::ExitCode::kExitOk : launcher::ExitCode::kExitFailure;
}

}  // namespace

int drive_check_command(const DriveOptions& options) {
  if (options.robot.empty()) {
    drive_type_of(options);  // bad input before anything is asked
    const std::uint8_t node = node_of(options), axis = axis_of(options);
    DriveSession session(options);
    refuse_beside_a_master(session);
    return check_one(session, options, node, axis);
  }
  const config::BusesConfig buses = drive_buses(options);
  const std::vector<canopen::ExpectedDrive> drives = drives_of_robot(options.robot, buses);
  DriveSession session(options);
  refuse_beside_a_master(session);
  return check_robot(session, options, drives);
}

}  // namespace liana::cli
