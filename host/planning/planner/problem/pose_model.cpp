#include "host/planning/planner/problem/pose_model.hpp"

#include <vector>

#include "host/planning/planner/problem/arm_derivatives.hpp"

namespace liana::planner {

PoseModel push_model(const Room& room, const ThetaVector& theta, double wanted_m, bool derivatives) {
  const Eigen::Index n = eigen::theta_count(room.table());
  PoseModel model(n);
  const LinkPoints points = link_points(room.table(), theta);
  std::vector<std::pair<clearance::Clearance, std::int32_t>> close;
  std::vector<clearance::Clearance> links;
  for (std::int32_t obstacle = 0; obstacle < clearance::obstacle_count(room.scene()); ++obstacle) {
    clearance::link_clearances(points.axis(), room.link_radius_m(), room.scene(), obstacle, wanted_m, links);
    for (std::size_t i = 0; i < links.size(); ++i) {
      if (links[i].distance_m < wanted_m) close.push_back({links[i], static_cast<std::int32_t>(i)});
    }
  }
  for (const auto& [here, link] : close) model.cost += (wanted_m - here.distance_m) * (wanted_m - here.distance_m);
  if (!derivatives || close.empty()) return model;
  const ArmDerivatives arm(room.table(), theta);
  for (const auto& [here, link] : close) {
    const PointDerivatives point = arm.point({link, here.share});
    const eigen::ThetaColumn slope = eigen::view(point.by_theta, n).transpose() * eigen::view(here.normal);
    model.gradient -= 2.0 * (wanted_m - here.distance_m) * slope;
    model.hessian.noalias() += 2.0 * slope * slope.transpose();
  }
  return model;
}

}  // namespace liana::planner
