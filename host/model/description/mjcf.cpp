#include <algorithm>

#include "host/model/description/formats.hpp"
#include "host/model/description/xml.hpp"

namespace liana::description {
namespace {

// Semi-implicit in all velocities: the damping of the joints would need a shorter step otherwise.
constexpr char kOption[] = " timestep=\"0.001\" integrator=\"implicit\"";

// As stiff as MuJoCo has them: crosses weigh little, and cables pull hard. Its own values let the modules of a segment
// turn each for itself.
constexpr char kStiffCouplings[] = "<equality solref=\"0.002 1\" solimp=\"0.9999 0.9999 0.001\"/>\n";

std::string place(const Pose& pose) { return attribute("pos", pose.position_m) + attribute("quat", pose.quaternion); }

std::string geom(const Shape& shape, const std::string& name, const char* role) {
  const Vec3& half = shape.half_m;
  std::string text = "<geom" + (name.empty() ? "" : attribute("name", name)) + attribute("class", role);
  switch (shape.kind) {
    case Shape::Kind::kHull:
      return text + " type=\"mesh\"" + attribute("mesh", name) + "/>\n";
    case Shape::Kind::kBox:
      return text + " type=\"box\"" + attribute("size", half) + place(shape.pose) + "/>\n";
    case Shape::Kind::kSphere:
      return text + " type=\"sphere\"" + attribute("size", half[0]) + place(shape.pose) + "/>\n";
    default:
      break;
  }
  const char* const type = shape.kind == Shape::Kind::kCapsule ? "capsule" : "cylinder";
  const double size[]{half[0], half[2]};
  return text + attribute("type", type) + attribute("size", size) + place(shape.pose) + "/>\n";
}

// Names of a scene's bodies need not differ, those of MJCF must.
std::string scene_name(const std::vector<Shape>& scene, std::size_t i) {
  return "scene_" + std::to_string(i + 1) + "_" + scene[i].name;
}

std::string inertial(const serial::LinkMass& mass) {
  return "<inertial" + attribute("pos", mass.center_m) + attribute("mass", mass.mass_kg) +
         attribute("fullinertia", mass.inertia_kgm2) + "/>\n";
}

std::string joint_text(const Joint& joint) {
  const double range[]{joint.low, joint.high};
  std::string text = "<joint" + attribute("name", joint.name) +
                     attribute("type", joint.kind == Joint::Kind::kPrismatic ? "slide" : "hinge") +
                     attribute("axis", joint.axis) + attribute("range", range);
  const auto given = [&](const char* name, double value) {
    if (value != 0.0) text += attribute(name, value);
  };
  given("damping", joint.damping);
  given("frictionloss", joint.friction);
  given("armature", joint.armature);
  given("stiffness", joint.stiffness);
  given("springref", joint.rest);
  return text + "/>\n";
}

// The links as bodies one in the other, in the order of the tree: so joints stand in that order, too.
class Bodies {
 public:
  explicit Bodies(const RobotTree& tree) : tree_(tree), children_(tree.links.size()), sites_(tree.links.size()) {
    for (std::size_t i = 1; i < tree.links.size(); ++i) children_[tree.links[i].parent].push_back(i);
    for (const Cable& cable : tree.cables) {
      for (std::size_t h = 0; h < cable.holes.size(); ++h)
        sites_[cable.holes[h].link] +=
            "<site" + attribute("name", hole_name(cable, h)) + attribute("pos", cable.holes[h].point_m) + "/>\n";
    }
  }
  static std::string hole_name(const Cable& cable, std::size_t hole) {
    return cable.name + "_hole_" + std::to_string(hole + 1);
  }
  std::string text() const { return sites_[0] + inside_of(0); }

 private:
  std::string inside_of(std::size_t link) const {
    std::string text;
    for (const std::size_t child : children_[link]) text += body(child, "", tree_.links[child].origin);
    return text;
  }
  // A link without mass that moves is an axis of the body behind it, whose frame it shares: MuJoCo refuses it as a
  // body.
  std::string body(std::size_t i, const std::string& joints_before, const Pose& origin) const {
    const Link& link = tree_.links[i];
    const bool moves = link.joint.kind != Joint::Kind::kFixed;
    const std::string joints = joints_before + (moves ? joint_text(link.joint) : "");
    if (moves && link.mass.mass_kg == 0.0) return body(children_[i].front(), joints, origin);
    std::string text = "<body" + attribute("name", link.name) + place(origin) + ">\n" + joints;
    if (link.mass.mass_kg > 0.0) text += inertial(link.mass);
    for (const Shape& shape : link.shapes) text += geom(shape, "", "arm");
    if (link.name == "tip") text += "<site name=\"tip\"/>\n";
    return text + sites_[i] + inside_of(i) + "</body>\n";
  }

