// The drives of a serial arm that give torque: counts to rotors, their torque loops once a millisecond, joint torque
// sensors to torque readings.
#pragma once

#include <cstdint>
#include <vector>

#include "hil/bench/drives.hpp"
#include "hil/config/scene_config.hpp"
#include "hil/serial/flexible_chain.hpp"
#include "hil/serial/true_arm.hpp"

namespace liana::bench {

class TorqueDrives final : public Drives {
 public:
  static constexpr double kLoop_s = 0.001;  // period of the torque loops

  // Rotors stand at the true arm's start; brakes on.
  TorqueDrives(const TrueArm& arm, const BusesConfig& buses, bool noisy, std::uint64_t seed);

  // What each motor does with its joint for the next kLoop_s: torque, or a rate that takes the rotor where the position
  // servo or the brake has it. `out` has one entry per joint.
  void act(const FlexibleChain& arm, std::vector<RotorDrive>& out);
  // Reads encoders and torque sensors (once per slot).
  void measure(const FlexibleChain& arm);

 private:
  void begin_behind(const FaultConfig&, std::size_t) override {}  // PayloadPlant takes no fault that needs a cable
  void end_behind(const FaultConfig&, std::size_t) override {}
  double counts_of(std::size_t i, double rotor_rad) const;
  double rad_of(std::size_t i, double counts) const;
  int sign(std::size_t i) const { return arm_.robot.drives[i].direction; }

  TrueArm arm_;
  bool noisy_;
  Random torque_noise_;
};

}  // namespace liana::bench
