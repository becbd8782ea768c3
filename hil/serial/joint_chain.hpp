// The serial arm as hinges in MuJoCo: where its tip is, and what torque a motion takes.
#pragma once

#include <memory>
#include <vector>

#include "hil/config/serial_config.hpp"
#include "hil/math/vec3.hpp"

namespace liana::bench {

class JointChain {
 public:
  // Throws std::runtime_error when MuJoCo refuses the model.
  explicit JointChain(const SerialRobotConfig& robot);
  ~JointChain();
  JointChain(const JointChain&) = delete;
  JointChain& operator=(const JointChain&) = delete;

  // Turns the joints; tip() refers to these angles.
  void place(const std::vector<double>& joint_rad);
  Pose tip() const;
  std::vector<Vec3> axis_m() const;  // of its links (link_axis.hpp)
  // Joint torques [N.m] of a motion at the present angles, without friction; rotors are included. In orbit: no gravity.
  std::vector<double> torque_Nm(const std::vector<double>& rate_rad_s, const std::vector<double>& accel_rad_s2);

 private:
  struct Engine;
  SerialRobotConfig robot_;
  std::unique_ptr<Engine> engine_;
  std::vector<double> offset_rad_;
};

}  // namespace liana::bench
