// Cables of the simulation: how their lengths change with the angles, how stiffly they hold them, how tight they are.
#pragma once

#include <Eigen/Core>

#include "host/base/eigen/thetas.hpp"
#include "host/model/simulation/arm_model.hpp"

namespace liana::simulation {

// A number per cable, and a row per cable with a column per theta.
using CableColumn = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxCables, 1>;
using CableMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxCables, kMaxTheta>;

// The cables at one pose: straight from hole to hole across every joint, straight inside the links (mission, A3).
struct CablePaths {
  CableMatrix jacobian_m_rad;     // d path / d theta; zero beyond a cable's own segment
  CableColumn stiffness_N_per_m;  // EA over the free length, drum to anchor
  CableColumn wrap_rad;           // change of direction at all holes together: what capstan friction goes by
  Eigen::Index feed_count = 0;    // rows that are drives of a base that feeds: their tension is of no account
  CableMatrix wrap_to_rad;        // the same, from the drum to the middle of the segment of each theta
};
CablePaths cable_paths(const ArmModel& model, const ThetaVector& theta_rad);

// Tensions [N] that give `load_Nm` about each theta, J^T t = -load, none below `floor_N`: nearest to `wanted_N`, by
// turns projected on balance and raised to the floor, which drives of a base that feeds need not keep. They are
// balanced to rounding; the floor is kept where 50 turns reach it.
CableColumn balanced_tensions(const CablePaths& paths, const CableColumn& wanted_N, double floor_N,
                              const eigen::ThetaColumn& load_Nm);
inline CableColumn balanced_tensions(const CablePaths& paths, const CableColumn& wanted_N, double floor_N) {
  return balanced_tensions(paths, wanted_N, floor_N, eigen::ThetaColumn::Zero(paths.jacobian_m_rad.cols()));
}

// Most that friction may turn every angle by [N m]: what cables of these tensions would hold at one end of the band
// more than at its middle, all the same way.
eigen::ThetaColumn friction_torque(const ArmModel& model, const CablePaths& paths, const CableColumn& tension_N);

}  // namespace liana::simulation
