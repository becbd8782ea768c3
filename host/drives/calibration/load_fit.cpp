#include "host/drives/calibration/load_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "firmware_like/cable/arm/tension.hpp"
#include "host/drives/calibration/text.hpp"

namespace liana::calibration {

using namespace cable;
namespace {

using Index = std::size_t;

constexpr int kLoadSteps = 4;           // of Gauss-Newton: mass times gravity is all that is not linear
constexpr double kFrictionLeft = 0.15;  // of half the difference of both sides, in their mean
constexpr double kTakesPart = 0.3;      // of a direction's length

double root_mean(double sum, double count) { return std::sqrt(sum / count); }

}  // namespace

// Normal equations, all columns in units of what is known before.
struct LoadFit::Sum {
  Eigen::MatrixXd normal;
  Eigen::VectorXd right;
  double chi2 = 0.0;  // of the equations
  double count = 0.0;
};

LoadFit::LoadFit(const RobotParams& table)
    : table_(table),
      parameters_(load_parameters(table)),
      prior_(prior_sd(parameters_, static_cast<Index>(table.cable_count()))) {}

void LoadFit::add(const std::array<LoadReading, 2>& sides) { poses_.push_back(sides); }

// The mean of both sides, and in its noise what friction leaves.
LoadEquations LoadFit::equations(const std::array<LoadReading, 2>& sides, const RobotParams& table) const {
  LoadEquations a = load_equations(table, parameters_, sides[0].theta_rad, sides[0].tension_N);
  const LoadEquations b = load_equations(table, parameters_, sides[1].theta_rad, sides[1].tension_N);
  const Eigen::VectorXd friction_Nm = 0.5 * kFrictionLeft * (a.left_Nm - b.left_Nm);
  a.reading_Nm = (a.reading_Nm.array().square() + friction_Nm.array().square()).sqrt();
  a.left_Nm = 0.5 * (a.left_Nm + b.left_Nm);
  a.rows = 0.5 * (a.rows + b.rows);
  return a;
}

LoadFit::Sum LoadFit::sum(const RobotParams& table, const Eigen::VectorXd& value) const {
  const Index cables = static_cast<Index>(table_.cable_count());
  const Eigen::VectorXd amount = prior_.asDiagonal() * gravity_row(table_, parameters_, cables);
  Sum out{amount * amount.transpose(), -amount * amount.dot(value)};
  const Eigen::VectorXd gain = (prior_.asDiagonal() * value).tail(eigen_index(cables));
  for (const auto& sides : poses_) {
    const LoadEquations one = equations(sides, table);
    const Eigen::VectorXd weight = one.reading_Nm.array().inverse();
    const Eigen::MatrixXd rows = weight.asDiagonal() * one.rows * prior_.asDiagonal();
    const Eigen::VectorXd left = weight.asDiagonal() * (one.left_Nm + one.rows.rightCols(eigen_index(cables)) * gain);
    out.normal += rows.transpose() * rows;
    out.right -= rows.transpose() * left;
    out.chi2 += left.squaredNorm();
    out.count += static_cast<double>(left.size());
  }
  return out;
}

LoadError LoadFit::error(const RobotParams& table, const Eigen::VectorXd& gain) const {
  const CableLayout layout = cable_layout(table);
  const auto thetas = static_cast<Index>(table.theta_count()), cables = static_cast<Index>(table.cable_count());
  double torque = 0.0, tension = 0.0;
  for (const auto& sides : poses_) {
    const LoadEquations one = equations(sides, table);
    const Eigen::VectorXd left = one.left_Nm + one.rows.rightCols(gain.size()) * gain;
    ThetaVector left_Nm{};
    for (Index k = 0; k < thetas; ++k) left_Nm[k] = left(eigen_index(k));
    const ArmTrig trig = arm_trig(table, sides[0].theta_rad);
    const TensionSolver solver =
        tension_solver(table, cable_geometry(table, layout, trig), tension_ratio(table, layout, trig, SlipState{}));
    const CableVector pull_N = pulls_for(table, solver, left_Nm);
    for (Index c = 0; c < cables; ++c) tension += pull_N[c] * pull_N[c];
    torque += left.squaredNorm();
  }
  const auto poses = static_cast<double>(poses_.size());
  return {root_mean(torque, poses * static_cast<double>(thetas)),
          root_mean(tension, poses * static_cast<double>(cables))};
}

LoadResult LoadFit::solve() const {
  if (parameters_.empty())
    throw std::runtime_error("load: the robot table has neither gravity_m_s2 nor joint stiffness: nothing to find");
  if (poses_.size() < kMinLoadPoses)
    throw std::runtime_error(text("load: %zu poses: allowed at least %zu: name more", poses_.size(), kMinLoadPoses));
  const Index count = parameters_.size();
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(prior_.size(), prior_.size());
  Eigen::VectorXd value = Eigen::VectorXd::Zero(prior_.size());
  RobotParams table = table_;
  Sum last{};
  for (int step = 0; step <= kLoadSteps; ++step) {
    last = sum(table, value);
    if (step == kLoadSteps) break;  // only the sums at the end
    value += Eigen::LDLT<Eigen::MatrixXd>(last.normal + one).solve(last.right - value);
    for (Index p = 0; p < count; ++p)
      *parameters_[p].slot(table, parameters_[p].index) =
          parameters_[p].table_value + parameters_[p].prior_sd * value(eigen_index(p));
  }
  LoadResult out;
  const Eigen::MatrixXd covariance = Eigen::LDLT<Eigen::MatrixXd>(last.normal + one).solve(one);
  const double scale = std::sqrt(std::max(1.0, last.chi2 / std::max(1.0, last.count - static_cast<double>(count))));
  for (Index p = 0; p < count; ++p) {
    const LoadParameter& parameter = parameters_[p];
    const double sd = parameter.prior_sd * std::min(1.0, scale * std::sqrt(covariance(eigen_index(p), eigen_index(p))));
    const double found = parameter.table_value + parameter.prior_sd * value(eigen_index(p));
    out.values.push_back({parameter.field, found, sd});
    if (std::fabs(value(eigen_index(p))) > kPlausibleDeviations)
      out.problems.push_back(
          parameter.field + text(": %.4g was found, the table has %.4g: allowed %.4g around it: measure it and correct "
                                 "the table, or see whether something rests on the arm",
                                 found, parameter.table_value, kPlausibleDeviations * parameter.prior_sd));
  }
  // What remains of the parameters where any torque gain may be had; below 1 the readings say less than the table.
  const auto P = eigen_index(count), C = prior_.size() - P;
  const Eigen::MatrixXd gains = last.normal.bottomRightCorner(C, C) + Eigen::MatrixXd::Identity(C, C);
  const Eigen::MatrixXd cross = last.normal.topRightCorner(P, C);
  const Eigen::MatrixXd own =
      last.normal.topLeftCorner(P, P) - cross * Eigen::LDLT<Eigen::MatrixXd>(gains).solve(cross.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> directions(own);
  for (Eigen::Index i = 0; i < P; ++i) {
    if (directions.eigenvalues()(i) >= scale * scale) continue;
    std::vector<std::string> fields;
    for (Index p = 0; p < count; ++p) {
      if (std::fabs(directions.eigenvectors()(eigen_index(p), i)) > kTakesPart) fields.push_back(parameters_[p].field);
    }
    out.not_told_apart.push_back(fields);
  }
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(C);
  out.before = error(table_, none);
  out.after = error(table, none);
  out.with_gains = error(table, kPriorTorqueGain * value.tail(C));
  return out;
}

}  // namespace liana::calibration
