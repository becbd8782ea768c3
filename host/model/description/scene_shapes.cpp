// A scene's bodies as shapes in the base frame.
#include "host/model/description/robot_tree.hpp"
#include "host/model/simulation/serial_model.hpp"

namespace liana::description {
namespace {

constexpr Quat kUnturned{1.0, 0.0, 0.0, 0.0};

Shape sphere(const std::string& name, const Vec3& center_m, double radius_m) {
  return {name, Shape::Kind::kSphere, {center_m, kUnturned}, {radius_m, radius_m, radius_m}};
}

// Two points with a disc or a ball around them, or the hull of points.
Shape convex(const config::SceneConvex& body) {
  if (body.disc_radius_m == 0.0 && body.round_m == 0.0)
    return {body.name, Shape::Kind::kHull, {body.center_m, kUnturned}, body.half_extent_m, body.points_m};
  const Vec3 &from = body.points_m.front(), &to = body.points_m.back();
  const Vec3 along = subtract(to, from), middle = scale(add(from, to), 0.5);
  const double length_m = norm(along), radius_m = body.disc_radius_m + body.round_m;
  if (length_m == 0.0) return sphere(body.name, middle, radius_m);
  return {body.name,
          body.round_m > 0.0 ? Shape::Kind::kCapsule : Shape::Kind::kCylinder,
          {middle, turn_from_z(along)},
          {radius_m, radius_m, 0.5 * length_m}};
}

Shape payload_shape(const config::ScenePayload& payload) {
  const simulation::CarriedBody body = simulation::carried_body(payload);
  const Pose grapple{payload.pose.position_m, payload.pose.quaternion_wxyz};
  const Pose middle{{0.0, 0.0, 0.5 * (body.from_m + body.to_m)}, kUnturned};
  return {"payload",
          Shape::Kind::kCapsule,
          compose(grapple, middle),
          {body.radius_m, body.radius_m, 0.5 * (body.to_m - body.from_m)}};
}

}  // namespace

std::vector<Shape> shapes_of(const config::SceneConfig& scene) {
  std::vector<Shape> shapes;
  for (const config::SceneBox& box : scene.boxes)
    shapes.push_back(
        {box.name, Shape::Kind::kBox, {box.center_m, quaternion_of_axes(box.rotation)}, box.half_extent_m});
  for (const config::SceneSphere& ball : scene.spheres)
    shapes.push_back(sphere(ball.name, ball.center_m, ball.radius_m));
  for (const config::SceneConvex& body : scene.convex) shapes.push_back(convex(body));
  if (scene.rod) shapes.push_back(sphere("rod", scene.rod->pose.position_m, scene.rod->radius_m));
  if (scene.payload) shapes.push_back(payload_shape(*scene.payload));
  return shapes;
}

}  // namespace liana::description
