// Whether the arm is where its drives say, and why not: homing is the comparison of stored zeros with the lengths
// found.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "firmware_like/cable_controller.hpp"
#include "host/control/realtime/link.hpp"
#include "host/control/server/arm_server.hpp"
#include "host/model/config/config.hpp"

namespace liana::server {

// Cable that a drive reports as paid out beyond its zero [m], and tension that it reports [N].
double paid_out_m(const cable::DriveParams& drive, const DriveFeedback& feedback);
double reported_tension_N(const cable::DriveParams& drive, const DriveFeedback& feedback);

// Cable that every drive reports as paid out beyond its zero [m].
cable::CableVector paid_out_m(const cable::RobotParams& table, const cable::Inputs& inputs);

// Tension that every drive reports [N].
cable::CableVector reported_tension_N(const cable::RobotParams& table, const cable::Inputs& inputs);

class Homing {
 public:
  // `in_pose`: the named pose in which the arm lies in its jig at the start; empty: nobody knows. Throws
  // std::runtime_error when there is no such pose, or when it does not tell every two cables apart.
  Homing(const config::RobotConfig& robot, const std::string& in_pose);

  // Joint angles at which the arm was left, of which a file told: until it is homed the drives are compared with them.
  void remember(std::span<const double> joint_rad);
  // Once per interval after booting. The pose is compared until it fits once: then the arm may leave it.
  void look(const realtime::ArmTickStatus<cable::CableArm>& report, const cable::EstimatorState& estimator);

  const NotHomed& not_homed() const { return not_homed_; }

 private:
  std::string lost_turns(const cable::CableVector& now_m) const;

  const config::RobotConfig& robot_;
  std::string in_pose_;                       // still to be found
  std::optional<cable::CableVector> left_m_;  // paid out beyond zero when it was homed last
  NotHomed not_homed_;
};

}  // namespace liana::server
