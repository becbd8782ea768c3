#include "host/drives/calibration/load_fit.hpp"

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

double root_mean(double sum, double count) { return std::sqrt(sum / count); }

}  // namespace

LoadFit::LoadFit(const RobotParams& table)
    : table_(table), fields_(load_fields(table)), prior_(prior_sd(fields_, static_cast<Index>(table.cable_count()))) {}

void LoadFit::add(const std::array<LoadReading, 2>& sides) { poses_.push_back(sides); }

// The mean of both sides, and in its noise what friction leaves.
LoadEquations LoadFit::equations(const std::array<LoadReading, 2>& sides, const RobotParams& table) const {
  LoadEquations a = load_equations(table, fields_, sides[0].theta_rad, sides[0].tension_N);
  const LoadEquations b = load_equations(table, fields_, sides[1].theta_rad, sides[1].tension_N);
  const Eigen::VectorXd friction_Nm = 0.5 * kFrictionLeft * (a.left_Nm - b.left_Nm);
  a.reading_Nm = (a.reading_Nm.array().square() + friction_Nm.array().square()).sqrt();
  a.left_Nm = 0.5 * (a.left_Nm + b.left_Nm);
  a.rows = 0.5 * (a.rows + b.rows);
  return a;
}

PriorFit LoadFit::sum(const RobotParams& table, const Eigen::VectorXd& value) const {
  const Index cables = static_cast<Index>(table_.cable_count());
  const Eigen::RowVectorXd amount = gravity_row(table_, fields_, cables).transpose() * prior_.asDiagonal();
  PriorFit out(static_cast<Index>(prior_.size()));
  out.add(amount, amount * value);
  const Eigen::VectorXd gain = (prior_.asDiagonal() * value).tail(eigen_index(cables));
  for (const auto& sides : poses_) {
    const LoadEquations one = equations(sides, table);
    const Eigen::VectorXd weight = one.reading_Nm.array().inverse();
    out.add(weight.asDiagonal() * one.rows * prior_.asDiagonal(),
            weight.asDiagonal() * (one.left_Nm + one.rows.rightCols(eigen_index(cables)) * gain));
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
  if (fields_.empty())
    throw std::runtime_error("load: the robot table has neither gravity_m_s2 nor joint stiffness: nothing to find");
  if (poses_.size() < kMinLoadPoses)
    throw std::runtime_error(text("load: %zu poses: allowed at least %zu: name more", poses_.size(), kMinLoadPoses));
  Eigen::VectorXd value = Eigen::VectorXd::Zero(prior_.size());
  RobotParams table = table_;
  for (int step = 0; step < kLoadSteps; ++step) {
    value += sum(table, value).step(value);
    for (Index f = 0; f < fields_.size(); ++f)
      *fields_[f].slot(table, fields_[f].index) = fields_[f].known_value + fields_[f].known_sd * value(eigen_index(f));
  }
  LoadResult out{sum(table, value).found(fields_, value), {}, {}, {}};
  const Eigen::Index cables = eigen_index(static_cast<Index>(table_.cable_count()));
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(cables);
  out.before = error(table_, none);
  out.after = error(table, none);
  out.with_gains = error(table, kPriorTorqueGain * value.tail(cables));
  return out;
}

}  // namespace liana::calibration