  const RobotTree& tree_;
  std::vector<std::vector<std::size_t>> children_;
  std::vector<std::string> sites_;
};

std::string assets(const std::vector<Shape>& scene) {
  std::string text;
  for (std::size_t i = 0; i < scene.size(); ++i) {
    if (scene[i].kind != Shape::Kind::kHull) continue;
    text += "<mesh" + attribute("name", scene_name(scene, i)) + " vertex=\"";
    for (const Vec3& point : scene[i].points_m) text += numbers(point) + "  ";
    text += "\"/>\n";
  }
  return text.empty() ? "" : "<asset>\n" + text + "</asset>\n";
}

std::string tendons(const RobotTree& tree) {
  std::string text;
  for (const Cable& cable : tree.cables) {
    text += "<spatial" + attribute("name", cable.name) + ">";
    for (std::size_t h = 0; h < cable.holes.size(); ++h)
      text += "<site" + attribute("site", Bodies::hole_name(cable, h)) + "/>";
    text += "</spatial>\n";
  }
  return text.empty() ? "" : "<tendon>\n" + text + "</tendon>\n";
}

std::string couplings(const RobotTree& tree) {
  std::string text;
  for (const Link& link : tree.links) {
    if (!link.joint.mimics.empty())
      text += "<joint" + attribute("joint1", link.joint.name) + attribute("joint2", link.joint.mimics) + "/>\n";
  }
  return text.empty() ? "" : "<equality>\n" + text + "</equality>\n";
}

// A servo is a spring to what is commanded; a cable is one that only pulls.
std::string actuators(const RobotTree& tree) {
  std::string text;
  for (const JointServo& servo : tree.servos) {
    const double range[]{servo.low, servo.high}, force[]{-servo.max_effort, servo.max_effort};
    text += "<position" + attribute("name", servo.joint) + attribute("joint", servo.joint) +
            attribute("kp", servo.stiffness) + attribute("ctrlrange", range) + attribute("forcerange", force) + "/>\n";
  }
  for (const Cable& cable : tree.cables) {
    const double range[]{cable.zero_length_m - cable.travel_m, cable.zero_length_m + cable.travel_m};
    const double force[]{-cable.max_N, 0.0};
    text += "<position" + attribute("name", cable.name) + attribute("tendon", cable.name) +
            attribute("kp", cable.stiffness_N_per_m) + attribute("ctrlrange", range) + attribute("forcerange", force) +
            "/>\n";
  }
  return "<actuator>\n" + text + "</actuator>\n";
}

// The values of a pose in the order in which MuJoCo has the joints: that of the tree.
std::string key(const RobotTree& tree, const std::string& name) {
  const TreePose& pose = tree.poses.at(name);
  const std::vector<double> values = joint_values(tree, pose.theta_rad);
  std::vector<double> position, control = pose.servo;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (tree.links[i].joint.kind != Joint::Kind::kFixed) position.push_back(values[i]);
  }
  control.insert(control.end(), pose.cable_m.begin(), pose.cable_m.end());
  return "<key" + attribute("name", name) + attribute("qpos", position) + attribute("ctrl", control) + "/>\n";
}

std::string keys(const RobotTree& tree) {
  std::vector<std::string> names;
  for (const auto& [name, pose] : tree.poses) names.push_back(name);
  std::stable_partition(names.begin(), names.end(), [&](const auto& name) { return name == tree.start_pose; });
  std::string text = "<keyframe>\n";
  for (const std::string& name : names) text += key(tree, name);
  return text + "</keyframe>\n";
}

}  // namespace

std::string mjcf(const RobotTree& tree, const std::vector<Shape>& scene) {
  std::string around;
  for (std::size_t i = 0; i < scene.size(); ++i) around += geom(scene[i], scene_name(scene, i), "scene");
  // The arm touches the scene, never itself.
  return "<mujoco" + attribute("model", tree.name) + ">\n<compiler angle=\"radian\" autolimits=\"true\"/>\n<option" +
         attribute("gravity", tree.gravity_m_s2) + kOption + "/>\n" +
         "<default>\n"
         "<default class=\"arm\"><geom contype=\"1\" conaffinity=\"0\" rgba=\"0.25 0.45 0.75 1\"/></default>\n"
         "<default class=\"scene\"><geom contype=\"0\" conaffinity=\"1\" rgba=\"0.6 0.62 0.66 0.5\"/></default>\n"
         "<site size=\"0.002\"/>\n" +
         kStiffCouplings + "</default>\n" + assets(scene) + "<worldbody>\n<light pos=\"0 0 5\" dir=\"0 0 -1\"/>\n" +
         around + Bodies(tree).text() + "</worldbody>\n" + tendons(tree) + couplings(tree) + actuators(tree) +
         keys(tree) + "</mujoco>\n";
}

}  // namespace liana::description
