// The links of an arm as a tree of frames: what URDF, MJCF and ROS' tf each say in their own way.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "firmware_like/math/pose.hpp"
#include "firmware_like/serial/mass_table.hpp"
#include "host/model/config/config.hpp"
#include "host/model/config/serial_robot.hpp"

namespace liana::description {

// A primitive, or the hull of points, in the frame of a link [m].
struct Shape {
  enum class Kind { kBox, kSphere, kCylinder, kCapsule, kHull };
  std::string name{};
  Kind kind = Kind::kBox;
  Pose pose{};    // cylinders and capsules lie along its z
  Vec3 half_m{};  // box and hull (the box around it): half extents; else radius, radius, half the axis' length
  std::vector<Vec3> points_m{};  // of a hull, in the frame of the link
};

// How a link moves in the frame of its parent. Values are rad, of a slide m.
struct Joint {
  enum class Kind { kFixed, kRevolute, kPrismatic };
  Kind kind = Kind::kFixed;
  std::string name{};     // theta_1, theta_2, ... of joints that lead, as in joint_states
  std::string mimics{};   // the joint that it follows one to one; empty: it leads, or is fixed
  std::size_t theta = 0;  // which angle of the arm it follows, from 0
  Vec3 axis{};            // in the link's own frame
  double per_rad = 1.0;   // its value for each radian of the arm's angle: m of a slide
  double low = 0.0, high = 0.0, rate = 0.0;
  double effort = 0.0;  // N m, of a slide N
  double damping = 0.0, friction = 0.0, armature = 0.0;
  double stiffness = 0.0, rest = 0.0;  // of a spring in it
};

struct Link {
  std::string name{};
  std::size_t parent = 0;  // of the root itself
  Pose origin{};           // in the parent's frame, at value 0
  Joint joint{};
  serial::LinkMass mass{};  // in the link's frame; none: a cross between two axes, or a frame
  std::vector<Shape> shapes{};
};

// A place on a link through which a cable goes.
struct Hole {
  std::size_t link = 0;
  Vec3 point_m{};
};

// A cable from the first disc to its anchor, which its drive pulls through a spring.
struct Cable {
  std::string name{};  // cable_3, ... as drives are counted
  std::vector<Hole> holes{};
  double zero_length_m = 0.0, travel_m = 0.0;  // path at the zero pose, and at most so much more or less
  double stiffness_N_per_m = 0.0;
  double max_N = 0.0;
};

// A servo at a joint: a spring between what is commanded and where the joint is.
struct JointServo {
  std::string joint{};
  double low = 0.0, high = 0.0, stiffness = 0.0, max_effort = 0.0;
};

// A named pose of the table: values of all servos, then lengths of all cables, with which the arm stays there.
struct TreePose {
  std::vector<double> theta_rad{}, servo{}, cable_m{};
};

struct RobotTree {
  std::string name;
  std::vector<Link> links;  // each behind its parent; the first is "base", the last that moves carries "tip"
  std::vector<JointServo> servos;
  std::vector<Cable> cables;
  std::map<std::string, TreePose> poses;
  std::string start_pose;  // empty: the table does not say
  Vec3 gravity_m_s2{};
};

RobotTree tree_of(const config::RobotConfig& robot);
// A large arm that carries it is part of the base, locked as its table says.
RobotTree tree_of(const config::SerialRobotConfig& robot);
// Of a robot's JSON, of either kind, on its buses. Throws std::runtime_error as the loaders of config do.
RobotTree tree_of(const std::string& robot_json, const std::string& buses_json, const std::string& file);

// Values of all links' joints at these angles, 0 for fixed ones.
std::vector<double> joint_values(const RobotTree& tree, std::span<const double> theta_rad);

// Pose of a link in its parent's frame when its joint has this value.
Pose in_parent(const Link& link, double value);

// What does not move, in the base frame: named as in the scene.
std::vector<Shape> shapes_of(const config::SceneConfig& scene);

// Quaternion of the rotation whose rows are the axes of the body.
Quat quaternion_of_axes(const std::array<Vec3, 3>& axis);
// The shortest turn that takes z to this direction, of any length but 0.
Quat turn_from_z(const Vec3& along);

}  // namespace liana::description
