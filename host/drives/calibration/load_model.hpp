// What an arm weighs and how its springs pull, as numbers that measured tensions and angles can correct: the balance of
// torques - sum_c J_ck rho_cj t_c = Q_k (firmware_like/cable/arm/static_load.hpp) is linear in each of them.
//
// Sources: identification by least squares on a model that is linear in masses and first moments, Atkeson, An and
// Hollerbach 1986 (doi 10.1177/027836498600500306).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "firmware_like/cable/arm/robot_params.hpp"
#include "host/drives/calibration/table_fields.hpp"

namespace liana::calibration {

constexpr double kGravityAmount = 0.001;   // share by which the amount differs between places, and by no more
constexpr double kPriorTorqueGain = 0.01;  // of each drive's reading

// Torques about every theta in one pose: what the cables give less what the load takes, and how it changes with
// fields, then with torque gains of the drives.
struct LoadEquations {
  Eigen::VectorXd left_Nm;     // by theta
  Eigen::VectorXd reading_Nm;  // what the readings of tension may be off by, one standard deviation
  Eigen::MatrixXd rows;        // theta x (fields + cables)
};

// Nothing having slipped. `table` has the fields' present values. Cost: two static loads a field.
LoadEquations load_equations(const cable::RobotParams& table, const std::vector<TableField>& fields,
                             const cable::ThetaVector& theta_rad, const cable::CableVector& tension_N);

// Standard deviations of fields, then of torque gains, before anything is measured.
Eigen::VectorXd prior_sd(const std::vector<TableField>& fields, std::size_t cables);

// The amount of gravity is known: one row more, in units of its standard deviation, over fields and cables. Zero
// without gravity.
Eigen::VectorXd gravity_row(const cable::RobotParams& table, const std::vector<TableField>& fields, std::size_t cables);

}  // namespace liana::calibration
