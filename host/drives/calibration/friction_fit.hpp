// Friction of the cables from what their drives report while the arm moves slowly: the balance of torques that the core
// watches, too (firmware_like/cable/arm/friction_estimator.hpp), fitted to a whole motion at once
// (docs/explanation/arm-control.md).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "firmware_like/cable/arm/body_inertia.hpp"
#include "firmware_like/cable/arm/friction.hpp"
#include "host/drives/calibration/calibration.hpp"

namespace liana::calibration {

class FrictionFit {
 public:
  // Of a checked table; its friction_mu is not used.
  explicit FrictionFit(const cable::RobotParams& table);

  // Every command interval of the motion, in order: where the arm is told to be and what its cables pull.
  void add(const cable::ThetaVector& commanded_rad, const cable::CableVector& tension_N, bool moving);

  // One mu for the whole arm, and one for each segment where that is known to a fifth. Throws std::runtime_error when
  // the arm has moved for less than 10 s.
  Friction solve() const;

 private:
  struct Sample {
    cable::ThetaVector theta_rad;
    cable::SlipState slip;
    std::uint32_t turning;            // bit j: segment j turns, cables slide in it
    cable::BodyInertiaState inertia;  // and the tensions, as late as its acceleration
  };
  struct Moment;
  struct Equation {
    double torque_Nm, variance_Nm2;
    Eigen::VectorXd row;
  };
  // Parameters: mu of each part of the arm, then what each torque gain is off by.
  struct Fit {
    std::size_t parts;
    Eigen::VectorXd value, variance;
    std::size_t part(std::size_t segment) const { return parts == 1 ? 0 : segment; }
  };

  Equation equation(const Moment& now, std::size_t axis, const Fit& fit) const;
  void improve(Fit& fit) const;
  Fit fit(std::size_t parts) const;
  static FrictionOf found(const Fit& fit, std::size_t part);

  cable::RobotParams table_;
  cable::CableLayout layout_;
  cable::CableGeometry geometry_{};
  cable::SlipState slip_{};
  cable::BodyInertiaState inertia_{};
  cable::ThetaVector before_rad_{};
  bool begun_ = false;
  std::size_t moved_ = 0;  // intervals
  std::vector<Sample> samples_;
};

}  // namespace liana::calibration
