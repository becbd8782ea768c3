#include "hil/serial/torque_drives.hpp"

#include "hil/serial/joint_drives.hpp"

namespace liana::bench {

TorqueDrives::TorqueDrives(const TrueArm& arm, const BusesConfig& buses, bool noisy, std::uint64_t seed)
    : Drives(arm.robot.product, seed), arm_(arm), noisy_(noisy), torque_noise_(seed, "torque noise") {
  for (std::size_t i = 0; i < arm.robot.joints.size(); ++i)
    add(drive_settings(arm.robot, buses, i), counts_of(i, arm.start_rad[i]));
}

double TorqueDrives::counts_of(std::size_t i, double rotor_rad) const {
  return arm_.robot.drives[i].zero_counts +
         sign(i) * (rotor_rad - arm_.zero_offset_rad[i]) / arm_.robot.rad_per_count();
}

double TorqueDrives::rad_of(std::size_t i, double counts) const {
  return arm_.zero_offset_rad[i] + sign(i) * (counts - arm_.robot.drives[i].zero_counts) * arm_.robot.rad_per_count();
}

void TorqueDrives::act(const FlexibleChain& arm, std::vector<RotorDrive>& out) {
  for (std::size_t i = 0; i < size(); ++i) {
    if (at(i).is_torque_controlled()) {
      const double rate_counts_s = sign(i) * arm.rotor_rate_rad_s(i) / arm_.robot.rad_per_count();
      const double felt_Nm = arm_.torque_gain[i] * sign(i) * arm.gear_Nm(i);
      out[i] = {true, sign(i) * at(i).torque_Nm(kLoop_s, felt_Nm, counts_of(i, arm.rotor_rad(i)), rate_counts_s), 0.0};
      continue;
    }
    at(i).move(kLoop_s, 0.0);  // servo and brake hold any load a joint can have here
    out[i] = {false, 0.0, (rad_of(i, drive(i).motor().position_counts()) - arm.rotor_rad(i)) / kLoop_s};
  }
}

void TorqueDrives::measure(const FlexibleChain& arm) {
  for (std::size_t i = 0; i < size(); ++i) {
    at(i).carry(counts_of(i, arm.rotor_rad(i)), sign(i) * arm.rotor_rate_rad_s(i) / arm_.robot.rad_per_count());
    const double permille = 1000.0 * sign(i) * arm.gear_Nm(i) / arm_.robot.rated_torque_Nm;
    const double noise = noisy_ ? torque_noise_.gaussian(kTorqueNoise_permille) : 0.0;
    set_measured(i, permille * arm_.torque_gain[i] + noise);
  }
}

}  // namespace liana::bench
