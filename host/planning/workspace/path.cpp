#include "host/planning/workspace/path.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

#include "host/base/eigen/thetas.hpp"

namespace liana::workspace {
namespace {

bool is_held(std::uint32_t held_mask, std::size_t theta) { return (held_mask >> theta & 1u) != 0; }

void find_singular_values(const cable::RobotParams& table, std::uint32_t held_mask, PathPoint& point) {
  const cable::ArmKinematics arm = forward_kinematics(table, point.theta_rad);
  point.tip_in_base_m = arm.tip_in_base.position_m;
  const Eigen::Index n = eigen::theta_count(table);
  Eigen::Matrix<double, 6, cable::kMaxTheta> J = Eigen::Matrix<double, 6, cable::kMaxTheta>::Zero();
  J.topLeftCorner(3, n) = eigen::view(arm.tip_jacobian.linear, n);
  J.bottomLeftCorner(3, n) = eigen::view(arm.tip_jacobian.angular, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (is_held(held_mask, static_cast<std::size_t>(i))) J.col(i).setZero();
  }
  const Eigen::Matrix<double, 6, 1> values = Eigen::JacobiSVD<decltype(J)>(J).singularValues();
  point.largest_singular_value = values[0];
  point.least_singular_value = values[5];
}

void find_nearest_limit(const cable::RobotParams& table, std::uint32_t held_mask, PathPoint& point) {
  point.limit_margin_rad = std::numeric_limits<double>::infinity();
  for (std::int32_t i = 0; i < table.theta_count(); ++i) {
    const auto index = static_cast<std::size_t>(i);
    if (is_held(held_mask, index)) continue;
    const double margin_rad = table.segment[index / 2].theta_limit_rad - std::fabs(point.theta_rad[index]);
    if (margin_rad >= point.limit_margin_rad) continue;
    point.limit_margin_rad = margin_rad;
    point.nearest_theta = i + 1;
  }
}

PathPoint examine(const cable::RobotParams& table, std::uint32_t held_mask, double travel_rad,
                  const cable::ThetaVector& theta_rad) {
  PathPoint point;
  point.way = travel_rad;
  point.theta_rad = theta_rad;
  find_singular_values(table, held_mask, point);
  find_nearest_limit(table, held_mask, point);
  return point;
}

double largest_change_rad(const cable::ThetaVector& a, const cable::ThetaVector& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < cable::kMaxTheta; ++i) largest = std::max(largest, std::fabs(b[i] - a[i]));
  return largest;
}

cable::ThetaVector between(const cable::ThetaVector& a, const cable::ThetaVector& b, double share) {
  cable::ThetaVector theta{};
  for (std::size_t i = 0; i < cable::kMaxTheta; ++i) theta[i] = a[i] + share * (b[i] - a[i]);
  return theta;
}

template <typename Less>
std::size_t first_least(const std::vector<PathPoint>& points, const Less& less) {
  return static_cast<std::size_t>(std::min_element(points.begin(), points.end(), less) - points.begin());
}

}  // namespace

double condition_number(const PathPoint& point) {
  if (point.least_singular_value <= 1e-12 * point.largest_singular_value)
    return std::numeric_limits<double>::infinity();
  return point.largest_singular_value / point.least_singular_value;
}

PathStatus examine_path(const cable::RobotParams& table, const std::vector<cable::ThetaVector>& waypoints_rad,
                        std::uint32_t held_mask) {
  PathStatus report;
  report.points.push_back(examine(table, held_mask, 0.0, waypoints_rad.front()));
  report.waypoint_way.push_back(0.0);
  for (std::size_t leg = 1; leg < waypoints_rad.size(); ++leg) {
    const cable::ThetaVector &from = waypoints_rad[leg - 1], &to = waypoints_rad[leg];
    const double change_rad = largest_change_rad(from, to);
    const int steps = std::max(1, static_cast<int>(std::ceil(change_rad / kPathStep_rad - 1e-9)));
    for (int k = 1; k < steps; ++k) {
      const double share = static_cast<double>(k) / steps;
      report.points.push_back(
          examine(table, held_mask, report.joint_travel_rad + share * change_rad, between(from, to, share)));
    }
    report.joint_travel_rad += change_rad;
    report.points.push_back(examine(table, held_mask, report.joint_travel_rad, to));
    report.waypoint_way.push_back(report.joint_travel_rad);
  }
  const double travel_rad = report.joint_travel_rad > 0.0 ? report.joint_travel_rad : 1.0;
  for (PathPoint& point : report.points) point.way /= travel_rad;
  for (double& way : report.waypoint_way) way /= travel_rad;
  report.worst_conditioned =
      first_least(report.points, [](auto& a, auto& b) { return a.least_singular_value < b.least_singular_value; });
  report.nearest_limit =
      first_least(report.points, [](auto& a, auto& b) { return a.limit_margin_rad < b.limit_margin_rad; });
  return report;
}

}  // namespace liana::workspace
