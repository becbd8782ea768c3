// The fifteen drives and what joins them to the arm: counts to cable, tension to torque reading.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "hil/arm/true_parameters.hpp"
#include "hil/config/fault_config.hpp"
#include "hil/config/scene_config.hpp"
#include "hil/drive/drive.hpp"
#include "hil/math/random.hpp"

namespace liana::bench {

class DriveBank {
 public:
  // Drums hold `payout_m`; brakes on. `cross_wired`: empty, or two drives that have each other's cable.
  DriveBank(const RobotConfig& robot, const BusesConfig& buses, const TrueParameters& truth,
            const CableValues& payout_m, bool noisy, std::uint64_t seed,
            const std::vector<std::size_t>& cross_wired = {});

  // Gives the frames to the drives on their buses, then runs all timers.
  void exchange(const FrameList& frames, std::uint64_t now_us, FrameList& out);
  // Moves all motors by one physics step under the given motor-side tensions.
  void move(double step_s, const CableValues& tension_N);
  // Reads all torque sensors (once per slot).
  void measure(const CableValues& tension_N);
  // Unstretched cable the drums have paid out now [m].
  CableValues payouts_m() const;

  // A fault of this drive begins; end() takes back what can end (load_faults allows for_slots for no other).
  void begin(const FaultConfig& fault, std::size_t drive);
  void end(const FaultConfig& fault, std::size_t drive);

  std::size_t size() const { return drives_.size(); }
  const Drive& drive(std::size_t i) const { return *drives_[i]; }
  // Drives in operation enabled.
  std::size_t enabled() const;

 private:
  // Standard deviations of sensor noise that a fault brings.
  struct SensorNoise {
    double counts = 0.0;
    double permille = 0.0;
  };

  // A cable on its way off its drum.
  struct Creep {
    double per_slot_m = 0.0;
    int slots_left = 0;
  };

  void creep();
  double permille(double tension_N) const;

  RobotConfig robot_;
  TrueParameters truth_;
  std::vector<std::unique_ptr<Drive>> drives_;
  std::vector<double> path_at_zero_m_;
  std::vector<std::size_t> cable_of_;  // on each drive's drum
  std::vector<Creep> creep_;
  CableValues loose_m_{};  // cable that faults paid out beside the drum
  std::vector<SensorNoise> noise_;
  bool noisy_;
  Random torque_noise_;
  Random fault_noise_;
};

}  // namespace liana::bench
