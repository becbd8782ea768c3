#include "host/plan/problem/pose_model.hpp"

#include <vector>

namespace liana {

using Index = std::size_t;

PoseModel push_model(const Room& room, const ThetaVector& theta, double wanted_m, bool derivatives) {
  PoseModel model;
  const LinkPoints points = link_points(room.table(), theta);
  std::vector<std::pair<Clearance, std::int32_t>> close;
  for (std::int32_t obstacle = 0; obstacle < obstacle_count(room.scene()); ++obstacle) {
    for (std::int32_t link = 0; link + 1 < points.count; ++link) {
      const Clearance here = clearance(link_capsule(points, link, room.link_radius_m()), room.scene(), obstacle);
      if (here.distance_m < wanted_m) close.push_back({here, link});
    }
  }
  for (const auto& [here, link] : close) model.cost += (wanted_m - here.distance_m) * (wanted_m - here.distance_m);
  if (!derivatives || close.empty()) return model;
  const ArmDerivatives arm(room.table(), theta);
  for (const auto& [here, link] : close) {
    const PointDerivatives point = arm.point({link, here.share});
    ThetaVector slope{};
    for (Index k = 0; k < slope.size(); ++k) slope[k] = dot(here.normal, point.by_theta[k]);
    for (Index k = 0; k < slope.size(); ++k) {
      model.gradient[k] -= 2.0 * (wanted_m - here.distance_m) * slope[k];
      for (Index j = 0; j <= k; ++j) model.hessian[k][j] += 2.0 * slope[k] * slope[j];
    }
  }
  return model;
}

}  // namespace liana
