#include "host/model/simulation/simulation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "host/model/clearance/self_clearance.hpp"

namespace liana::simulation {

namespace {

using eigen::ThetaColumn;
using eigen::view;
using Index = std::size_t;

double length_m(const RobotParams& table) {
  double sum_m = 0.0;
  for (Index m = 0; m < static_cast<Index>(table.segment_count); ++m)
    sum_m += table.segment[m].modules * table.segment[m].module_length_m;
  return sum_m;
}

double largest_joint_limit_rad(const RobotParams& table) {
  double largest_rad = 0.0;
  for (Index m = static_cast<Index>(table.first_bending()); m < static_cast<Index>(table.segment_count); ++m)
    largest_rad = std::max(largest_rad, table.segment[m].theta_limit_rad);
  return largest_rad;
}

// What all joints of all modules together turn by between two poses; slide and roll of a base count as one each.
double all_turns_rad(const ArmModel& model, const ThetaVector& from_rad, const ThetaVector& to_rad) {
  double sum_rad = 0.0;
  for (Index i = 0; i < static_cast<Index>(model.table.theta_count()); ++i)
    sum_rad += std::max(1, model.table.segment[i / 2].modules) * std::fabs(to_rad[i] - from_rad[i]);
  return sum_rad;
}

double turn_between_rad(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return Eigen::AngleAxisd(a.transpose() * b).angle();
}

}  // namespace

ToldNow Simulation::told(const JointSequence& sequence, std::size_t row) const {
  const Eigen::Index thetas = eigen::theta_count(model_.table);
  return {view(sequence.rows_rad[row], thetas), view(sequence.loads_Nm[row], thetas),
          Eigen::Map<const CableColumn>(sequence.tensions_N[row].data(), model_.table.cable_count())};
}

void Simulation::look_at_friction(const CableColumn& tension_N) {
  const CablePaths& paths = arm_.equations().paths();
  const ThetaColumn band_rad = arm_.equations().band_rad(friction_torque(model_, paths, tension_N));
  auto max_rad = view(motion_.friction_band_rad, band_rad.size());
  max_rad = max_rad.cwiseMax(band_rad);
  const double mu = (1.0 + model_.friction_band) * model_.table.friction_mu;
  for (Eigen::Index c = 0; c < tension_N.size(); ++c) {
    double& least = motion_.min_passed_share[static_cast<Index>(c)];
    least = std::min(least, std::exp(-mu * paths.wrap_rad[c]));
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

void Simulation::note() {
  const std::vector<Moment>& so_far = motion_.moments;
  const Swing& swing = arm_.swing();
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
  const CableColumn tension_N = arm_.tension_N();
  Eigen::Map<CableColumn>(now.tension_N.data(), tension_N.size()) = tension_N;
  motion_.moments.push_back(now);
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
  const std::int32_t apart = clearance::min_apart(largest_joint_limit_rad(model_.table));
  const auto look = [&](std::int32_t pose) {
    return clearance::self_clearance(way_.axis(static_cast<std::size_t>(pose)), model_.link_radius_m, apart);
  };
  measure_to_itself(way_, step_s_, look, motion_.distances);
}

void Simulation::follow(const JointSequence& sequence) {
  const auto step = [&](const ToldNow& told) {
    const int solved = arm_.times_solved();
    motion_.solved = arm_.step(told);
    note();
    if (arm_.times_solved() != solved) look_at_friction(arm_.tension_N());
  };
  const std::size_t last = sequence.rows_rad.size() - 1;
  for (Index row = 1; row <= last && motion_.solved; ++row) {
    const ToldNow from = told(sequence, row - 1), to = told(sequence, row);
    for (int i = 1; i <= kStepsPerInterval && motion_.solved; ++i)
      step(from.to(to, static_cast<double>(i) / kStepsPerInterval));
  }
  const int after = static_cast<int>(std::ceil(kSwingOut_s / step_s_));
  for (int i = 0; i < after && motion_.solved; ++i) step(told(sequence, last));
}

const Motion& Simulation::run(const StartState& start, const JointSequence& asked) {
  const JointSequence made = asked.loads_Nm.empty() ? planned_with(model_, asked) : JointSequence{};
  const JointSequence& sequence = asked.loads_Nm.empty() ? made : asked;
  step_s_ = sequence.interval_s / kStepsPerInterval;
  motion_.moments.clear();
  place_told(sequence);
  motion_.friction_band_rad.fill(0.0);
  motion_.min_passed_share.fill(1.0);
  way_.begin(length_m(model_.table));
  // The drives have followed an even motion to the first row, as it goes on from there.
  const ToldNow now = told(sequence, 0), next = told(sequence, 1);
  motion_.solved = arm_.begin(start, next.to(now, 2.0), now, sequence.interval_s, step_s_);
  if (!motion_.solved) return motion_;
  note();
  look_at_friction(arm_.tension_N());
  follow(sequence);
  measure_distances(start.drawing_in_base);
  return motion_;
}

}  // namespace liana::simulation
