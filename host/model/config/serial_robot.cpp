// Serial robots: joints, drives, limits and poses read one by one, then put together with the buses.
#include "host/model/config/serial_robot.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "firmware_like/serial/kinematics.hpp"
#include "host/model/config/canonical.hpp"
#include "host/model/config/robot_parts.hpp"
#include "host/model/config/serial_mass.hpp"
#include "host/model/config/serial_torque.hpp"

namespace liana::config {
namespace {

using serial::JointParams;

constexpr double kShortest_m = 0.01;  // of all links together
constexpr double kMaxAngle_deg = 720.0;
constexpr double kMaxCounts = 2e9;  // what fits into the 32 bits of a drive's position, with room for a target beyond

JointParams read_joint(const Field& field) {
  field.only({"alpha_deg", "a_m", "d_m", "offset_deg", "low_deg", "high_deg", "rate_deg_s", "accel_deg_s2",
              "stiffness_Nm_per_rad", "link"});
  JointParams joint;
  joint.dh.alpha_rad = field.at("alpha_deg").number({-180, 180}) * kDegree;
  joint.dh.a_m = field.at("a_m").number({-20, 20});
  joint.dh.d_m = field.at("d_m").number({-20, 20});
  if (field.json().contains("offset_deg")) joint.dh.offset_rad = field.at("offset_deg").number({-360, 360}) * kDegree;
  const double low_deg = field.at("low_deg").number({-kMaxAngle_deg, kMaxAngle_deg - 1});
  joint.low_rad = low_deg * kDegree;
  joint.high_rad = field.at("high_deg").number({low_deg + 1, kMaxAngle_deg}) * kDegree;
  joint.rate_rad_s = field.at("rate_deg_s").number({0.001, 360}) * kDegree;
  joint.accel_rad_s2 = field.at("accel_deg_s2").number({0.001, 10000}) * kDegree;
  return joint;
}

// Of every joint or of none: a compliance of some joints is none of the arm.
void read_stiffness(const Field& joints, std::size_t count, SerialRobotConfig& out) {
  const char* const key = "stiffness_Nm_per_rad";
  for (std::size_t i = 0; i < count; ++i) {
    if (joints.element(i).json().contains(key) != joints.element(0).json().contains(key))
      joints.element(i).refuse("stiffness_Nm_per_rad at every joint or at none",
                               "add it here, or leave it out elsewhere");
    if (joints.element(i).json().contains(key))
      out.stiffness_Nm_rad.push_back(joints.element(i).at(key).number({1, 1e9}));
  }
}

void read_joints(const Field& joints, SerialRobotConfig& out) {
  const std::size_t count = joints.size(6, serial::kMaxJoints,
                                        "6 joints reach any pose; this build holds at most 8 "
                                        "(kMaxJoints)");
  out.table.joint_count = static_cast<std::int32_t>(count);
  for (std::size_t i = 0; i < count; ++i) out.table.joint[i] = read_joint(joints.element(i));
  if (serial::chain_length_m(out.table) < kShortest_m)
    joints.refuse("links that are 10 mm long or more together", "give a_m and d_m as they are built");
  read_stiffness(joints, count, out);
}

// Numbers that only the bench needs.
void check_friction(const Field& friction) {
  friction.only({"coulomb_Nm", "viscous_Nms_per_rad", "rotor_inertia_kgm2", "gear_damping_Nms_per_rad"});
  for (const char* name : {"coulomb_Nm", "viscous_Nms_per_rad", "rotor_inertia_kgm2"})
    friction.at(name).number({0, 1e5});
  if (friction.json().contains("gear_damping_Nms_per_rad")) friction.at("gear_damping_Nms_per_rad").number({0, 1e6});
}

// Counts at both ends of every joint's range have to be numbers that a drive can hold.
void check_counts(const Field& zero, const SerialRobotConfig& out, std::size_t i) {
  const JointParams& joint = out.table.joint[i];
  const double farthest_rad = std::max(std::fabs(joint.low_rad), std::fabs(joint.high_rad));
  const double most = std::fabs(out.table.drive[i].zero_counts) + farthest_rad / out.table.drive[i].rad_per_count;
  if (most > kMaxCounts) {
    zero.element(i).refuse("positions of the joint's whole range within 2000000000 counts",
                           "choose another zero, or an encoder with fewer counts per turn");
  }
}

void read_drive_lists(const Field& drives, SerialRobotConfig& out) {
  const std::size_t count = out.table.joints();
  const Field direction = drives.at("direction"), zero = drives.at("zero_counts");
  direction.size(count, count, "one entry per joint, from the base to the tip");
  zero.size(count, count, "one entry per joint, from the base to the tip");
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t sign = direction.element(i).integer(-1, 1);
    if (sign == 0) direction.element(i).refuse("1 or -1", "1 when counts grow with the joint angle");
    out.table.drive[i].direction = static_cast<std::int32_t>(sign);
    out.table.drive[i].zero_counts = static_cast<std::int32_t>(zero.element(i).integer(-1000000000, 1000000000));
    out.table.drive[i].rad_per_count = 2.0 * std::numbers::pi / (out.counts_per_turn * out.gear);
    out.table.drive[i].torque_per_permille_Nm = out.rated_torque_Nm / 1000.0;
    check_counts(zero, out, i);
  }
}

void read_joint_drives(const Field& drives, SerialRobotConfig& out) {
  drives.only({"counts_per_turn", "gear", "servo_time_constant_s", "rated_torque_Nm", "peak_torque_Nm", "identity",
               "direction", "zero_counts", "serials", "calibration_days", "mode", "position_gain_per_s"});
  out.counts_per_turn = static_cast<std::uint32_t>(drives.at("counts_per_turn").integer(256, 16777216));
  out.gear = drives.at("gear").number({0.01, 1000});
  out.table.servo_time_constant_s = drives.at("servo_time_constant_s").number({0.001, 1});
  out.rated_torque_Nm = drives.at("rated_torque_Nm").number({0.01, 4000});
  const bool says_peak = drives.json().contains("peak_torque_Nm");
  out.peak_torque_Nm = says_peak ? drives.at("peak_torque_Nm").number({out.rated_torque_Nm, 3.0 * out.rated_torque_Nm})
                                 : out.rated_torque_Nm;
  out.identity = read_identity(drives.at("identity"));
  out.calibration_days = read_calibration_days(drives);
  read_drive_lists(drives, out);
  out.drive_serials = read_serials(drives, out.table.joints());
}

void read_tip_limits(const Field& field, serial::TipLimits& tip) {
  field.only({"tip_speed_m_s", "tip_accel_m_s2", "tip_jerk_m_s3", "tip_rate_deg_s", "tip_angular_accel_deg_s2",
              "tip_angular_jerk_deg_s3"});
  tip.speed_m_s = field.at("tip_speed_m_s").number({0.0001, 2});
  tip.accel_m_s2 = field.at("tip_accel_m_s2").number({0.0001, 50});
  tip.jerk_m_s3 = field.at("tip_jerk_m_s3").number({0.001, 1000});
  tip.rate_rad_s = field.at("tip_rate_deg_s").number({0.001, 360}) * kDegree;
  tip.angular_accel_rad_s2 = field.at("tip_angular_accel_deg_s2").number({0.001, 10000}) * kDegree;
  tip.angular_jerk_rad_s3 = field.at("tip_angular_jerk_deg_s3").number({0.001, 100000}) * kDegree;
}

void read_poses(const Field& field, SerialRobotConfig& out) {
  const std::size_t joints = out.table.joints();
  for (const auto& [name, list] : field.json().items()) {
    const Field pose = field.at(name);
    pose.size(joints, joints, "give every joint's angle in degrees, from the base to the tip");
    std::vector<double> joint_deg;
    for (std::size_t i = 0; i < joints; ++i) {
      const JointParams& joint = out.table.joint[i];
      joint_deg.push_back(pose.element(i).number({joint.low_rad / kDegree, joint.high_rad / kDegree}));
    }
    out.named_poses_deg.emplace(name, joint_deg);
  }
  if (out.named_poses_deg.empty()) field.refuse("at least one pose", "name the pose that a run starts from");
}

// The robot without what the buses decide (tick, T_c), and without its base.
SerialRobotConfig read_arm_alone(const Field& table) {
  check_kind(table, "serial");
  table.only({"format", "kind", "name", "joints", "link_radius_m", "mass", "friction", "drives", "limits",
              "named_poses_deg", "start_pose", "base", "force_control"});
  SerialRobotConfig out;
  out.name = table.at("name").name(40);
  read_joints(table.at("joints"), out);
  out.link_radius_m = table.at("link_radius_m").number({0.001, 2});
  out.masses = read_masses(table, out.table);
  check_friction(table.at("friction"));
  read_joint_drives(table.at("drives"), out);
  read_torque(table, out);
  read_tip_limits(table.at("limits"), out.table.tip);
  read_poses(table.at("named_poses_deg"), out);
  out.start_pose = read_start_pose(table, out.named_poses_deg);
  return out;
}

LockedBase read_base(const Field& field) {
  field.only({"robot", "pose", "damping_s", "carry_s"});
  const Field robot = field.at("robot");
  if (robot.json().contains("base"))
    robot.at("base").refuse("no base of a base", "lock the joints of one arm, the one that carries");
  const SerialRobotConfig carrier = read_arm_alone(robot);
  if (carrier.stiffness_Nm_rad.empty())
    robot.at("joints").refuse("stiffness_Nm_per_rad at every joint", "say how its locked joints give way");
  LockedBase base;
  base.name = carrier.name;
  base.table = carrier.table;
  base.masses = carrier.masses;
  base.link_radius_m = carrier.link_radius_m;
  std::copy(carrier.stiffness_Nm_rad.begin(), carrier.stiffness_Nm_rad.end(), base.stiffness_Nm_rad.begin());
  std::vector<std::string> names;
  for (const auto& [name, joint_deg] : carrier.named_poses_deg) {
    names.push_back(name);
    serial::JointVector& joint_rad = base.named_poses_rad[name];
    for (std::size_t i = 0; i < joint_deg.size(); ++i) joint_rad[i] = joint_deg[i] * kDegree;
  }
  base.joint_rad = base.named_poses_rad.at(field.at("pose").choice(names));
  field.at("damping_s").number({0, 1});  // for the bench
  if (field.json().contains("carry_s")) base.carry_s = field.at("carry_s").number({1, 3600});
  return base;
}

SerialRobotConfig read_serial_robot(const Json& json, const std::string& file) {
  const Field table(json, file, "");
  SerialRobotConfig out = read_arm_alone(table);
  if (json.contains("base")) out.base = read_base(table.at("base"));
  out.canonical_json = canonical_json(json);
  return out;
}

constexpr double kQuickest = 35.0 / 16.0;  // of the way that the arm below takes, beside its mean rate

}  // namespace

