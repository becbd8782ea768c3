#include "host/drives/calibration/load_model.hpp"

#include <cmath>

#include "firmware_like/cable/arm/static_load.hpp"

namespace liana::calibration {

using namespace cable;
namespace {

using Index = std::size_t;

constexpr double kReadingShare = 0.003;  // of a tension that was averaged, beside its gain
constexpr double kOwnNoise_Nm = 1e-6;    // where no cable pulls at all
constexpr const char* kGravity = "gravity_m_s2";

std::string of_segment(Index j, const char* field) { return "segments[" + std::to_string(j) + "]." + field; }
std::string of_axis(const char* field, Index axis) { return std::string(field) + "[" + std::to_string(axis) + "]"; }

}  // namespace

std::vector<LoadParameter> load_parameters(const RobotParams& table) {
  std::vector<LoadParameter> out;
  RobotParams copy = table;
  const auto add = [&](std::string field, double sd, double* (*slot)(RobotParams&, Index), Index index) {
    out.push_back({std::move(field), sd, *slot(copy, index), slot, index});
  };
  const double gravity = norm(table.gravity_m_s2);
  for (Index j = 0; j < static_cast<Index>(table.segment_count); ++j) {
    const SegmentParams& segment = table.segment[j];
    if (gravity > 0.0) {
      add(
          of_segment(j, "module_mass_kg"), kPriorMass * segment.module_mass_kg,
          [](RobotParams& t, Index i) { return &t.segment[i].module_mass_kg; }, j);
      add(
          of_segment(j, "module_center"), kPriorCenter_m / segment.module_length_m,
          [](RobotParams& t, Index i) { return &t.segment[i].module_center; }, j);
    }
    if (segment.joint_stiffness_Nm_rad > 0.0) {
      add(
          of_segment(j, "joint_stiffness_Nm_per_rad"), kPriorStiffness * segment.joint_stiffness_Nm_rad,
          [](RobotParams& t, Index i) { return &t.segment[i].joint_stiffness_Nm_rad; }, j);
    }
  }
  if (gravity > 0.0 && table.tool.mass_kg > 0.0) {
    add(
        "tool.mass_kg", kPriorMass * table.tool.mass_kg, [](RobotParams& t, Index) { return &t.tool.mass_kg; }, 0);
    for (Index axis = 0; axis < 3; ++axis)
      add(
          of_axis("tool.center_m", axis), kPriorCenter_m,
          [](RobotParams& t, Index i) { return &t.tool.center_in_tip_m[i]; }, axis);
  }
  for (Index axis = 0; gravity > 0.0 && axis < 3; ++axis)
    add(
        of_axis(kGravity, axis), kPriorGravity * gravity, [](RobotParams& t, Index i) { return &t.gravity_m_s2[i]; },
        axis);
  return out;
}

LoadEquations load_equations(const RobotParams& table, const std::vector<LoadParameter>& parameters,
                             const ThetaVector& theta_rad, const CableVector& tension_N) {
  const CableLayout layout = cable_layout(table);
  const ArmTrig trig = arm_trig(table, theta_rad);
  const ArmKinematics arm = forward_kinematics(table, trig);
  const CableGeometry geometry = cable_geometry(table, layout, trig);
  const auto thetas = static_cast<Index>(table.theta_count()), cables = static_cast<Index>(table.cable_count());
  const ThetaVector load_Nm = static_load_Nm(table, theta_rad, trig, arm);
  LoadEquations out{Eigen::VectorXd(eigen_index(thetas)), Eigen::VectorXd(eigen_index(thetas)),
                    Eigen::MatrixXd(eigen_index(thetas), eigen_index(parameters.size() + cables))};
  for (Index k = 0; k < thetas; ++k) {
    double given_Nm = 0.0, squares_Nm2 = 0.0;
    for (Index c = 0; c < cables; ++c) {
      const double torque_Nm = -geometry.jacobian_m_rad[c][k] * tension_N[c];  // a cable pulls its path shorter
      out.rows(eigen_index(k), eigen_index(parameters.size() + c)) = torque_Nm;
      given_Nm += torque_Nm;
      squares_Nm2 += torque_Nm * torque_Nm;
    }
    out.left_Nm(eigen_index(k)) = given_Nm - load_Nm[k];
    out.reading_Nm(eigen_index(k)) = kReadingShare * std::sqrt(squares_Nm2) + kOwnNoise_Nm;
  }
  for (Index p = 0; p < parameters.size(); ++p) {  // linear in each: a difference is the derivative
    RobotParams moved = table;
    *parameters[p].slot(moved, parameters[p].index) += parameters[p].prior_sd;
    const ThetaVector moved_Nm = static_load_Nm(moved, theta_rad, trig, arm);
    for (Index k = 0; k < thetas; ++k)
      out.rows(eigen_index(k), eigen_index(p)) = (load_Nm[k] - moved_Nm[k]) / parameters[p].prior_sd;
  }
  return out;
}

Eigen::VectorXd prior_sd(const std::vector<LoadParameter>& parameters, Index cables) {
  Eigen::VectorXd out = Eigen::VectorXd::Constant(eigen_index(parameters.size() + cables), kPriorTorqueGain);
  for (Index p = 0; p < parameters.size(); ++p) out(eigen_index(p)) = parameters[p].prior_sd;
  return out;
}

Eigen::VectorXd gravity_row(const RobotParams& table, const std::vector<LoadParameter>& parameters, Index cables) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(eigen_index(parameters.size() + cables));
  const double gravity2 = dot(table.gravity_m_s2, table.gravity_m_s2);
  for (Index p = 0; p < parameters.size(); ++p) {
    if (parameters[p].field.starts_with(kGravity))
      out(eigen_index(p)) = table.gravity_m_s2[parameters[p].index] / (gravity2 * kGravityAmount);
  }
  return out;
}

}  // namespace liana::calibration
