#include "host/simulate/simulation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "host/clearance/self_clearance.hpp"

namespace liana::simulate {

namespace {

using algebra::ThetaColumn;
using algebra::view;
using Index = std::size_t;

constexpr double kPlannedFloor =
    1.5;  // assumed, times the table's floor: where tensions are planned without measured ones

ThetaColumn column(const ThetaVector& theta, Eigen::Index count) { return view(theta, count); }

ThetaVector vector(const ThetaColumn& theta) {
  ThetaVector out{};
  view(out, theta.size()) = theta;
  return out;
}

double largest_change(const ThetaColumn& a, const ThetaVector& b) {
  return (a - view(b, a.size())).cwiseAbs().maxCoeff();
}

double length_m(const RobotTable& table) {
  double sum_m = 0.0;
  for (Index m = 0; m < static_cast<Index>(table.segment_count); ++m)
    sum_m += table.segment[m].modules * table.segment[m].module_length_m;
  return sum_m;
}

double largest_joint_limit_rad(const RobotTable& table) {
  double largest_rad = 0.0;
  for (Index m = 0; m < static_cast<Index>(table.segment_count); ++m)
    largest_rad = std::max(largest_rad, table.segment[m].theta_limit_rad);
  return largest_rad;
}

// What all joints of all modules together turn by between two poses.
double all_turns_rad(const ArmModel& model, const ThetaVector& from_rad, const ThetaVector& to_rad) {
  double sum_rad = 0.0;
  for (Index i = 0; i < static_cast<Index>(model.table.theta_count()); ++i)
    sum_rad += model.table.segment[i / 2].modules * std::fabs(to_rad[i] - from_rad[i]);
  return sum_rad;
}

double turn_between_rad(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return Eigen::AngleAxisd(a.transpose() * b).angle();
}

}  // namespace

bool Simulation::solve(const ThetaVector& about_rad) {
  about_rad_ = about_rad;
  return arm_.solve(model_, about_rad, step_s_);
}

// What is measured differs from what would be planned here by friction, gains and the core's own way of planning: taken
// as it is all the way.
void Simulation::plan_tensions(const StartState* start) {
  const Eigen::Index cables = arm_.paths().stiffness_N_per_m.size();
  const TensionLimits& limits = model_.table.tension;
  tension_N_ = balanced_tensions(arm_.paths(), CableColumn::Constant(cables, limits.plan_N),
                                 kPlannedFloor * limits.floor_motor_N);
  if (start != nullptr) {
    const Eigen::Map<const CableColumn> measured_N(start->tension_N.data(), cables);
    tension_measured_N_ =
        measured_N.isZero() ? CableColumn(CableColumn::Zero(cables)) : CableColumn(measured_N - tension_N_);
  }
  tension_N_ += tension_measured_N_;

  const ThetaColumn band_rad = arm_.band_rad(friction_torque(model_, arm_.paths(), tension_N_));
  auto most_rad = view(motion_.friction_band_rad, band_rad.size());
  most_rad = most_rad.cwiseMax(band_rad);
  const double mu = (1.0 + model_.friction_band) * model_.table.friction_mu;
  for (Eigen::Index c = 0; c < cables; ++c) {
    double& least = motion_.least_passed_share[static_cast<Index>(c)];
    least = std::min(least, std::exp(-mu * arm_.paths().wrap_rad[c]));
  }
}

void Simulation::add_to_way(const ThetaVector& theta_rad) {
  std::array<Vec3, kMaxLinks + 1> axis_m;
  const std::size_t points = static_cast<Index>(chain_.links) + 1;
  for (Index i = 0; i < points; ++i) axis_m[i] = {chain_.point_m[i].x(), chain_.point_m[i].y(), chain_.point_m[i].z()};
  const double turned_rad =
      motion_.moments.empty() ? 0.0 : all_turns_rad(model_, motion_.moments.back().theta_rad, theta_rad);
  way_.add({axis_m.data(), points}, turned_rad);
}

void Simulation::note(const Swing& swing) {
  const std::vector<Moment>& so_far = motion_.moments;
  const Eigen::Matrix3d tip_before = chain_.rotation[static_cast<Index>(chain_.links)];
  Moment now;
  now.time_s = static_cast<double>(so_far.size()) * step_s_;
  now.theta_rad = vector(swing.theta_rad);
  now.rate_rad_s = vector(swing.rate_rad_s);
  place(model_, now.theta_rad, chain_);
  add_to_way(now.theta_rad);
  Index link = 0;
  for (Index m = 0; m < static_cast<Index>(model_.table.segment_count); ++m) {
    link += static_cast<Index>(model_.table.segment[m].modules);
    now.node_in_base_m[m] = {chain_.point_m[link].x(), chain_.point_m[link].y(), chain_.point_m[link].z()};
    if (!so_far.empty())
      now.node_speed_m_s[m] = norm(subtract(now.node_in_base_m[m], so_far.back().node_in_base_m[m])) / step_s_;
  }
  if (!so_far.empty()) now.tip_rate_rad_s = turn_between_rad(tip_before, chain_.rotation[link]) / step_s_;
  const CableColumn tension_N = tension_N_ + arm_.stretch_N(swing);
  Eigen::Map<CableColumn>(now.tension_N.data(), tension_N.size()) = tension_N;
  motion_.moments.push_back(now);
}

void Simulation::step(DrumLag& lag, const ThetaColumn& told_rad, Swing& swing) {
  const ThetaColumn before_rad = lag.drums_rad();
  lag.step(told_rad);
  arm_.step(swing.drums_rad + (lag.drums_rad() - before_rad), swing);
  if (largest_change(swing.theta_rad, about_rad_) > kNewPose_rad) {
    motion_.solved = motion_.solved && solve(vector(swing.theta_rad));
    if (motion_.solved) plan_tensions(nullptr);
  }
  note(swing);
}

void Simulation::place_told(const JointSequence& sequence) {
  motion_.told_tip_in_base_m.clear();
  for (const ThetaVector& row : sequence.rows_rad) {
    place(model_, row, chain_);
    const Eigen::Vector3d& tip_m = chain_.tip_m();
    motion_.told_tip_in_base_m.push_back({tip_m.x(), tip_m.y(), tip_m.z()});
  }
}

void Simulation::measure_distances(const Pose& drawing_in_base) {
  const Pieces arm{model_.link_radius_m, 0, way_.axis(0).size()};
  measure_to_scene({&arm, 1}, {scene_, drawing_in_base}, way_, enough_m_, step_s_, motion_.distances);
  const std::int32_t apart = clearance::least_apart(largest_joint_limit_rad(model_.table));
  const auto look = [&](std::int32_t pose) {
    return clearance::self_clearance(way_.axis(static_cast<std::size_t>(pose)), model_.link_radius_m, apart);
  };
  measure_to_itself(way_, step_s_, look, motion_.distances);
}

const Motion& Simulation::run(const StartState& start, const JointSequence& sequence) {
  const Eigen::Index thetas = algebra::theta_count(model_.table);
  step_s_ = sequence.interval_s / kStepsPerInterval;
  motion_.moments.clear();
  place_told(sequence);
  motion_.friction_band_rad.fill(0.0);
  motion_.least_passed_share.fill(1.0);
  way_.begin(length_m(model_.table));
  motion_.solved = solve(start.theta_rad);
  if (!motion_.solved) return motion_;
  plan_tensions(&start);

  const auto told = [&](Index row) { return column(sequence.rows_rad[row], thetas); };
  DrumLag lag(model_.table.servo_time_constant_s, step_s_, told(0), (told(1) - told(0)) / sequence.interval_s);
  // The arm is where it is measured: where it stands beside the drums' angles it is held by friction, and stays so.
  Swing swing{column(start.theta_rad, thetas), column(start.rate_rad_s, thetas), column(start.theta_rad, thetas)};
  note(swing);
  for (Index row = 1; row < sequence.rows_rad.size() && motion_.solved; ++row) {
    for (int i = 1; i <= kStepsPerInterval; ++i)
      step(lag, told(row - 1) + (told(row) - told(row - 1)) * (static_cast<double>(i) / kStepsPerInterval), swing);
  }
  const int after = static_cast<int>(std::ceil(kSwingOut_s / step_s_));
  for (int i = 0; i < after && motion_.solved; ++i) step(lag, told(sequence.rows_rad.size() - 1), swing);
  measure_distances(start.drawing_in_base);
  return motion_;
}

}  // namespace liana::simulate