bool is_carried(const SerialRobotConfig& robot, const SceneConfig& scene) {
  return robot.base && scene.payload && !scene.payload->on_arm && !scene.payload->fetch_pose.empty();
}

std::string why_not_carried(const SerialRobotConfig& robot, const SceneConfig& scene) {
  if (!is_carried(robot, scene)) return "";
  const LockedBase& base = *robot.base;
  const std::string what = "payload.fetch_pose: \"" + scene.payload->fetch_pose + "\": ";
  const auto from = base.named_poses_rad.find(scene.payload->fetch_pose);
  if (from == base.named_poses_rad.end()) {
    std::string names;
    for (const auto& [name, joint_rad] : base.named_poses_rad) names += (names.empty() ? "" : ", ") + name;
    return what + "allowed a pose of robot " + base.name + ", which carries this one: " + names + ": name one of them";
  }
  double least_s = 1.0;
  for (std::size_t i = 0; i < base.table.joints(); ++i)
    least_s =
        std::fmax(least_s, kQuickest * std::fabs(base.joint_rad[i] - from->second[i]) / base.table.joint[i].rate_rad_s);
  if (base.carry_s >= least_s) return "";
  const std::string now = base.carry_s > 0.0 ? std::to_string(static_cast<int>(base.carry_s)) + " s" : "missing";
  return what + "base.carry_s of robot " + robot.name + ": " + now + ": allowed from " +
         std::to_string(static_cast<int>(std::ceil(least_s))) + " to 3600 s, at the rates of " + base.name +
         "'s joints: say how long it takes from there to where it is locked";
}

