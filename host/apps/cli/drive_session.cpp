#include "host/apps/cli/drive_session.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "host/apps/cli/arguments.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/base/json/json.hpp"
#include "host/model/config/bench_buses.hpp"
#include "host/model/config/field.hpp"

namespace liana::cli {
namespace {

constexpr double kRate_hz = 100.0;
constexpr double kSilence_s = 3.0;

timing::TimeMode time_of(const DriveOptions& options) {
  const auto mode = timing::time_mode_from(options.time);
  if (!mode) throw launcher::BadInput("--time: " + options.time + ": allowed are fast, paced and real");
  return *mode;
}

// On a desk node 1, of a robot all.
std::vector<config::DrivePlace> nodes_of(const DriveOptions& options) {
  if (options.robot.empty()) return {{1}};
  const std::string robot = launcher::evaluate_table("robot", options.robot);
  const std::int32_t count = launcher::checked([&] { return config::drive_count(robot, options.robot); });
  std::vector<config::DrivePlace> nodes;
  for (std::int32_t node = 1; node <= count; ++node) nodes.emplace_back(node);
  return nodes;
}

}  // namespace

config::BusesConfig drive_buses(const DriveOptions& options) {
  if (options.can.empty() == options.bus.empty())
    throw launcher::BadInput("drive: say which bus: --can INTERFACE, or --bus TABLE (allowed is one of them)");
  if (!options.bus.empty()) {
    const std::string table = launcher::evaluate_table("buses", options.bus);
    return launcher::checked([&] { return config::parse_buses(table, options.bus); });
  }
  config::BusesConfig buses;
  buses.name = "desk";
  buses.backend = "socketcan";
  buses.rate_hz = kRate_hz;
  buses.command_interval_s = 1.0 / kRate_hz;
  const auto bitrate = static_cast<std::int32_t>(parse_whole("--bitrate", options.bitrate, 10000, 1000000, " bit/s"));
  buses.buses = {{options.can, bitrate, nodes_of(options)}};
  buses.heartbeat_ms = 100;
  buses.max_load = 1.0;
  return buses;
}

DriveSession::DriveSession(const DriveOptions& options)
    : buses(drive_buses(options)),
      desk(launcher::checked(  // no bus where there should be one is bad input
          [&] { return commissioning::Desk(buses, time_of(options), options.bus_socket, guard.any()); })),
      silence(kSilence_s, [this, seen = desk.tick_count()](double since_s) mutable {
        const std::uint64_t now = desk.tick_count();
        if (now != std::exchange(seen, now)) return;
        std::fprintf(stderr, "liana: the bus does not go on, %.0f s since the beginning: is its liana-bench there?\n",
                     since_s);
        if (!guard.any()) return;
        std::fprintf(stderr, "liana: interrupted; where the time of the bus stands still, no drive moves\n");
        std::_Exit(launcher::ExitCode::kExitInterrupted);  // this command waits for the bus, which does not come back
      }) {}

std::uint8_t node_of(const DriveOptions& options) {
  if (options.node.empty())
    throw launcher::BadInput("--node: not given: allowed 1 to " + std::to_string(kMaxNode) +
                             ": say which drive is meant; liana drive scan shows who answers");
  return static_cast<std::uint8_t>(parse_whole("--node", options.node, 1, kMaxNode));
}

std::uint8_t axis_of(const DriveOptions& options) {
  return static_cast<std::uint8_t>(parse_whole("--axis", options.axis, 1, config::kMaxAxes));
}

std::string hex(std::uint32_t value, int digits) {
  char text[16];
  std::snprintf(text, sizeof text, "0x%0*X", digits, value);
  return text;
}

std::string failure_text(const commissioning::Answer& answer) {
  if (answer.odd_length)
    return "its answer has " + std::to_string(*answer.odd_length) +
           " bytes, and an SDO answer has 8 (CiA 301): nothing of it is taken; update the drive's firmware, or ask its "
           "maker";
  if (answer.status == canopen::SdoStatus::kTimeout)
    return "no answer within 1 s: the node is missing, stopped, or has another id or bit rate";
  return "refused with abort code " + hex(answer.abort_code, 8) + ", " + canopen::abort_text(answer.abort_code);
}

int tell_failure(const DriveSession& session, commissioning::Place at, const std::string& what,
                 const commissioning::Answer& answer, bool json, const std::string& remedy) {
  const bool aborted = answer.status == canopen::SdoStatus::kAborted;
  const std::string why = failure_text(answer) + (aborted ? remedy : "");
  if (json) {
    Json said = {{"node", at.node}, {"ok", false}, {"why", why}};
    if (aborted) said["abort_code"] = answer.abort_code;
    if (answer.odd_length) said["answer_bytes"] = *answer.odd_length;
    std::printf("%s\n", said.dump().c_str());
  }
  std::fprintf(stderr, "liana: %s: %s: %s\n", session.where(at).c_str(), what.c_str(), why.c_str());
  return aborted || answer.odd_length ? launcher::ExitCode::kExitFailure : kNobodyAnswers;
}

std::string nothing_stops(const config::DriveType& type) {
  if (type.stops_by_itself()) return "";
  return "a drive of type " + type.name + " stops by itself on nothing when its master is lost: its type has neither " +
         "1016:1 nor 1400:5 as required, or 6007 as no action; keep the emergency stop in reach";
}

void refuse_beside_a_master(DriveSession& session) {
  if (session.desk.hears_master())
    throw std::runtime_error("drive: another master (node 127) is on this bus: end lianad first");
}

config::DriveType drive_type_of(const DriveOptions& options) {
  const std::string table = launcher::evaluate_table("drive", options.type);
  return launcher::checked(
      [&] { return config::parse_drive_type(config::parse_json(table, options.type), options.type); });
}

canopen::ExpectedDrive expected_drive(DriveSession& session, commissioning::Place at, const DriveOptions& options) {
  const auto said = [&](std::uint16_t index, std::uint8_t sub, std::uint32_t otherwise) {
    const commissioning::Answer answer = session.desk.read(at, canopen::on_axis(index, at.axis), sub);
    return answer.is_done() ? answer.value() : otherwise;
  };
  canopen::ExpectedDrive drive;
  drive.bus = at.bus;
  drive.node = at.node;
  drive.axis = at.axis;
  drive.type = drive_type_of(options);
  drive.vendor = said(0x1018, 1, 0);
  drive.product = said(0x1018, 2, 0);
  drive.revision = said(0x1018, 3, 0);
  const config::Factor encoder{std::max(1U, said(0x608F, 1, 65536)), std::max(1U, said(0x608F, 2, 1))};
  drive.counts_per_turn = encoder.first / encoder.second;
  if (!drive.type.units.encoder && encoder.second != 1) drive.type.units.encoder = encoder;  // no table says otherwise
  drive.gear_motor_turns = std::max(1U, said(0x6091, 1, 1));
  drive.gear_drum_turns = std::max(1U, said(0x6091, 2, 1));
  drive.rated_torque_mNm = 1000.0 * said(0x6076, 0, 0) / drive.type.units.rated_torque_per_Nm;
  drive.period = config::interpolation_period(session.buses.period_us());
  drive.rpdo_deadline_ms = static_cast<std::uint16_t>((3 * session.buses.period_us() + 999) / 1000);
  return drive;
}

}  // namespace liana::cli
