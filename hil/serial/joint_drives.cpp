#include "hil/serial/joint_drives.hpp"

namespace liana::bench {

JointDrives::JointDrives(const TrueArm& arm, const BusesConfig& buses, bool noisy, std::uint64_t seed)
    : Drives(arm.robot.product, seed), arm_(arm), noisy_(noisy), torque_noise_(seed, "torque noise") {
  for (std::size_t i = 0; i < arm.robot.joints.size(); ++i) {
    const DriveConfig& drive = arm.robot.drives[i];
    const double turned = (arm.start_rad[i] - arm.zero_offset_rad[i]) / arm.robot.rad_per_count();
    add(drive_settings(arm.robot, buses, i), drive.zero_counts + drive.direction * turned);
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
