// The drives of a robot on their buses, and the faults that happen to a drive whatever it moves.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "hil/config/fault_config.hpp"
#include "hil/config/scene_config.hpp"
#include "hil/drive/drive.hpp"
#include "hil/math/random.hpp"

namespace liana::bench {

// What the table of a robot, of either kind, says of its drive i.
template <class Robot>
DriveSettings drive_settings(const Robot& robot, const BusesConfig& buses, std::size_t i) {
  DriveSettings settings;
  const AxisConfig place = buses.axis_of(i);
  settings.node = place.node;
  settings.axis = place.axis;
  settings.axes = buses.axes_of(place.node);
  settings.bus = place.bus;
  settings.dictionary = buses.dictionary_of(settings.node);
  settings.vendor = settings.dictionary.vendor.value_or(robot.vendor);
  settings.product = settings.dictionary.product.value_or(robot.product);
  settings.revision = settings.dictionary.revision.value_or(robot.revision);
  settings.serial = robot.drives[i].serial;
  settings.counts_per_turn = robot.counts_per_turn;
  settings.rated_torque_mNm = 1000.0 * robot.rated_torque_Nm / robot.gear;
  settings.gear = robot.gear;
  settings.fastest_counts_per_s = robot.fastest_counts_per_s;
  settings.servo_time_constant_s = robot.servo_time_constant_s;
  if constexpr (requires { robot.is_torque_controlled; }) {
    settings.is_torque_controlled = robot.is_torque_controlled;
  } else {
    settings.pull_direction = -robot.drives[i].direction;
    settings.holds_both_ways = i < robot.base_drives();
  }
  return settings;
}

class Drives {
 public:
  // `product` is what object 1018:2 of healthy drives says; `seed` draws the noise that faults bring.
  Drives(std::uint32_t product, std::uint64_t seed);
  Drives(const Drives&) = delete;
  Drives& operator=(const Drives&) = delete;
  virtual ~Drives() = default;

  // Gives the frames to the drives on their buses, then runs all timers.
  void exchange(const FrameList& frames, std::uint64_t now_us, FrameList& out);

  // A fault of this drive begins; end() takes back what can end (load_faults allows for_slots for no other). What
  // happens to a node happens to all its axes.
  void begin(const FaultConfig& fault, std::size_t drive);
  void end(const FaultConfig& fault, std::size_t drive);

  std::size_t size() const { return drives_.size(); }
  const Drive& drive(std::size_t i) const { return *drives_[i]; }
  // Drives in operation enabled.
  std::size_t enabled() const;

 protected:
  void add(const DriveSettings& settings, double start_counts);
  Drive& at(std::size_t i) { return *drives_[i]; }
  // What the torque sensor reads [permille], with the noise that a fault brings to it and to the position.
  void set_measured(std::size_t drive, double permille);

 private:
  void begin_at(const FaultConfig& fault, std::size_t drive);
  void end_at(const FaultConfig& fault, std::size_t drive);
  // The drives that a fault of drive i happens to.
  std::vector<std::size_t> affected(const FaultConfig& fault, std::size_t i) const;
  // The kinds that happen to what a drive moves.
  virtual void begin_behind(const FaultConfig& fault, std::size_t drive) = 0;
  virtual void end_behind(const FaultConfig& fault, std::size_t drive) = 0;

  // Standard deviations of sensor noise that a fault brings.
  struct SensorNoise {
    double counts = 0.0;
    double permille = 0.0;
  };

  std::uint32_t product_;
  std::vector<std::unique_ptr<Drive>> drives_;
  std::vector<SensorNoise> noise_;
  Random fault_noise_;
};

}  // namespace liana::bench
