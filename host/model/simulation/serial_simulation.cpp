#include "host/model/simulation/serial_simulation.hpp"

#include <algorithm>
#include <cmath>

namespace liana::simulation {

using serial::JointVector;

SerialSimulation::SerialSimulation(const SerialModel& model, const config::SceneConfig& scene, double enough_m)
    : model_(model),
      scene_(scene),
      enough_m_(enough_m),
      carried_(scene.payload ? std::optional(carried_body(*scene.payload)) : std::nullopt),
      contact_(model, carried_),
      length_m_(axis_length_m(model.table)) {}

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

// Pieces as they are numbered without the first one; what is carried comes after the last.
void as_link(Nearest& of_piece) {
  if (of_piece.link >= 0) of_piece.link = (of_piece.link + 1) / kPiecesPerLink;
}

}  // namespace

// The first piece, along the axis of joint 1, never moves: it stands on what the arm is bolted to.
void SerialSimulation::measure_to_bodies(bool carries, double interval_s) {
  Distances& out = motion_.distances;
  out.bodies.clear();
  if (clearance::obstacle_count(scene_) == 0) {
    out.scene = {clearance::kNoObstacle_m, -1, -1, 0.0};
    out.scene_at_start_m = out.scene_at_end_m = clearance::kNoObstacle_m;
    return;
  }
  const std::size_t points = kPiecesPerLink * model_.table.joints();
  const std::array<Pieces, 2> arm{{{model_.link_radius_m, 0, points}, {carries ? carried_->radius_m : 0.0, points, 2}}};
  measure_to_scene({arm.data(), carries ? 2U : 1U}, {scene_, {}}, moving_, enough_m_, interval_s, out);
  as_link(out.scene);
  for (BodyBeside& body : out.bodies) as_link(body.nearest);
}

void SerialSimulation::add_to_way(const SerialAxis& axis, bool carries, double turned_rad) {
  std::array<Vec3, kMaxSerialPoints + 1> point_m;
  const clearance::AxisPoints moving = axis.points().subspan(1);
  auto end = std::copy(moving.begin(), moving.end(), point_m.begin());
  if (carries)
    for (const double along_m : {carried_->from_m, carried_->to_m}) *end++ = axis.beyond_tip_m(along_m);
  moving_.add({point_m.begin(), end}, turned_rad);
}

const SerialMotion& SerialSimulation::run(const JointVector& start_rad, const ToldRows<JointVector>& told,
                                          bool carries) {
  carries = carries && carried_;
  follow(start_rad, told);
  moving_.begin(length_m_ + (carries ? carried_->to_m : 0.0));
  axes_.clear();
  motion_.tip_in_base_m.clear();
  for (std::size_t row = 0; row < motion_.joint_rad.size(); ++row) {
    const JointVector& now = motion_.joint_rad[row];
    const JointVector& before = motion_.joint_rad[row > 0 ? row - 1 : 0];
    double turned_rad = 0.0;
    for (std::size_t i = 0; i < model_.table.joints(); ++i) turned_rad += std::fabs(now[i] - before[i]);
    axes_.push_back(serial_axis(model_.table, now));
    const SerialAxis& axis = axes_.back();
    motion_.tip_in_base_m.push_back(axis.tip_m());
    add_to_way(axis, carries, turned_rad);
  }
  measure_to_bodies(carries, told.interval_s);
  const auto look = [&](std::int32_t pose) { return contact_.least(axes_[static_cast<std::size_t>(pose)], carries); };
  measure_to_itself(moving_, told.interval_s, look, motion_.distances);
  return motion_;
}

}  // namespace liana::simulation
