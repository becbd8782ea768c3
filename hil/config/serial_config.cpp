#include "hil/config/serial_config.hpp"

#include <algorithm>

#include "hil/config/json_file.hpp"

namespace liana::bench {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kRadPerDeg = kPi / 180.0;
constexpr std::size_t kFirstSerial = 1001;  // of simulated drives, where the table has none: 1000 + node id

std::string at(const std::string& list, std::size_t i) { return list + "/" + std::to_string(i); }

void read_joints(const JsonFile& file, SerialRobotConfig& robot) {
  const std::size_t count = file.size("/joints");
  if (count < 6 || count > 8) file.fail("/joints", "has " + std::to_string(count) + " entries, allowed is 6 to 8");
  for (std::size_t i = 0; i < count; ++i) {
    const std::string field = at("/joints", i);
    JointConfig joint;
    joint.alpha_rad = kRadPerDeg * file.number(field + "/alpha_deg", -180.0, 180.0);
    joint.a_m = file.number(field + "/a_m", -20.0, 20.0);
    joint.d_m = file.number(field + "/d_m", -20.0, 20.0);
    if (file.has(field + "/offset_deg"))
      joint.offset_rad = kRadPerDeg * file.number(field + "/offset_deg", -360.0, 360.0);
    joint.low_rad = kRadPerDeg * file.number(field + "/low_deg", -720.0, 720.0);
    joint.high_rad = kRadPerDeg * file.number(field + "/high_deg", -720.0, 720.0);
    if (file.has(field + "/rate_deg_s"))
      joint.rate_rad_s = kRadPerDeg * file.number(field + "/rate_deg_s", 0.0, 1000.0);
    robot.joints.push_back(joint);
  }
}

void read_mechanics(const JsonFile& file, SerialRobotConfig& robot) {
  robot.module_kg = file.number("/mass/module_kg", 0.01, 1e5);
  robot.module_radius_m = file.number("/mass/module_radius_m", 0.01, 5.0);
  robot.boom_kg = file.number("/mass/boom_kg", 0.01, 1e5);
  robot.end_effector_kg = file.number("/mass/end_effector_kg", 0.01, 1e5);
  robot.coulomb_Nm = file.number("/friction/coulomb_Nm", 0.0, 1e5);
  robot.viscous_Nms_per_rad = file.number("/friction/viscous_Nms_per_rad", 0.0, 1e5);
  robot.rotor_inertia_kgm2 = file.number("/friction/rotor_inertia_kgm2", 0.0, 1e5);
}

void read_drives(const JsonFile& file, SerialRobotConfig& robot) {
  constexpr double kMaxU32 = 4294967295.0;
  robot.counts_per_turn = static_cast<std::uint32_t>(file.integer("/drives/counts_per_turn", 256, 1 << 24));
  robot.gear = file.number("/drives/gear", 0.01, 1000.0);
  robot.servo_time_constant_s = file.number("/drives/servo_time_constant_s", 0.001, 1.0);
  robot.rated_torque_Nm = file.number("/drives/rated_torque_Nm", 0.01, 4000.0);
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

double SerialRobotConfig::rad_per_count() const { return 2.0 * kPi / (counts_per_turn * gear); }

bool is_serial_robot(const std::string& path) {
  const JsonFile file(path, "");
  return file.has("/kind") && file.is_text("/kind") && file.text("/kind") == "serial";
}

SerialRobotConfig load_serial_robot(const std::string& path) {
  const JsonFile file(path, "serial");
  SerialRobotConfig robot;
  read_joints(file, robot);
  read_mechanics(file, robot);
  read_drives(file, robot);
  for (const auto& name : file.keys("/named_poses_deg")) {
    auto pose = file.numbers("/named_poses_deg/" + name, robot.joints.size(), -720.0, 720.0);
    for (auto& angle : pose) angle *= kRadPerDeg;
    robot.named_poses_rad[name] = pose;
  }
  return robot;
}

}  // namespace liana::bench
