// The bench's dynamics of a serial arm that is pushed against: rotors before elastic gears, friction, a payload at the
// tip, and the locked joints of the arm that carries it, if any, as springs (docs/explanation/payload.md). In orbit: no
// gravity. States and loads of tip and base are in the frame of the root: the base of the arm that carries, or this
// arm's own.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "hil/config/serial_config.hpp"
#include "hil/math/reduced.hpp"
#include "hil/math/vec3.hpp"
#include "hil/serial/coulomb_friction.hpp"
#include "hil/serial/tip_state.hpp"

namespace liana::bench {

// What its motor does with one joint.
struct RotorDrive {
  bool is_torque_controlled = false;  // false: the rotor turns at the given rate whatever is behind it; 0 is a brake
  double torque_Nm = 0.0;             // at the joint
  double rate_rad_s = 0.0;
};

class FlexibleChain {
 public:
  static constexpr double kStep_s = 0.00025;
  using Contact = std::function<TipLoad(const TipState&)>;

  // At rest at the joint angles, no spring wound. `payload` is fixed to the tip, in its frame; without mass: none.
  // Throws std::runtime_error when the table has no stiffness for its joints, or MuJoCo refuses the model.
  FlexibleChain(const SerialRobotConfig& robot, const std::vector<double>& joint_rad, const BodyConfig& payload = {});
  ~FlexibleChain();
  FlexibleChain(const FlexibleChain&) = delete;
  FlexibleChain& operator=(const FlexibleChain&) = delete;

  // From now on this is fixed to the tip instead, in its frame; without mass: nothing. The arm goes on as it moves, and
  // the payload with it. Throws std::runtime_error when MuJoCo refuses the model.
  void carry(const BodyConfig& payload);

  // The springs of the arm that carries want its joints at these angles from now on.
  void lead_base(const std::vector<double>& joint_rad) { base_told_rad_ = joint_rad; }
  // Where this arm's base is when they are there, without load.
  Pose base_when_at(const std::vector<double>& joint_rad) const;

  // One step, by the implicit midpoint rule for springs, their damping and friction: stable however stiff they are, and
  // without energy of its own. `contact` is asked once, in the middle of the step. Cost: about 6 us with a base.
  void step(double step_s, const std::vector<RotorDrive>& drives, const Contact& contact);

  std::size_t joints() const { return rotors_.size(); }
  double joint_rad(std::size_t i) const;
  double joint_rate_rad_s(std::size_t i) const { return rate_[base_joints_ + i]; }
  double rotor_rad(std::size_t i) const { return rotors_[i].angle_rad; }
  double rotor_rate_rad_s(std::size_t i) const { return rotors_[i].rate_rad_s; }
  // What the gear gives to the link: the reading of a joint torque sensor.
  double gear_Nm(std::size_t i) const;
  TipState tip() const;
  std::vector<Vec3> axis_m() const;  // of this arm's links (link_axis.hpp), in the root's frame
  TipState base() const;             // of this arm; at rest in the root's frame where nothing carries it
  // What the payload does to the end effector, about the tip's origin, in the tip's frame: the reading of a force
  // sensor at the wrist. Its own inertia is in it, averaged over the last step.
  TipLoad wrist() const { return wrist_; }
  // Of motion and all springs.
  double energy_J() const;

 private:
  struct Engine;
  struct Rotor {
    double angle_rad = 0.0;
    double rate_rad_s = 0.0;
  };
  // The linear equations of one step, for the changes of the hinges' rates.
  struct Equations {
    ThetaMatrix matrix{};
    Theta right{};
  };

  void place(const Theta& angle_rad, const Theta& rate_rad_s) const;
  TipState state_of(int body) const;
  Equations free_motion(double step_s, const Contact& contact);
  void add_spring(std::size_t hinge, double stiffness, double damping, double wound_rad, double step_s,
                  Equations& equations) const;
  struct Gear {
    double given;
    double coupling;
  };
  Gear gear(std::size_t i, double step_s) const;
  void add_gear(std::size_t i, const RotorDrive& drive, double step_s, Equations& equations) const;
  void add_friction(std::size_t i, double step_s, Equations& equations) const;
  void turn_rotor(std::size_t i, const RotorDrive& drive, double step_s, double hinge_change_rad_s);
  // Of the payload: velocity of its centre, spin about it, and where the centre is from the tip.
  struct Momentum {
    Vec3 velocity_m_s;
    Vec3 spin;
    Vec3 arm_m;
  };
  Momentum payload_momentum() const;
  void feel_wrist(double step_s);
  double wound_rad(std::size_t i) const { return rotors_[i].angle_rad - joint_rad(i); }

  SerialRobotConfig robot_;
  std::unique_ptr<Engine> engine_;
  std::vector<double> base_told_rad_;  // of the joints of the arm that carries
  std::size_t base_joints_ = 0;
  std::size_t hinges_ = 0;
  Theta offset_rad_{};  // of the tables' angles
  Theta angle_{};       // of the hinges, base first, as the tables have them
  Theta rate_{};
  Theta accel_{};  // of the last step
  std::vector<Rotor> rotors_;
  std::vector<CoulombFriction> friction_;
  TipLoad pushed_;    // in the last step
  Momentum payload_;  // after the last step
  TipLoad wrist_;
};

}  // namespace liana::bench
