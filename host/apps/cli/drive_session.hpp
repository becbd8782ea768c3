// What the subcommands of `liana drive` have in common: buses, places, and what a drive without a robot table is.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "host/apps/cli/commands.hpp"
#include "host/apps/launcher/interrupt.hpp"
#include "host/apps/launcher/silence.hpp"
#include "host/drives/canopen/expected_drive.hpp"
#include "host/drives/commissioning/desk.hpp"
#include "host/model/config/config.hpp"

namespace liana::cli {

constexpr int kNobodyAnswers = 3;  // exit code
constexpr std::int64_t kMaxNode = 126;

// The table that --bus names, or one bus of the interface that --can names, with all drives of --robot.
config::BusesConfig drive_buses(const DriveOptions& options);

// The node that --node names; refused where it names none: no motor turns because its id was left out.
std::uint8_t node_of(const DriveOptions& options);

// The axis that --axis names.
std::uint8_t axis_of(const DriveOptions& options);

// Open buses and the places on them.
struct DriveSession {
  explicit DriveSession(const DriveOptions& options);
  // A node, on the bus that the table has it on, else on the first.
  commissioning::Place place(std::uint8_t node, std::uint8_t axis = 1) const {
    return {std::max(0, buses.bus_of_node(node)), node, axis};
  }
  std::string bus_of(commissioning::Place at) const { return buses.buses[static_cast<std::size_t>(at.bus)].name; }
  std::string where(commissioning::Place at) const {
    return "node " + std::to_string(at.node) + (at.axis > 1 ? ", axis " + std::to_string(at.axis) : "") + " on " +
           bus_of(at);
  }

  launcher::InterruptGuard guard;
  config::BusesConfig buses;
  commissioning::Desk desk;
  launcher::Silence silence;  // said while the bus does not go on
};

// "0x1A", at least so many digits.
std::string hex(std::uint32_t value, int digits);
// Why a transfer failed: an answer of the wrong length, silence, or an abort code in words.
std::string failure_text(const commissioning::Answer& answer);
// One exit code for what came of a transfer, told with `what` where it failed, and what to do after an abort code.
int tell_failure(const DriveSession& session, commissioning::Place at, const std::string& what,
                 const commissioning::Answer& answer, bool json, const std::string& remedy = "");
// What nothing stops when its master is lost, by its type; empty where something is sure to.
std::string nothing_stops(const config::DriveType& type);
// Throws when somebody else is the master here.
void refuse_beside_a_master(DriveSession& session);
// The table that --type names.
config::DriveType drive_type_of(const DriveOptions& options);
// What the drive says of itself stands for a robot table that there is not yet: identity, encoder, gear, torque.
canopen::ExpectedDrive expected_drive(DriveSession& session, commissioning::Place at, const DriveOptions& options);

}  // namespace liana::cli
