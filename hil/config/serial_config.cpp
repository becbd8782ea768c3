#include "hil/config/serial_config.hpp"

#include <algorithm>
#include <numbers>

#include "hil/config/fields.hpp"
#include "hil/config/json_file.hpp"

namespace liana::bench {

namespace {

JointConfig read_joint(const JsonFile& file, const std::string& field) {
  JointConfig joint;
  joint.alpha_rad = kRadPerDeg * file.number(field + "/alpha_deg", -180.0, 180.0);
  joint.a_m = file.number(field + "/a_m", -20.0, 20.0);
  joint.d_m = file.number(field + "/d_m", -20.0, 20.0);
  if (file.has(field + "/offset_deg"))
    joint.offset_rad = kRadPerDeg * file.number(field + "/offset_deg", -360.0, 360.0);
  joint.low_rad = kRadPerDeg * file.number(field + "/low_deg", -720.0, 720.0);
  joint.high_rad = kRadPerDeg * file.number(field + "/high_deg", -720.0, 720.0);
  if (file.has(field + "/rate_deg_s")) joint.rate_rad_s = kRadPerDeg * file.number(field + "/rate_deg_s", 0.0, 1000.0);
  return joint;
}

BodyConfig read_body(const JsonFile& file, const std::string& field) {
  BodyConfig body;
  body.mass_kg = file.number(field + "/mass_kg", 0.01, 1e5);
  body.center_m = file.vector(field + "/center_m");
  const std::vector<double> inertia = file.numbers(field + "/inertia_kgm2", 6, -1e6, 1e6);
  std::copy(inertia.begin(), inertia.end(), body.inertia_kgm2.begin());
  return body;
}

// `where` is where in the file the robot is: empty, or the arm that carries it.
void read_joints(const JsonFile& file, const std::string& where, SerialRobotConfig& robot) {
  const std::string list = where + "/joints";
  const std::size_t count = file.size(list);
  if (count < 6 || count > 8) file.fail(list, "has " + std::to_string(count) + " entries, allowed is 6 to 8");
  for (std::size_t i = 0; i < count; ++i) {
    const std::string field = at(list, i);
    robot.joints.push_back(read_joint(file, field));
    if (file.has(at(list, 0) + "/link")) robot.links.push_back(read_body(file, field + "/link"));
    if (file.has(at(list, 0) + "/stiffness_Nm_per_rad"))
      robot.stiffness_Nm_rad.push_back(file.number(field + "/stiffness_Nm_per_rad", 1.0, 1e9));
  }
}

void read_mechanics(const JsonFile& file, const std::string& where, SerialRobotConfig& robot) {
  const std::string mass = where + "/mass", friction = where + "/friction";
  robot.link_radius_m = file.number(where + "/link_radius_m", 0.001, 5.0);
  if (robot.links.empty()) {
    robot.module_kg = file.number(mass + "/module_kg", 0.01, 1e5);
    robot.module_radius_m = file.number(mass + "/module_radius_m", 0.01, 5.0);
    robot.boom_kg = file.number(mass + "/boom_kg", 0.01, 1e5);
    if (file.has(mass + "/boom_radius_m")) robot.boom_radius_m = file.number(mass + "/boom_radius_m", 0.001, 5.0);
    robot.end_effector_kg = file.number(mass + "/end_effector_kg", 0.01, 1e5);
  }
  robot.coulomb_Nm = file.number(friction + "/coulomb_Nm", 0.0, 1e5);
  robot.viscous_Nms_per_rad = file.number(friction + "/viscous_Nms_per_rad", 0.0, 1e5);
  robot.rotor_inertia_kgm2 = file.number(friction + "/rotor_inertia_kgm2", 0.0, 1e5);
  if (file.has(friction + "/gear_damping_Nms_per_rad"))
    robot.gear_damping_Nms_per_rad = file.number(friction + "/gear_damping_Nms_per_rad", 0.0, 1e6);
}

void read_poses(const JsonFile& file, const std::string& where, SerialRobotConfig& robot) {
  const std::string poses = where + "/named_poses_deg";
  for (const auto& name : file.keys(poses)) {
    auto pose = file.numbers(poses + "/" + name, robot.joints.size(), -720.0, 720.0);
    for (auto& angle : pose) angle *= kRadPerDeg;
    robot.named_poses_rad[name] = pose;
  }
}

LockedBaseConfig read_base(const JsonFile& file) {
  LockedBaseConfig base;
  read_joints(file, "/base/robot", base.robot);
  read_mechanics(file, "/base/robot", base.robot);
  read_poses(file, "/base/robot", base.robot);
  if (base.robot.stiffness_Nm_rad.empty())
    file.fail("/base/robot/joints", "say no stiffness_Nm_per_rad; locked joints need it, add it to every one");
  const std::string pose = file.text("/base/pose");
  const auto found = base.robot.named_poses_rad.find(pose);
  if (found == base.robot.named_poses_rad.end())
    file.fail("/base/pose", "is \"" + pose + "\"; allowed is a name of its robot's named_poses_deg");
  base.joint_rad = found->second;
  base.damping_s = file.number("/base/damping_s", 0.0, 1.0);
  if (file.has("/base/carry_s")) base.carry_s = file.number("/base/carry_s", 1.0, 3600.0);
  return base;
}

// "position" or "torque".
bool is_torque(const JsonFile& file, const std::string& field) {
  const std::string mode = file.text(field);
  if (mode != "position" && mode != "torque")
    file.fail(field, "is \"" + mode + "\"; allowed are \"position\" and \"torque\"");
  return mode == "torque";
}

void read_drives(const JsonFile& file, SerialRobotConfig& robot) {
  constexpr double kMaxU32 = 4294967295.0;
  robot.counts_per_turn = static_cast<std::uint32_t>(file.integer("/drives/counts_per_turn", 256, 1 << 24));
  robot.gear = file.number("/drives/gear", 0.01, 1000.0);
  robot.servo_time_constant_s = file.number("/drives/servo_time_constant_s", 0.001, 1.0);
  robot.rated_torque_Nm = robot.peak_torque_Nm = file.number("/drives/rated_torque_Nm", 0.01, 4000.0);
  if (file.has("/drives/peak_torque_Nm"))
    robot.peak_torque_Nm = file.number("/drives/peak_torque_Nm", robot.rated_torque_Nm, 3.0 * robot.rated_torque_Nm);
  if (file.has("/drives/mode")) robot.is_torque_controlled = is_torque(file, "/drives/mode");
  robot.vendor = static_cast<std::uint32_t>(file.number("/drives/identity/vendor", 0.0, kMaxU32));
  robot.product = static_cast<std::uint32_t>(file.number("/drives/identity/product", 0.0, kMaxU32));
  robot.revision = static_cast<std::uint32_t>(file.number("/drives/identity/revision", 0.0, kMaxU32));
  const std::size_t count = robot.joints.size();
  const auto direction = file.numbers("/drives/direction", count, -1.0, 1.0);
  const auto zero = file.numbers("/drives/zero_counts", count, -1e9, 1e9);
  for (std::size_t i = 0; i < count; ++i) {
    if (direction[i] == 0.0) file.fail(at("/drives/direction", i), "is 0; allowed is -1 or 1");
    robot.drives.push_back({direction[i] > 0.0 ? 1 : -1, zero[i], static_cast<std::uint32_t>(kFirstSerial + i)});
    if (file.has("/drives/serials"))
      robot.drives[i].serial = static_cast<std::uint32_t>(file.number(at("/drives/serials", i), 1.0, kMaxU32));
  }
  for (const JointConfig& joint : robot.joints)
    robot.fastest_counts_per_s = std::max(robot.fastest_counts_per_s, joint.rate_rad_s / robot.rad_per_count());
}

}  // namespace

double SerialRobotConfig::rad_per_count() const { return 2.0 * std::numbers::pi / (counts_per_turn * gear); }

bool is_serial_robot(const std::string& path) {
  const JsonFile file(path, "");
  return file.has("/kind") && file.is_text("/kind") && file.text("/kind") == "serial";
}

SerialRobotConfig load_serial_robot(const std::string& path) {
  const JsonFile file(path, "serial");
  SerialRobotConfig robot;
  read_joints(file, "", robot);
  read_mechanics(file, "", robot);
  read_drives(file, robot);
  read_poses(file, "", robot);
  if (file.has("/base")) robot.base = std::make_shared<const LockedBaseConfig>(read_base(file));
  return robot;
}

}  // namespace liana::bench
