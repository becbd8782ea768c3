#include "hil/serial/link_axis.hpp"

#include <algorithm>

#include "hil/arm/clearance.hpp"

namespace liana::bench {

std::vector<Vec3> link_axis_m(const MujocoModel& arm, const SerialRobotConfig& robot) {
  std::vector<Vec3> axis;
  const auto add = [&](const Vec3& at) {
    if (axis.empty() || norm(at - axis.back()) > 0.0) axis.push_back(at);
  };
  const int first = mj_name2id(arm.model, mjOBJ_BODY, "link1");
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const int link = first + static_cast<int>(i);  // one body in the other, the tip behind the last
    const mjtNum *p = arm.data->xpos + 3 * link, *m = arm.data->xmat + 9 * link, *next = p + 3;
    const Vec3 along{m[2], m[5], m[8]};
    add(Vec3{p[0], p[1], p[2]} + robot.joints[i].d_m * along);
    add({next[0], next[1], next[2]});
  }
  return axis;
}

bool has_bodies(const SceneConfig& scene) {
  return !scene.boxes.empty() || !scene.spheres.empty() || !scene.convex.empty();
}

double clearance_m(const std::vector<Vec3>& axis_m, const SceneConfig& scene, double radius_m) {
  const Clearance least = clearance_of(axis_m, scene, radius_m);
  return std::min({least.slit_m, least.sphere_m, least.convex_m});
}

}  // namespace liana::bench
