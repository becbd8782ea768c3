// What an arm weighs and how its springs pull, as numbers that measured tensions and angles can correct: the balance of
// torques - sum_c J_ck rho_cj t_c = Q_k (firmware_like/cable/arm/static_load.hpp) is linear in each of them.
//
// Sources: identification by least squares on a model that is linear in masses and first moments, Atkeson, An and
// Hollerbach 1986 (doi 10.1177/027836498600500306); what a motion cannot tell apart, by the singular values of the
// regressor, Gautier 1991 (doi 10.1002/rob.4620080405).
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "host/model/config/config.hpp"

namespace liana::calibration {

// How far a table may be off, one standard deviation; a value further from it than kPlausibleDeviations of them is
// refused. Assumed: the bench draws half of them at most (docs/explanation/arm-control.md).
constexpr double kPriorMass = 0.1;         // of the table's
constexpr double kPriorCenter_m = 0.01;    // along a module; of the tool in each axis
constexpr double kPriorStiffness = 0.2;    // of the table's
constexpr double kPriorGravity = 0.035;    // of its amount, in each axis: 2 degrees
constexpr double kGravityAmount = 0.001;   // share by which the amount differs between places, and by no more
constexpr double kPriorTorqueGain = 0.01;  // of each drive's reading
constexpr double kPlausibleDeviations = 3.0;

// One number of the robot table.
struct LoadParameter {
  std::string field;      // as the robot table's page names it, of one segment
  double prior_sd = 0.0;  // > 0
  double table_value = 0.0;
  double* (*slot)(cable::RobotParams&, std::size_t index) = nullptr;
  std::size_t index = 0;  // of segment or axis
};

inline Eigen::Index eigen_index(std::size_t i) { return static_cast<Eigen::Index>(i); }

// What there is to find: with gravity mass and center of each segment's modules and of the tool, and gravity's
// direction; joint stiffness where the table has one. Empty for an arm without weight and springs.
std::vector<LoadParameter> load_parameters(const cable::RobotParams& table);

// Torques about every theta in one pose: what the cables give less what the load takes, and how it changes with
// parameters, then with torque gains of the drives.
struct LoadEquations {
  Eigen::VectorXd left_Nm;     // by theta
  Eigen::VectorXd reading_Nm;  // what the readings of tension may be off by, one standard deviation
  Eigen::MatrixXd rows;        // theta x (parameters + cables)
};

// Nothing having slipped. `table` has the parameters' present values. Cost: two static loads a parameter.
LoadEquations load_equations(const cable::RobotParams& table, const std::vector<LoadParameter>& parameters,
                             const cable::ThetaVector& theta_rad, const cable::CableVector& tension_N);

// Standard deviations of parameters, then of torque gains, before anything is measured.
Eigen::VectorXd prior_sd(const std::vector<LoadParameter>& parameters, std::size_t cables);

// The amount of gravity is known: one row more, in units of its standard deviation, over parameters and cables. Zero
// without gravity.
Eigen::VectorXd gravity_row(const cable::RobotParams& table, const std::vector<LoadParameter>& parameters,
                            std::size_t cables);

}  // namespace liana::calibration