std::string kind_of(const Json& table) {
  const bool has_kind = table.is_object() && table.contains("kind") && table["kind"].is_string();
  return has_kind ? table["kind"].get<std::string>() : "";
}

std::string robot_kind(const std::string& text, const std::string& file) { return kind_of(parse_json(text, file)); }

SerialRobotConfig parse_serial_robot(const std::string& text, const std::string& file) {
  return read_serial_robot(parse_json(text, file), file);
}

SerialRobotConfig parse_serial_robot(const std::string& text, const std::string& file, const BusesConfig& buses) {
  SerialRobotConfig out = parse_serial_robot(text, file);
  check_nodes(out.name, out.table.drive_count(), out.drive_serials, file, buses);
  check_drive_modes(out, file, buses);
  out.table.tick_s = buses.tick_s();
  out.table.interval_ticks = buses.interval_ticks();
  for (const BusConfig& bus : buses.buses) {
    out.has_wrist_sensor |= bus.wrist_sensor != 0;
    out.has_adapter |= bus.adapter != 0;
  }
  return out;
}

bool is_serial_robot(const std::string& path) { return robot_kind(read_text_file(path), path) == "serial"; }

SerialRobotConfig load_serial_robot(const std::string& path, const BusesConfig& buses) {
  return parse_serial_robot(read_text_file(path), path, buses);
}

std::string check_serial_robot(const Json& table, const std::string& file) {
  return read_serial_robot(table, file).canonical_json;
}

}  // namespace liana::config
