#include "host/simulate/distances.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "host/clearance/along_motion.hpp"
#include "host/clearance/arm_clearance.hpp"
#include "host/clearance/self_clearance.hpp"

namespace liana::simulate {

namespace {

Vec3 vec3(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

double length_m(const RobotTable& table) {
  double sum_m = 0.0;
  for (std::size_t m = 0; m < static_cast<std::size_t>(table.segment_count); ++m)
    sum_m += table.segment[m].modules * table.segment[m].module_length_m;
  return sum_m;
}

double largest_joint_limit_rad(const RobotTable& table) {
  double largest_rad = 0.0;
  for (std::size_t m = 0; m < static_cast<std::size_t>(table.segment_count); ++m)
    largest_rad = std::max(largest_rad, table.segment[m].theta_limit_rad);
  return largest_rad;
}

// Bodies stay as they are drawn, and the arm's axis goes to them.
class AxisInDrawing {
 public:
  AxisInDrawing(std::span<const Vec3> axis_m, const Pose& drawing_in_base) : count_(axis_m.size()) {
    const Pose base_in_drawing = inverse(drawing_in_base);
    for (std::size_t i = 0; i < count_; ++i)
      point_m_[i] = add(rotate(base_in_drawing.quaternion, axis_m[i]), base_in_drawing.position_m);
  }
  std::span<const Vec3> points_m() const { return {point_m_.data(), count_}; }

 private:
  std::array<Vec3, kMaxLinks + 1> point_m_;
  std::size_t count_;
};

clearance::ArmClearance to_scene(const ArmModel& model, const StandingScene& standing, const Way& way,
                                 std::size_t pose) {
  const AxisInDrawing axis(way.axis(pose), standing.drawing_in_base);
  return clearance::arm_clearance(axis.points_m(), model.link_radius_m, standing.scene);
}

template <class Found>
Nearest nearest_of(const clearance::AlongMotion<Found>& along, std::int32_t other, double step_s) {
  return {along.at_least_m, along.nearest.link, other, along.pose * step_s};
}

}  // namespace

void Way::clear() {
  points_.clear();
  gone_m_.clear();
}

// What all joints together turn by from the last pose to this one.
double Way::turned_rad(const ArmModel& model, const ThetaVector& theta_rad) const {
  double sum_rad = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(model.table.theta_count()); ++i)
    sum_rad += model.table.segment[i / 2].modules * std::fabs(theta_rad[i] - theta_rad_[i]);
  return sum_rad;
}

// On the way between two poses a point leaves the straight line by at most an eighth of what its path bends: the arm's
// length times the square of all turns.
void Way::add(const ArmModel& model, const Chain& chain, const ThetaVector& theta_rad) {
  points_per_pose_ = static_cast<std::size_t>(chain.links) + 1;
  const std::size_t before = points_.size();
  for (std::size_t i = 0; i < points_per_pose_; ++i) points_.push_back(vec3(chain.point_m[i]));
  if (gone_m_.empty()) {
    gone_m_.push_back(0.0);
  } else {
    double most2 = 0.0;
    for (std::size_t i = 0; i < points_per_pose_; ++i) {
      const Vec3 way = subtract(points_[before + i], points_[before - points_per_pose_ + i]);
      most2 = std::max(most2, dot(way, way));
    }
    const double turned = turned_rad(model, theta_rad);
    gone_m_.push_back(gone_m_.back() + std::sqrt(most2) + 0.25 * length_m(model.table) * turned * turned);
  }
  theta_rad_ = theta_rad;
}

Nearest least_to_scene(const ArmModel& model, const StandingScene& standing, const Way& way, double enough_m,
                       double step_s) {
  const auto look = [&](std::int32_t pose) { return to_scene(model, standing, way, static_cast<std::size_t>(pose)); };
  const auto along = clearance::least_along({way.gone_m(), 1.0, enough_m, kUnseen_m}, look);
  return nearest_of(along, along.nearest.obstacle, step_s);
}

Nearest least_to_itself(const ArmModel& model, const Way& way, double step_s) {
  const std::int32_t apart = clearance::least_apart(largest_joint_limit_rad(model.table));
  const auto look = [&](std::int32_t pose) {
    return clearance::self_clearance(way.axis(static_cast<std::size_t>(pose)), model.link_radius_m, apart);
  };
  const auto along = clearance::least_along({way.gone_m(), 2.0, kEnoughSelf_m, kUnseen_m}, look);
  return nearest_of(along, along.nearest.other, step_s);
}

double to_scene_m(const ArmModel& model, const StandingScene& standing, const Way& way, std::size_t pose) {
  return to_scene(model, standing, way, pose).distance_m();
}

}  // namespace liana::simulate
