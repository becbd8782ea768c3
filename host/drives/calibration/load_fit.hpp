// What an arm weighs and how its springs pull, from tensions and angles measured at rest in a dozen poses
// (load_poses.hpp): least squares on the balance of torques (load_model.hpp), with what the table says and how far it
// may be off as a first measurement, and the torque gain of every drive as a number more (docs/how-to/calibrate.md).
#pragma once

#include <array>
#include <vector>

#include "host/drives/calibration/load_model.hpp"
#include "host/drives/calibration/load_poses.hpp"
#include "host/drives/calibration/prior_fit.hpp"

namespace liana::calibration {

// The arm at rest: measured angles, and mean tensions at the motors.
struct LoadReading {
  cable::ThetaVector theta_rad{};
  cable::CableVector tension_N{};
};

// Root mean squares over poses: of torque about the angles that cables give and the load does not explain, and of the
// least tensions that give it.
struct LoadError {
  double torque_Nm = 0.0;
  double tension_N = 0.0;
};

struct LoadResult : FieldsFound {
  LoadError before, after;
  LoadError with_gains;  // after, the drives' torque gains corrected as they were found, too
};

class LoadFit {
 public:
  // `table`: checked, as it was before.
  explicit LoadFit(const cable::RobotParams& table);

  // One pose, come to from its two sides: the mean is used, and half the difference says what friction takes.
  void add(const std::array<LoadReading, 2>& sides);

  // Throws std::runtime_error when there is no load to find, or when there are fewer than kMinLoadPoses.
  LoadResult solve() const;

 private:
  LoadEquations equations(const std::array<LoadReading, 2>& sides, const cable::RobotParams& table) const;
  PriorFit sum(const cable::RobotParams& table, const Eigen::VectorXd& value) const;
  LoadError error(const cable::RobotParams& table, const Eigen::VectorXd& gain) const;

  cable::RobotParams table_;
  std::vector<TableField> fields_;
  Eigen::VectorXd prior_;
  std::vector<std::array<LoadReading, 2>> poses_;
};

}  // namespace liana::calibration
