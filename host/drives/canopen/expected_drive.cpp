#include "host/drives/canopen/expected_drive.hpp"

#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "firmware_like/cable/arm/cables.hpp"
#include "firmware_like/cable/arm/drive_limits.hpp"
#include "firmware_like/drive/pdo.hpp"
#include "firmware_like/serial/drive_units.hpp"
#include "host/model/config/drive_names.hpp"
#include "host/model/config/drive_types_of_buses.hpp"
#include "host/model/config/robot_parts.hpp"

namespace liana::canopen {
namespace {

// Ten times the lag of the drives at full cable speed (10 mm/s, 30 ms): only a drive that cannot follow gets there.
constexpr double kFollowingWindow_m = 0.005;
constexpr double kFollowingWindow_rad = 0.02;  // of a serial arm's joint: ten times the lag at 4 deg/s and 30 ms
constexpr int kDeadlinePeriods = 3;
constexpr int kMasterHeartbeatsMissed = 3;

std::uint32_t rounded(double value) { return static_cast<std::uint32_t>(std::lround(value)); }

// Gear as a fraction in lowest terms; tables give it to three decimals at most.
void set_gear(ExpectedDrive& drive, double gear) {
  constexpr std::uint32_t kDenominator = 1000;
  const std::uint32_t motor = rounded(gear * kDenominator);
  const std::uint32_t divisor = std::gcd(motor, kDenominator);
  drive.gear_motor_turns = motor / divisor;
  drive.gear_drum_turns = kDenominator / divisor;
}

// What all drives of a robot have in common.
template <class Robot>
ExpectedDrive common_expectation(const Robot& robot, const config::BusesConfig& buses) {
  ExpectedDrive common;
  common.vendor = robot.identity.vendor;
  common.product = robot.identity.product;
  common.revision = robot.identity.revision;
  common.counts_per_turn = robot.counts_per_turn;
  common.rated_torque_mNm = robot.rated_torque_Nm * 1000.0 / robot.gear;
  set_gear(common, robot.gear);
  common.period = config::interpolation_period(buses.period_us());
  common.rpdo_deadline_ms = static_cast<std::uint16_t>((kDeadlinePeriods * buses.period_us() + 999) / 1000);
  common.heartbeat_ms = static_cast<std::uint16_t>(buses.heartbeat_ms);
  common.master_timeout_ms = static_cast<std::uint16_t>(kMasterHeartbeatsMissed * buses.heartbeat_ms);
  return common;
}

// What of one drive is its own.
struct OwnDrive {
  double window_counts = 0.0;  // of following error
  int segment = 0;
  DriveProfile demand;
};

template <class Robot>
std::vector<ExpectedDrive> expectations(const Robot& robot, const std::vector<OwnDrive>& own,
                                        const config::BusesConfig& buses) {
  config::check_nodes(robot.name, static_cast<std::int32_t>(own.size()), robot.drive_serials, "robot " + robot.name,
                      buses);
  const ExpectedDrive common = common_expectation(robot, buses);
  const std::map<std::int32_t, config::DriveType> types = config::drive_types(buses);
  const std::vector<config::DrivePlace> places = buses.places();
  std::vector<ExpectedDrive> drives;
  for (std::size_t i = 0; i < own.size(); ++i) {
    ExpectedDrive drive = common;
    drive.index = i;
    drive.node = static_cast<std::uint8_t>(places[i].node);
    drive.axis = static_cast<std::uint8_t>(places[i].axis);
    drive.bus = buses.bus_of_node(places[i].node);
    if (!robot.drive_serials.empty()) drive.serial = robot.drive_serials[i];
    if (const auto named = types.find(places[i].node); named != types.end()) drive.type = named->second;
    drive.segment = own[i].segment;
    drive.following_window_counts = rounded(own[i].window_counts);
    drive.demand = own[i].demand;
    drives.push_back(drive);
  }
  return drives;
}

}  // namespace

std::string name_of(const ExpectedDrive& drive) {
  return config::drive_text(drive.index, {drive.node, drive.axis}, drive.segment);
}

std::size_t axes_of_first(std::span<const ExpectedDrive> drives) noexcept {
  std::size_t count = 1;
  while (count < drives.size() && drives[count].bus == drives[0].bus && drives[count].node == drives[0].node) ++count;
  return count;
}

std::vector<ExpectedDrive> drive_expectations(const config::RobotConfig& robot, const config::BusesConfig& buses) {
  const cable::RobotParams& table = robot.table;
  cable::CableVector zero_payout_m = cable::cable_layout(table).zero_length_m;
  for (double& each : zero_payout_m) each += table.lead_m;
  const GateLimits limits = cable::make_gate_limits(table, zero_payout_m);
  const config::DriveNames names(table);
  std::vector<OwnDrive> own;
  for (std::size_t i = 0; i < static_cast<std::size_t>(table.cable_count()); ++i) {
    const double metres_per_count = table.drive[i].metres_per_count;
    own.push_back(
        {kFollowingWindow_m / metres_per_count,
         names.segment_of(i),
         {limits.drive[i].min_counts, limits.drive[i].max_counts, table.limits.cable_speed_m_s / metres_per_count}});
  }
  return expectations(robot, own, buses);
}

std::vector<ExpectedDrive> drive_expectations(const config::SerialRobotConfig& robot,
                                              const config::BusesConfig& buses) {
  const GateLimits limits = serial::make_gate_limits(robot.table);
  std::vector<OwnDrive> own;
  for (std::size_t i = 0; i < robot.table.joints(); ++i) {
    const double rad_per_count = robot.table.drive[i].rad_per_count;
    own.push_back(
        {kFollowingWindow_rad / rad_per_count,
         0,
         {limits.drive[i].min_counts, limits.drive[i].max_counts, robot.table.joint[i].rate_rad_s / rad_per_count}});
  }
  std::vector<ExpectedDrive> drives = expectations(robot, own, buses);
  for (const ExpectedDrive& drive : drives) {
    if (drive.type.has_torque) continue;
    throw std::runtime_error("bus table " + buses.name + ": drives: " + name_of(drive) + " of robot " + robot.name +
                             " is of type " + drive.type.name +
                             ", which reports no torque (torque = \"none\"): allowed is a type with 6077, since joints "
                             "are watched by it");
  }
  return drives;
}

}  // namespace liana::canopen
