// The drives of a serial arm: counts to joint angles, joint torque to torque reading.
#pragma once

#include <cstdint>
#include <vector>

#include "hil/bench/drives.hpp"
#include "hil/serial/true_arm.hpp"

namespace liana::bench {

constexpr double kTorqueNoise_permille = 1.0;  // standard deviation of a reading of torque

class JointDrives final : public Drives {
 public:
  // Joints stand at the true arm's start; brakes on.
  JointDrives(const TrueArm& arm, const BusesConfig& buses, bool noisy, std::uint64_t seed);

  // Moves all motors by one physics step.
  void move(double step_s);
  // Reads all torque sensors (once per slot).
  void measure(const std::vector<double>& torque_Nm);
  // True joint angles and rates; gears are stiff.
  std::vector<double> joint_rad() const;
  std::vector<double> rate_rad_s() const;

 private:
  void begin_behind(const FaultConfig&, std::size_t) override {}  // SerialPlant takes no fault that needs a cable
  void end_behind(const FaultConfig&, std::size_t) override {}

  TrueArm arm_;
  bool noisy_;
  Random torque_noise_;
};

}  // namespace liana::bench
