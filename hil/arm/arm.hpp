// What the bench needs of an arm, whichever model plays it.
#pragma once

#include <cstdint>
#include <vector>

#include "hil/arm/clearance.hpp"
#include "hil/arm/push.hpp"
#include "hil/math/reduced.hpp"
#include "hil/math/vec3.hpp"

namespace liana::bench {

constexpr double kJointStop_Nm_per_rad =
    500.0;  // all joints of a segment together; stiff against the cables' 1 to 100 N.m/rad

// Extremes since the last take_record(); tensions are those of cables.
struct LoadRecord {
  double contact_N = 0.0;
  double rod_N = 0.0;
  double least_tension_N = 1e9;
  double min_motor_tension_N = 1e9;
  double max_motor_tension_N = 0.0;
};

// How hard a model had to work, since its construction; zeros where a model has no such thing.
struct ArmCounts {
  std::uint64_t mujoco_warnings = 0;
  std::uint64_t contact_slots = 0;  // slots in which collision detection ran
  int max_sweeps = 0;               // of the friction solver, in one step
};

class Arm {
 public:
  Arm() = default;
  Arm(const Arm&) = delete;
  Arm& operator=(const Arm&) = delete;
  Arm(Arm&&) = default;
  Arm& operator=(Arm&&) = default;
  virtual ~Arm() = default;

  // What each drive now holds [m]: of a base's slide and roll first (base_drives.hpp), then of each cable the
  // unstretched length between drum and anchor.
  virtual CableValues payouts_m() const = 0;
  // Call before a run of steps that together last `duration_s`.
  virtual void begin_slot(double duration_s) = 0;
  // One step of at most longest_step_s() with the drives at `payout_m`, in the same order.
  virtual void step(double step_s, const CableValues& payout_m) = 0;
  virtual double longest_step_s() const = 0;

  virtual const Theta& theta_rad() const = 0;
  virtual const Theta& rate_rad_s() const = 0;
  // At the drum's radius; of slide and roll the force, of either sign.
  virtual double motor_tension_N(std::size_t drive) const = 0;
  virtual Pose tip() const = 0;
  // The press rod is gone from now on.
  virtual void remove_rod() = 0;
  // What pushes the arm from now on; nothing of it is in the record.
  virtual void set_pushes(const std::vector<Push>& pushes) = 0;
  // Whether something holds the slide or roll that `drive` moves, from now on, where it stands now; of models that feel
  // forces of a base.
  virtual void set_jammed(std::size_t drive, bool jammed) = 0;
  // 1000 m where the model knows no scene.
  virtual Clearance clearance() const = 0;
  virtual LoadRecord take_record() = 0;
  virtual ArmCounts counts() const = 0;
};

}  // namespace liana::bench
