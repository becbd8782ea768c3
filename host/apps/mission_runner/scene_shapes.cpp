#include "host/apps/mission_runner/scene_shapes.hpp"

#include <cmath>
#include <stdexcept>

#include "firmware_like/math/pose.hpp"
#include "host/base/json/json.hpp"
#include "host/model/clearance/stl_hull.hpp"
#include "host/model/config/field.hpp"

namespace liana::mission_runner {
namespace {

// What makes base coordinates of the file's.
struct Placing {
  double unit_m = 1.0;
  Pose file_in_base;

  Vec3 operator()(const Vec3& point) const {
    return add(file_in_base.position_m, rotate(file_in_base.quaternion, scale(point, unit_m)));
  }
};

Placing placing_of(const config::Field& body) {
  Placing out;
  if (body.json().contains("unit_m")) out.unit_m = body.at("unit_m").number({0, 1000, true});
  if (body.json().contains("position_m")) out.file_in_base.position_m = body.at("position_m").numbers<3>({-100, 100});
  if (!body.json().contains("quaternion_wxyz")) return out;
  out.file_in_base.quaternion = body.at("quaternion_wxyz").numbers<4>({-1, 1});
  const Quat& q = out.file_in_base.quaternion;
  if (std::fabs(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] - 1.0) > 1e-9)
    body.at("quaternion_wxyz").refuse("unit length to 1e-9", "divide it by its length");
  return out;
}

Json with_points(const config::Field& body, const std::string& folder) {
  body.only({"name", "stl", "unit_m", "position_m", "quaternion_wxyz"});
  const config::Field file = body.at("stl");
  const std::string path = folder + "/" + file.name(80);
  const Placing place = placing_of(body);
  Json out = {{"name", body.at("name").name(40)}};
  Json points = Json::array();
  try {
    for (const Vec3& corner : clearance::stl_hull(path)) points.push_back(place(corner));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.file() + ": " + file.json().get<std::string>() + ": " + error.what());
  }
  out["points_m"] = points;
  return out;
}

}  // namespace

void read_shape_files(Json& scene, const std::string& folder, const std::string& display) {
  if (!scene.is_object() || !scene.contains("convex") || !scene["convex"].is_array()) return;
  const Json before = scene["convex"];
  const Json whole = scene;
  const config::Field bodies = config::Field(whole, display, "").at("convex");
  Json after = Json::array();
  for (std::size_t i = 0; i < before.size(); ++i) {
    const config::Field body = bodies.element(i);
    const bool from_file = body.json().is_object() && body.json().contains("stl");
    after.push_back(from_file ? with_points(body, folder) : body.json());
  }
  scene["convex"] = after;
}

}  // namespace liana::mission_runner
