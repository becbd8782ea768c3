#include <cmath>

#include "host/model/description/formats.hpp"
#include "host/model/description/xml.hpp"

namespace liana::description {
namespace {

constexpr double kCross_kg = 1e-6, kCross_kgm2 = 1e-9;

// Roll, pitch, yaw: turns about x, y, z of the outer frame, one after the other. Roll is read after yaw was taken off,
// so that both together are exact where only their difference is given.
Vec3 roll_pitch_yaw(const Quat& q) {
  const Vec3 x = rotate(q, {1.0, 0.0, 0.0}), y = rotate(q, {0.0, 1.0, 0.0}), z = rotate(q, {0.0, 0.0, 1.0});
  const double yaw = std::atan2(x[1], x[0]), c = std::cos(yaw), s = std::sin(yaw);
  const double pitch = std::atan2(-x[2], c * x[0] + s * x[1]);
  const double roll = std::atan2(s * z[0] - c * z[1], c * y[1] - s * y[0]);
  return {roll, pitch, yaw};
}

std::string origin(const Pose& pose) {
  return "<origin" + attribute("xyz", pose.position_m) + attribute("rpy", roll_pitch_yaw(pose.quaternion)) + "/>";
}

std::string inertial_text(const serial::LinkMass& mass) {
  using enum serial::InertiaElement;
  const auto& I = mass.inertia_kgm2;
  return "    <inertial>" + origin({mass.center_m, {1.0, 0.0, 0.0, 0.0}}) + "<mass" + attribute("value", mass.mass_kg) +
         "/><inertia" + attribute("ixx", I[kXx]) + attribute("ixy", I[kXy]) + attribute("ixz", I[kXz]) +
         attribute("iyy", I[kYy]) + attribute("iyz", I[kYz]) + attribute("izz", I[kZz]) + "/></inertial>\n";
}

std::string looks(const Pose& pose, const std::string& geometry, const std::string& name) {
  const std::string named = name.empty() ? "" : attribute("name", name);
  const std::string inside = origin(pose) + "<geometry>" + geometry + "</geometry>";
  return "    <visual" + named + ">" + inside + "</visual>\n    <collision" + named + ">" + inside + "</collision>\n";
}

std::string sphere(double radius_m) { return "<sphere" + attribute("radius", radius_m) + "/>"; }

// URDF has no capsules and no hulls: a cylinder with a ball at each end, and the box around.
std::string looks(const Shape& shape) {
  const Vec3& half = shape.half_m;
  const std::string box = "<box" + attribute("size", scale(half, 2.0)) + "/>";
  if (shape.kind == Shape::Kind::kBox || shape.kind == Shape::Kind::kHull) return looks(shape.pose, box, shape.name);
  if (shape.kind == Shape::Kind::kSphere) return looks(shape.pose, sphere(half[0]), shape.name);
  std::string text = looks(
      shape.pose, "<cylinder" + attribute("radius", half[0]) + attribute("length", 2.0 * half[2]) + "/>", shape.name);
  if (shape.kind == Shape::Kind::kCylinder) return text;
  for (const double end_m : {-half[2], half[2]})
    text += looks(compose(shape.pose, {{0.0, 0.0, end_m}, {1.0, 0.0, 0.0, 0.0}}), sphere(half[0]), shape.name);
  return text;
}

std::string link_text(const Link& link) {
  std::string inside;
  const bool moves = link.joint.kind != Joint::Kind::kFixed;
  if (link.mass.mass_kg > 0.0) {
    inside += inertial_text(link.mass);
  } else if (moves) {
    inside += inertial_text({kCross_kg, {}, {kCross_kgm2, kCross_kgm2, kCross_kgm2, 0.0, 0.0, 0.0}});
  }
  for (const Shape& shape : link.shapes) inside += looks(shape);
  return "  <link" + attribute("name", link.name) + (inside.empty() ? "/>\n" : ">\n" + inside + "  </link>\n");
}

std::string joint_text(const Link& link, const std::string& parent) {
  const Joint& joint = link.joint;
  const bool moves = joint.kind != Joint::Kind::kFixed;
  const char* const type = !moves ? "fixed" : joint.kind == Joint::Kind::kPrismatic ? "prismatic" : "revolute";
  std::string text = "  <joint" + attribute("name", moves ? joint.name : link.name + "_fixed") +
                     attribute("type", type) + ">\n    <parent" + attribute("link", parent) + "/><child" +
                     attribute("link", link.name) + "/>" + origin(link.origin) + "\n";
  if (moves) {
    text += "    <axis" + attribute("xyz", joint.axis) + "/><limit" + attribute("lower", joint.low) +
            attribute("upper", joint.high) + attribute("effort", joint.effort) + attribute("velocity", joint.rate) +
            "/><dynamics" + attribute("damping", joint.damping) + attribute("friction", joint.friction) + "/>\n";
  }
  if (!joint.mimics.empty())
    text += "    <mimic" + attribute("joint", joint.mimics) + " multiplier=\"1\" offset=\"0\"/>\n";
  return text + "  </joint>\n";
}

}  // namespace

std::string urdf(const RobotTree& tree, const std::vector<Shape>& scene) {
  std::string text = "<?xml version=\"1.0\"?>\n<robot" + attribute("name", tree.name) + ">\n";
  for (const Link& link : tree.links) text += link_text(link);
  for (std::size_t i = 1; i < tree.links.size(); ++i)
    text += joint_text(tree.links[i], tree.links[tree.links[i].parent].name);
  if (!scene.empty()) {
    const Link around{.name = "scene", .shapes = scene};
    text += link_text(around) + joint_text(around, "base");
  }
  return text + "</robot>\n";
}

}  // namespace liana::description
