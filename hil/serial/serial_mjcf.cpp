#include "hil/serial/serial_mjcf.hpp"

#include <cmath>
#include <iomanip>
#include <ostream>
#include <sstream>

#include "hil/math/principal.hpp"

namespace liana::bench {

namespace {

void write_sphere(std::ostream& out, const char* pos, double radius_m, double mass_kg) {
  out << "<geom type='sphere' pos='" << pos << "' size='" << radius_m << "' mass='" << mass_kg << "'/>";
}

// A body's inertia where `frame` is its frame. MuJoCo would diagonalise a full tensor itself, to eight digits.
void write_inertia(std::ostream& out, const BodyConfig& body, const Pose& frame) {
  const auto& I = body.inertia_kgm2;
  const PrincipalAxes axes = principal_axes({{{I[0], I[3], I[4]}, {I[3], I[1], I[5]}, {I[4], I[5], I[2]}}});
  const Vec3 center = frame.position_m + rotate(frame.attitude, body.center_m);
  const Quat q = frame.attitude * axes.attitude;
  out << "<inertial mass='" << body.mass_kg << "' pos='" << center.x << ' ' << center.y << ' ' << center.z << "' quat='"
      << q.w << ' ' << q.x << ' ' << q.y << ' ' << q.z << "' diaginertia='" << axes.moment[0] << ' ' << axes.moment[1]
      << ' ' << axes.moment[2] << "'/>";
}

// From the frame that a joint turns to the one at the link's end.
Pose link_end(const JointConfig& joint) {
  return {{joint.a_m, 0.0, joint.d_m}, {std::cos(0.5 * joint.alpha_rad), std::sin(0.5 * joint.alpha_rad), 0.0, 0.0}};
}

// Joint i turns a body about its z axis; the next body sits at the end of the link.
void write_joint(std::ostream& out, const SerialRobotConfig& robot, std::size_t i, double armature_kgm2) {
  const JointConfig& joint = robot.joints[i];
  out << "<joint type='hinge' axis='0 0 1' armature='" << armature_kgm2 << "'/>";
  if (!robot.links.empty()) return write_inertia(out, robot.links[i], link_end(joint));
  write_sphere(out, "0 0 0", robot.module_radius_m, robot.module_kg);
  if (joint.a_m == 0.0) return;
  out << "<geom type='cylinder' fromto='0 0 " << joint.d_m << ' ' << joint.a_m << " 0 " << joint.d_m << "' size='"
      << robot.boom_radius_m << "' mass='" << robot.boom_kg << "'/>";
}

void open_body(std::ostream& out, const std::string& name, const Pose& at) {
  const Vec3& p = at.position_m;
  const Quat& q = at.attitude;
  out << "<body name='" << name << "' pos='" << p.x << ' ' << p.y << ' ' << p.z << "' quat='" << q.w << ' ' << q.x
      << ' ' << q.y << ' ' << q.z << "'>";
}

constexpr char kHead[] =
    "<mujoco><compiler angle='radian'/><option gravity='0 0 0'/><default><geom contype='0' conaffinity='0'/>"
    "</default><worldbody>\n";

// Bodies `prefix`link1, ..., `prefix`tip, one in the other; they stay open. Returns how many.
std::size_t write_chain(std::ostream& out, const SerialRobotConfig& robot, const std::string& prefix,
                        double armature_kgm2) {
  JointConfig before;  // the base
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    open_body(out, prefix + "link" + std::to_string(i + 1), link_end(before));
    write_joint(out, robot, i, armature_kgm2);
    out << '\n';
    before = robot.joints[i];
  }
  open_body(out, prefix + "tip", link_end(before));
  if (robot.links.empty()) write_sphere(out, "0 0 0", robot.module_radius_m, robot.end_effector_kg);
  return robot.joints.size() + 1;
}

std::string closed(std::ostringstream& out, std::size_t bodies) {
  for (std::size_t i = 0; i < bodies; ++i) out << "</body>";
  out << "\n</worldbody></mujoco>\n";
  return out.str();
}

}  // namespace

std::string make_serial_mjcf(const SerialRobotConfig& robot) {
  std::ostringstream out;
  out << std::setprecision(17) << kHead;
  const std::size_t bodies = write_chain(out, robot, "", robot.rotor_inertia_kgm2);
  return closed(out, bodies);
}

std::string make_mjcf_with_base(const SerialRobotConfig& robot, const BodyConfig& payload) {
  std::ostringstream out;
  out << std::setprecision(17) << kHead;
  std::size_t bodies = 0;
  if (robot.base) bodies += write_chain(out, robot.base->robot, "base_", 0.0);
  bodies += write_chain(out, robot, "", 0.0);
  if (payload.mass_kg > 0.0) {
    out << "<body name='payload'>";
    write_inertia(out, payload, {});
    out << "</body>";
  }
  return closed(out, bodies);
}

}  // namespace liana::bench
