#include "host/drives/calibration/load_model.hpp"

#include <cmath>

#include "firmware_like/cable/arm/static_load.hpp"
#include "host/drives/calibration/prior_fit.hpp"

namespace liana::calibration {

using namespace cable;
namespace {

using Index = std::size_t;

constexpr double kReadingShare = 0.003;  // of a tension that was averaged, beside its gain
constexpr double kOwnNoise_Nm = 1e-6;    // where no cable pulls at all
constexpr const char* kGravity = "gravity_m_s2";

}  // namespace

LoadEquations load_equations(const RobotParams& table, const std::vector<TableField>& fields,
                             const ThetaVector& theta_rad, const CableVector& tension_N) {
  const CableLayout layout = cable_layout(table);
  const ArmTrig trig = arm_trig(table, theta_rad);
  const ArmKinematics arm = forward_kinematics(table, trig);
  const CableGeometry geometry = cable_geometry(table, layout, trig);
  const auto thetas = static_cast<Index>(table.theta_count()), cables = static_cast<Index>(table.cable_count());
  const ThetaVector load_Nm = static_load_Nm(table, theta_rad, trig, arm);
  LoadEquations out{Eigen::VectorXd(eigen_index(thetas)), Eigen::VectorXd(eigen_index(thetas)),
                    Eigen::MatrixXd(eigen_index(thetas), eigen_index(fields.size() + cables))};
  for (Index k = 0; k < thetas; ++k) {
    double given_Nm = 0.0, squares_Nm2 = 0.0;
    for (Index c = 0; c < cables; ++c) {
      const double torque_Nm = -geometry.jacobian_m_rad[c][k] * tension_N[c];  // a cable pulls its path shorter
      out.rows(eigen_index(k), eigen_index(fields.size() + c)) = torque_Nm;
      given_Nm += torque_Nm;
      squares_Nm2 += torque_Nm * torque_Nm;
    }
    out.left_Nm(eigen_index(k)) = given_Nm - load_Nm[k];
    out.reading_Nm(eigen_index(k)) = kReadingShare * std::sqrt(squares_Nm2) + kOwnNoise_Nm;
  }
  for (Index p = 0; p < fields.size(); ++p) {  // linear in each: a difference is the derivative
    RobotParams moved = table;
    *fields[p].slot(moved, fields[p].index) += fields[p].known_sd;
    const ThetaVector moved_Nm = static_load_Nm(moved, theta_rad, trig, arm);
    for (Index k = 0; k < thetas; ++k)
      out.rows(eigen_index(k), eigen_index(p)) = (load_Nm[k] - moved_Nm[k]) / fields[p].known_sd;
  }
  return out;
}

Eigen::VectorXd prior_sd(const std::vector<TableField>& fields, Index cables) {
  Eigen::VectorXd out = Eigen::VectorXd::Constant(eigen_index(fields.size() + cables), kPriorTorqueGain);
  for (Index p = 0; p < fields.size(); ++p) out(eigen_index(p)) = fields[p].known_sd;
  return out;
}

Eigen::VectorXd gravity_row(const RobotParams& table, const std::vector<TableField>& fields, Index cables) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(eigen_index(fields.size() + cables));
  const double gravity2 = dot(table.gravity_m_s2, table.gravity_m_s2);
  for (Index p = 0; p < fields.size(); ++p) {
    if (fields[p].field.starts_with(kGravity))
      out(eigen_index(p)) = table.gravity_m_s2[fields[p].index] / (gravity2 * kGravityAmount);
  }
  return out;
}

}  // namespace liana::calibration
