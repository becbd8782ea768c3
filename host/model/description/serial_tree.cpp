// A serial arm: a revolute joint about z for each row of its table, and the arm that carries it as part of its base.
#include <cmath>

#include "firmware_like/math/trig.hpp"
#include "firmware_like/serial/kinematics.hpp"
#include "host/base/json/json.hpp"
#include "host/model/description/robot_tree.hpp"

namespace liana::description {
namespace {

constexpr double kServo_rad = kDegree;  // of a table without stiffness: so far off, a drive gives its largest torque

Pose turned(double angle_rad, const Vec3& axis) {
  const Vec3 turn = scale(axis, std::sin(0.5 * angle_rad));
  return {{}, {std::cos(0.5 * angle_rad), turn[0], turn[1], turn[2]}};
}

// From the frame that a joint turns to the one at its link's end.
Pose link_end(const serial::DhRow& row) {
  return {{row.a_m, 0.0, row.d_m}, turned(row.alpha_rad, {1.0, 0.0, 0.0}).quaternion};
}

// A link's two straight pieces, along the joint's axis and along x.
std::vector<Shape> pieces(const serial::DhRow& row, double radius_m) {
  std::vector<Shape> shapes;
  const auto piece = [&](const Vec3& middle_m, const Vec3& along_m) {
    if (norm(along_m) == 0.0) return;
    shapes.push_back(
        {"", Shape::Kind::kCylinder, {middle_m, turn_from_z(along_m)}, {radius_m, radius_m, 0.5 * norm(along_m)}});
  };
  piece({0.0, 0.0, 0.5 * row.d_m}, {0.0, 0.0, row.d_m});
  piece({0.5 * row.a_m, 0.0, row.d_m}, {row.a_m, 0.0, 0.0});
  return shapes;
}

// The links of an arm behind the newest link of the tree, as the table has them with all joints at 0.
void add_links(const serial::RobotParams& table, const serial::MassTable& masses, double radius_m,
               const std::string& prefix, RobotTree& tree) {
  Pose end{};
  for (std::size_t i = 0; i < table.joints(); ++i) {
    const serial::DhRow& row = table.joint[i].dh;
    Link link{.name = prefix + "link_" + std::to_string(i + 1), .parent = tree.links.size() - 1};
    link.origin = compose(end, turned(row.offset_rad, {0.0, 0.0, 1.0}));
    end = link_end(row);
    link.mass = serial::moved(masses.link[i], end);
    link.shapes = pieces(row, radius_m);
    tree.links.push_back(std::move(link));
  }
  tree.links.push_back({.name = prefix + "tip", .parent = tree.links.size() - 1, .origin = end});
}

// The arm below, locked: its first link is where it stands as seen from this arm's base, the tip of the one below.
void add_carrier(const config::LockedBase& below, RobotTree& tree) {
  const std::size_t first = tree.links.size();
  add_links(below.table, below.masses, below.link_radius_m, below.name + "_", tree);
  for (std::size_t i = 0; i < below.table.joints(); ++i)
    tree.links[first + i].origin = compose(tree.links[first + i].origin, turned(below.joint_rad[i], {0.0, 0.0, 1.0}));
  const Pose root = inverse(serial::forward_kinematics(below.table, below.joint_rad).tip_in_base);
  tree.links[first].origin = compose(root, tree.links[first].origin);
}

// What only simulators need of joints; the loader has checked it.
struct Friction {
  double coulomb_Nm = 0.0, viscous_Nms_per_rad = 0.0, rotor_inertia_kgm2 = 0.0;
};
Friction friction_of(const config::SerialRobotConfig& robot) {
  const Json friction = Json::parse(robot.canonical_json).at("friction");
  return {friction.at("coulomb_Nm").get<double>(), friction.at("viscous_Nms_per_rad").get<double>(),
          friction.at("rotor_inertia_kgm2").get<double>()};
}

}  // namespace

RobotTree tree_of(const config::SerialRobotConfig& robot) {
  RobotTree tree;
  tree.name = robot.name;
  tree.start_pose = robot.start_pose;
  tree.links.push_back({.name = "base"});
  if (robot.base) add_carrier(*robot.base, tree);
  const std::size_t first = tree.links.size();
  add_links(robot.table, robot.masses, robot.link_radius_m, "", tree);
  tree.links[first].parent = 0;
  const Friction friction = friction_of(robot);
  for (std::size_t i = 0; i < robot.table.joints(); ++i) {
    const serial::JointParams& row = robot.table.joint[i];
    Joint& joint = tree.links[first + i].joint;
    joint = {.kind = Joint::Kind::kRevolute,
             .name = "theta_" + std::to_string(i + 1),
             .theta = i,
             .axis = {0.0, 0.0, 1.0},
             .low = row.low_rad,
             .high = row.high_rad,
             .rate = row.rate_rad_s,
             .effort = robot.peak_torque_Nm,
             .damping = friction.viscous_Nms_per_rad,
             .friction = friction.coulomb_Nm,
             .armature = friction.rotor_inertia_kgm2};
    const double stiffness =
        robot.stiffness_Nm_rad.empty() ? robot.peak_torque_Nm / kServo_rad : robot.stiffness_Nm_rad[i];
    tree.servos.push_back({joint.name, joint.low, joint.high, stiffness, joint.effort});
  }
  for (const auto& [name, joint_deg] : robot.named_poses_deg) {
    TreePose& pose = tree.poses[name];
    for (const double each_deg : joint_deg) pose.theta_rad.push_back(each_deg * kDegree);
    pose.servo = pose.theta_rad;
  }
  return tree;
}

}  // namespace liana::description
