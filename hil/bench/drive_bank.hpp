// The drives and what joins them to the arm: counts to cable, tension to torque reading.
#pragma once

#include <cstdint>
#include <vector>

#include "hil/arm/true_parameters.hpp"
#include "hil/bench/drives.hpp"
#include "hil/config/scene_config.hpp"

namespace liana::bench {

class DriveBank final : public Drives {
 public:
  // Drums hold `payout_m`, one a drive (Arm::payouts_m); brakes on. `cross_wired`: empty, or two drives that have each
  // other's cable.
  DriveBank(const RobotConfig& robot, const BusesConfig& buses, const TrueParameters& truth,
            const CableValues& payout_m, bool noisy, std::uint64_t seed,
            const std::vector<std::size_t>& cross_wired = {});

  // As Drives::exchange, once per slot: cables that come off their drum go on doing so.
  void exchange(const FrameList& frames, std::uint64_t now_us, FrameList& out);
  // Moves all motors by one physics step under the given motor-side tensions.
  void move(double step_s, const CableValues& tension_N);
  // Reads all torque sensors (once per slot).
  void measure(const CableValues& tension_N);
  // Unstretched cable the drums have paid out now, and where the drives of a base stand [m].
  CableValues payouts_m() const;

 private:
  // A cable on its way off its drum.
  struct Creep {
    double per_slot_m = 0.0;
    int slots_left = 0;
  };

  void begin_behind(const FaultConfig& fault, std::size_t drive) override;
  void end_behind(const FaultConfig& fault, std::size_t drive) override;
  int slots_to_take_up(std::size_t drive) const;
  void creep();
  double permille(double tension_N) const;

  RobotConfig robot_;
  TrueParameters truth_;
  std::vector<double> path_at_zero_m_;
  std::vector<std::size_t> cable_of_;  // on each drive's drum, counted as the drives
  std::vector<Creep> creep_;
  CableValues loose_m_{};  // cable that faults paid out beside the drum
  bool noisy_;
  Random torque_noise_;
};

}  // namespace liana::bench
