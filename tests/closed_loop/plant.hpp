// The bench's arm behind servo motors, without bus and drive state machines. Hides the bench's headers: plant.cpp alone
// includes them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "firmware_like/cable/arm/robot_params.hpp"
#include "firmware_like/math/pose.hpp"

namespace liana::closed_loop {

// Which arm the core meets.
struct PlantSetup {
  std::string physics = "nominal";  // friction: nominal, ideal or worn
  std::uint64_t seed = 1;           // of the spread and of the torque noise
  bool spread = true;  // true parameters and start pose differ from the table (mission, A9); false: exactly the
                       // table, no noise
  std::string start_pose = "prepare";
  std::string robot_file{};                         // of the bench; empty: the arm of all tests, in its scene
  std::optional<Vec3> mounted_m_s2 = std::nullopt;  // gravity in the base frame in place of the table's
  double geometry_share = 0.0;  // by which module lengths and hole radius of the built arm differ at most, by seed;
                                // the drives' zeros are then those of a jig at the zero pose
  cable::CableVector zero_m{};  // that each cable was found longer than its drive says
};

// Extremes since the last take_load().
struct Load {
  double contact_N = 0.0;
  double least_N = 0.0;      // anywhere along any cable
  double min_motor_N = 0.0;  // at the motor
  double max_motor_N = 0.0;
};

class Plant {
 public:
  // Arm at rest with balanced tensions; throws std::runtime_error when the setup names something unknown.
  explicit Plant(const PlantSetup& setup);
  ~Plant();
  Plant(const Plant&) = delete;
  Plant& operator=(const Plant&) = delete;

  // What the drives measure: unstretched length [m] by their stored zero, and tension [N] with gain error and noise.
  cable::CableVector measured_payout_m() const;
  cable::CableVector measured_tension_N();
  // One control period. Motors follow `target_m` (in measured lengths) with the servo's lag, or stand when `powered` is
  // false.
  void advance(double tick_s, const cable::CableVector& target_m, bool powered);

  // The truth, which the core never sees.
  const cable::ThetaVector& theta_rad() const;
  const cable::ThetaVector& rate_rad_s() const;
  double friction_mu() const;
  double module_length_m(std::size_t segment) const;
  Pose tip_in_base() const;
  double kinetic_energy_J();
  double slit_clearance_m() const;
  double sphere_clearance_m() const;
  Load take_load();

  // Faults of a cable. So much of it comes off the drum; the encoder reads so much more; the tension reading scatters
  // by so much, is 0.
  void loosen(std::size_t cable, double length_m);
  void jump_encoder(std::size_t cable, double length_m);
  void scatter(std::size_t cable, double deviation_N);
  void lose_reading(std::size_t cable);
  void find_reading(std::size_t cable);  // again what it is
  void stand_still(std::size_t cable);   // its brake has closed for good

  // Something pushes the start of a link's axis from now on, base frame; the link after the last is the tip.
  void push(std::size_t link, const Vec3& force_N);

  // Rates set from outside, angles and cables as they are: a kick.
  void kick(const cable::ThetaVector& rate_rad_s);
  // Joint damping set from outside, to let an arm without friction come to rest.
  void set_joint_damping(double viscous_Nms_per_rad);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace liana::closed_loop
