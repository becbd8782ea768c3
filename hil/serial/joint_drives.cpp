#include "hil/serial/joint_drives.hpp"

#include <cmath>

namespace liana::bench {

DriveSettings joint_drive_settings(const SerialRobotConfig& robot, const BusesConfig& buses, std::size_t i) {
  DriveSettings settings;
  settings.node = static_cast<int>(i) + 1;
  settings.bus = static_cast<std::uint8_t>(buses.bus_of(settings.node));
  settings.dictionary = buses.dictionary_of(settings.node);
  settings.vendor = settings.dictionary.vendor.value_or(robot.vendor);
  settings.product = settings.dictionary.product.value_or(robot.product);
  settings.revision = settings.dictionary.revision.value_or(robot.revision);
  settings.serial = robot.drives[i].serial;
  settings.counts_per_turn = robot.counts_per_turn;
  settings.rated_torque_mNm = static_cast<std::uint32_t>(std::lround(1000.0 * robot.rated_torque_Nm));
  settings.gear = robot.gear;
  settings.fastest_counts_per_s = robot.fastest_counts_per_s;
  settings.servo_time_constant_s = robot.servo_time_constant_s;
  settings.is_torque_controlled = robot.is_torque_controlled;
  return settings;
}

JointDrives::JointDrives(const TrueArm& arm, const BusesConfig& buses, bool noisy, std::uint64_t seed)
    : Drives(arm.robot.product, seed), arm_(arm), noisy_(noisy), torque_noise_(seed, "torque noise") {
  for (std::size_t i = 0; i < arm.robot.joints.size(); ++i) {
    const DriveConfig& drive = arm.robot.drives[i];
    const double turned = (arm.start_rad[i] - arm.zero_offset_rad[i]) / arm.robot.rad_per_count();
    add(joint_drive_settings(arm.robot, buses, i), drive.zero_counts + drive.direction * turned);
  }
}

void JointDrives::move(double step_s) {
  for (std::size_t i = 0; i < size(); ++i) at(i).move(step_s, 0.0);  // the servo holds any load a joint can have here
}

void JointDrives::measure(const std::vector<double>& torque_Nm) {
  for (std::size_t i = 0; i < size(); ++i) {
    const double permille = 1000.0 * arm_.robot.drives[i].direction * torque_Nm[i] / arm_.robot.rated_torque_Nm;
    const double noise = noisy_ ? torque_noise_.gaussian(kTorqueNoise_permille) : 0.0;
    set_measured(i, permille * arm_.torque_gain[i] + noise);
  }
}

std::vector<double> JointDrives::joint_rad() const {
  std::vector<double> joint(size());
  for (std::size_t i = 0; i < size(); ++i) {
    const DriveConfig& table = arm_.robot.drives[i];
    const double counts = drive(i).motor().position_counts() - table.zero_counts;
    joint[i] = arm_.zero_offset_rad[i] + table.direction * counts * arm_.robot.rad_per_count();
  }
  return joint;
}

std::vector<double> JointDrives::rate_rad_s() const {
  std::vector<double> rate(size());
  for (std::size_t i = 0; i < size(); ++i) {
    rate[i] = arm_.robot.drives[i].direction * drive(i).motor().velocity_counts_per_s() * arm_.robot.rad_per_count();
  }
  return rate;
}

}  // namespace liana::bench
