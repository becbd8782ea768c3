#include "host/simulate/serial_simulation.hpp"

#include <cmath>

namespace liana::simulate {

using serial::JointVector;

SerialSimulation::SerialSimulation(const SerialModel& model, const config::SceneConfig& scene, double enough_m)
    : model_(model), scene_(scene), enough_m_(enough_m), contact_(model), length_m_(axis_length_m(model.table)) {}

// First order, the exact solution for a straight way from row to row; before the first one the drives have followed a
// motion as fast as there for long.
void SerialSimulation::follow(const JointVector& start_rad, const ToldRows<JointVector>& told) {
  const double tau_s = model_.table.servo_time_constant_s, step_s = told.interval_s;
  const double left = std::exp(-step_s / tau_s);
  motion_.joint_rad.assign(told.rows_rad.size(), start_rad);
  for (std::size_t i = 0; i < model_.table.joints(); ++i) {
    const auto told_rad = [&](std::size_t row) { return told.rows_rad[row][i]; };
    double behind_rad = tau_s / step_s * (told_rad(1) - told_rad(0));
    const double beside_rad = start_rad[i] - (told_rad(0) - behind_rad);
    for (std::size_t row = 1; row < told.rows_rad.size(); ++row) {
      const double steady_rad = tau_s / step_s * (told_rad(row) - told_rad(row - 1));
      behind_rad = steady_rad + left * (behind_rad - steady_rad);
      motion_.joint_rad[row][i] = told_rad(row) - behind_rad + beside_rad;
    }
  }
}

namespace {

void as_link(Nearest& of_piece) {
  if (of_piece.link >= 0) of_piece.link = (of_piece.link + 1) / kPiecesPerLink;
}

}  // namespace

// The first piece, along the axis of joint 1, never moves: it stands on what the arm is bolted to.
void SerialSimulation::measure_distances(double interval_s) {
  Distances& out = motion_.distances;
  if (clearance::obstacle_count(scene_) > 0) {
    measure_to_scene(model_.link_radius_m, {scene_, {}}, moving_, enough_m_, interval_s, out);
    as_link(out.scene);
    for (BodyBeside& body : out.bodies) as_link(body.nearest);
  } else {
    out.scene = {clearance::kNoObstacle_m, -1, -1, 0.0};
    out.scene_at_start_m = out.scene_at_end_m = clearance::kNoObstacle_m;
  }
  const auto look = [&](std::int32_t pose) { return contact_.least(axes_[static_cast<std::size_t>(pose)]); };
  measure_to_itself(moving_, interval_s, look, out);
}

const SerialMotion& SerialSimulation::run(const JointVector& start_rad, const ToldRows<JointVector>& told) {
  follow(start_rad, told);
  moving_.begin(length_m_);
  axes_.clear();
  motion_.tip_in_base_m.clear();
  for (std::size_t row = 0; row < motion_.joint_rad.size(); ++row) {
    const JointVector& now = motion_.joint_rad[row];
    const JointVector& before = motion_.joint_rad[row > 0 ? row - 1 : 0];
    double turned_rad = 0.0;
    for (std::size_t i = 0; i < model_.table.joints(); ++i) turned_rad += std::fabs(now[i] - before[i]);
    axes_.push_back(serial_axis(model_.table, now));
    moving_.add(axes_.back().points().subspan(1), turned_rad);
    motion_.tip_in_base_m.push_back(axes_.back().tip_m());
  }
  measure_distances(told.interval_s);
  return motion_;
}

}  // namespace liana::simulate
