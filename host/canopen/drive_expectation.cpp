#include "host/canopen/drive_expectation.hpp"

#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

namespace liana::canopen {
namespace {

// Ten times the lag of the drives at full cable speed (10 mm/s, 30 ms): only a drive that cannot follow gets there.
constexpr double kFollowingWindow_m = 0.005;
constexpr int kDeadlinePeriods = 3;
constexpr int kMasterHeartbeatsMissed = 3;

std::uint32_t rounded(double value) { return static_cast<std::uint32_t>(std::lround(value)); }

// Gear as a fraction in lowest terms; tables give it to three decimals at most.
void set_gear(DriveExpectation& drive, double gear) {
  constexpr std::uint32_t kDenominator = 1000;
  const std::uint32_t motor = rounded(gear * kDenominator);
  const std::uint32_t divisor = std::gcd(motor, kDenominator);
  drive.gear_motor_turns = motor / divisor;
  drive.gear_drum_turns = kDenominator / divisor;
}

}  // namespace

std::vector<DriveExpectation> drive_expectations(const RobotConfig& robot, const BusesConfig& buses) {
  DriveExpectation common;
  common.vendor = robot.identity.vendor;
  common.product = robot.identity.product;
  common.revision = robot.identity.revision;
  common.counts_per_turn = robot.counts_per_turn;
  common.rated_torque_mNm = rounded(robot.rated_torque_Nm * 1000.0);
  set_gear(common, robot.gear);
  common.period = interpolation_period(buses.period_us());
  common.rpdo_deadline_ms = static_cast<std::uint16_t>((kDeadlinePeriods * buses.period_us() + 999) / 1000);
  common.heartbeat_ms = static_cast<std::uint16_t>(buses.heartbeat_ms);
  common.master_timeout_ms = static_cast<std::uint16_t>(kMasterHeartbeatsMissed * buses.heartbeat_ms);
  std::vector<DriveExpectation> drives;
  for (std::int32_t i = 0; i < robot.table.cable_count(); ++i) {
    DriveExpectation drive = common;
    drive.node = static_cast<std::uint8_t>(i + 1);
    drive.bus = buses.bus_of_node(i + 1);
    if (drive.bus < 0) {
      throw std::runtime_error("bus table " + buses.name + ": buses: node " + std::to_string(i + 1) + " of robot " +
                               robot.name + " is on no bus; each drive must be on exactly one");
    }
    if (!robot.drive_serials.empty()) drive.serial = robot.drive_serials[static_cast<std::size_t>(i)];
    drive.following_window_counts =
        rounded(kFollowingWindow_m / robot.table.drive[static_cast<std::size_t>(i)].metres_per_count);
    drives.push_back(drive);
  }
  return drives;
}

}  // namespace liana::canopen
