// A cable arm: crosses and modules, the holes of its cables, and the tensions with which it rests in its named poses.
#include <algorithm>
#include <cmath>

#include "firmware_like/cable/arm/cables.hpp"
#include "firmware_like/math/trig.hpp"
#include "host/model/description/robot_tree.hpp"
#include "host/model/simulation/cable_paths.hpp"
#include "host/model/simulation/chain.hpp"

namespace liana::description {
namespace {

using cable::RobotParams;
using cable::SegmentParams;

constexpr double kFeedStiffness_N_per_m = 1e5;  // of the servos of slide and belt, which hold what they are told
constexpr double kToolInertia_kgm2 = 1e-6;      // of a point mass, so that simulators take it

serial::LinkMass cylinder_mass(double mass_kg, double radius_m, double length_m, double center_m) {
  const double along = 0.5 * mass_kg * radius_m * radius_m;
  const double across = mass_kg * (3.0 * radius_m * radius_m + length_m * length_m) / 12.0;
  return {mass_kg, {center_m, 0.0, 0.0}, {along, across, across, 0.0, 0.0, 0.0}};
}

Shape along_x(double length_m, double radius_m) {
  return {"",
          Shape::Kind::kCylinder,
          {{0.5 * length_m, 0.0, 0.0}, turn_from_z({1.0, 0.0, 0.0})},
          {radius_m, radius_m, 0.5 * length_m}};
}

std::string theta_name(std::size_t theta) { return "theta_" + std::to_string(theta + 1); }

class CableTree {
 public:
  explicit CableTree(const config::RobotConfig& robot) : robot_(robot), table_(robot.table) {
    tree_.name = robot.name;
    tree_.gravity_m_s2 = table_.gravity_m_s2;
    tree_.start_pose = robot.start_pose;
    tree_.links.push_back({.name = "base"});
    if (table_.feed_count() > 0) add_feed();
    add_cables();
    const auto segments = static_cast<std::size_t>(table_.segment_count);
    for (auto m = static_cast<std::size_t>(table_.first_bending()); m < segments; ++m) {
      for (std::int32_t k = 0; k < table_.segment[m].modules; ++k) add_module(m, k);
    }
    add_tip();
    for (const auto& [name, theta_deg] : robot.named_poses_deg) tree_.poses.emplace(name, pose(theta_deg));
  }
  RobotTree take() { return std::move(tree_); }

 private:
  std::size_t add(Link link) {
    link.parent = tree_.links.size() - 1;
    tree_.links.push_back(std::move(link));
    return tree_.links.size() - 1;
  }

  void add_feed() {
    const SegmentParams& base = table_.segment[0];
    const double limit = base.theta_limit_rad, max_N = table_.tension.hard_limit_N;
    const std::array<double, 2> unit{base.slide_m_rad, 1.0};
    const std::array<double, 2> stiffness{kFeedStiffness_N_per_m,
                                          kFeedStiffness_N_per_m * base.roll_radius_m * base.roll_radius_m};
    for (std::size_t i = 0; i < 2; ++i) {
      Joint joint{.kind = i == 0 ? Joint::Kind::kPrismatic : Joint::Kind::kRevolute,
                  .name = theta_name(i),
                  .theta = i,
                  .axis = {1.0, 0.0, 0.0},
                  .per_rad = unit[i],
                  .low = -limit * unit[i],
                  .high = limit * unit[i],
                  .rate = table_.limits.theta_rate_rad_s * unit[i],
                  .effort = i == 0 ? max_N : max_N * base.roll_radius_m};
      // A servo that does not swing: critical for what the carriage itself weighs, about twice that for the whole arm.
      const double moved = i == 0 ? arm_kg() : 0.5 * arm_kg() * base.roll_radius_m * base.roll_radius_m;
      joint.damping = 2.0 * std::sqrt(stiffness[i] * moved);
      tree_.servos.push_back({joint.name, joint.low, joint.high, stiffness[i], joint.effort});
      Link link{.name = i == 0 ? "slide" : "carriage", .joint = joint};
      if (i == 1) {
        const double turning = 0.5 * base.module_mass_kg * base.roll_radius_m * base.roll_radius_m;
        link.mass = {base.module_mass_kg, {}, {turning, turning, turning, 0.0, 0.0, 0.0}};
      }
      add(std::move(link));
    }
  }
  double arm_kg() const {
    double sum_kg = table_.tool.mass_kg;
    for (const SegmentParams& each : table_.segment) sum_kg += std::max(1, each.modules) * each.module_mass_kg;
    return sum_kg;
  }

  // One of the two joints of a module, about z (pitch) or y (yaw).
  Joint joint(std::size_t segment, std::int32_t module, bool is_pitch) const {
    const SegmentParams& each = table_.segment[segment];
    const std::size_t theta = 2 * segment + (is_pitch ? 0 : 1);
    Joint joint{.kind = Joint::Kind::kRevolute, .name = theta_name(theta), .theta = theta};
    if (module > 0) {
      joint.mimics = joint.name;
      joint.name += "_module_" + std::to_string(module + 1);
    }
    joint.axis = is_pitch ? Vec3{0.0, 0.0, 1.0} : Vec3{0.0, 1.0, 0.0};
    joint.low = -each.theta_limit_rad;
    joint.high = each.theta_limit_rad;
    joint.rate = table_.limits.theta_rate_rad_s;
    joint.effort = table_.tension.hard_limit_N * each.hole_radius_m;
    joint.damping = robot_.joint_viscous_Nms_per_rad / each.modules;
    joint.stiffness = each.joint_stiffness_Nm_rad;
    joint.rest = each.joint_rest_rad[is_pitch ? 0 : 1];
    return joint;
  }

  void add_module(std::size_t segment, std::int32_t module) {
    const SegmentParams& each = table_.segment[segment];
    const bool is_pitch_first = module % 2 == 0;
    const std::string name = "link_" + std::to_string(++modules_);
    const std::size_t before = tree_.links.size() - 1;
    Link cross{.name = name + "_cross", .joint = joint(segment, module, is_pitch_first)};
    cross.origin.position_m[0] = offset_m_;
    add(std::move(cross));
    const double length_m = each.module_length_m;
    Link link{.name = name, .joint = joint(segment, module, !is_pitch_first)};
    link.mass = cylinder_mass(each.module_mass_kg, robot_.module_radius_m, length_m, each.module_center * length_m);
    link.shapes.push_back(along_x(length_m, robot_.module_radius_m));
    const std::size_t here = add(std::move(link));
    add_holes(segment, before, here);
    offset_m_ = length_m;
  }

  // Of all cables that pass or end in the segment, in the discs on either side of a joint.
  void add_holes(std::size_t segment, std::size_t before, std::size_t here) {
    const double face_m = table_.segment[segment].face_offset_m;
    for (std::size_t c = 0; c < tree_.cables.size(); ++c) {
      const std::size_t drive = c + static_cast<std::size_t>(table_.feed_count());
      if (static_cast<std::size_t>(layout_.segment[drive]) < segment) continue;
      const double y_m = layout_.hole_y_m[drive], z_m = layout_.hole_z_m[drive];
      tree_.cables[c].holes.push_back({before, {offset_m_ - face_m, y_m, z_m}});
      tree_.cables[c].holes.push_back({here, {face_m, y_m, z_m}});
    }
  }

  void add_cables() {
    const auto count = static_cast<std::size_t>(layout_.cable_count);
    for (auto drive = static_cast<std::size_t>(table_.feed_count()); drive < count; ++drive) {
      const auto own = static_cast<std::size_t>(layout_.segment[drive]);
      Cable cable{.name = "cable_" + std::to_string(drive + 1)};
      cable.zero_length_m = layout_.zero_length_m[drive];
      for (auto m = static_cast<std::size_t>(table_.first_bending()); m <= own; ++m) {
        const SegmentParams& passed = table_.segment[m];
        cable.travel_m += 2.0 * passed.modules * passed.theta_limit_rad * table_.segment[own].hole_radius_m;
      }
      cable.stiffness_N_per_m = table_.cable_EA_N / (table_.lead_m + cable.zero_length_m);
      cable.max_N = table_.tension.hard_limit_N;
      tree_.cables.push_back(std::move(cable));
    }
  }

  void add_tip() {
    Link tip{.name = "tip"};
    tip.origin.position_m[0] = offset_m_;
    add(std::move(tip));
    if (table_.tool.mass_kg == 0.0) return;
    constexpr double I = kToolInertia_kgm2;
    Link tool{.name = "tool", .mass = {table_.tool.mass_kg, table_.tool.center_in_tip_m, {I, I, I, 0.0, 0.0, 0.0}}};
    add(std::move(tool));
  }

  // The tensions nearest to the planned ones that carry the weight; springs of cables and servos give by them.
  TreePose pose(const std::vector<double>& theta_deg) const {
    cable::ThetaVector theta_rad{};
    TreePose pose;
    for (std::size_t i = 0; i < theta_deg.size(); ++i) pose.theta_rad.push_back(theta_rad[i] = theta_deg[i] * kDegree);
    const simulation::ArmModel model = simulation::arm_model(robot_);
    simulation::Chain chain;
    simulation::place(model, theta_rad, chain);
    const simulation::CablePaths paths = simulation::cable_paths(model, theta_rad);
    const simulation::CableColumn wanted_N =
        simulation::CableColumn::Constant(paths.jacobian_m_rad.rows(), table_.tension.plan_N);
    const simulation::CableColumn tension_N = simulation::balanced_tensions(
        paths, wanted_N, table_.tension.floor_motor_N, simulation::static_load(model, theta_rad, chain));
    const cable::CableGeometry geometry = cable_geometry(table_, layout_, arm_trig(table_, theta_rad));
    const auto feeds = static_cast<std::size_t>(table_.feed_count());
    for (std::size_t i = 0; i < feeds; ++i) {
      const double per_m = i == 0 ? 1.0 : table_.segment[0].roll_radius_m;  // pull of the drive to the joint's effort
      const double effort = tension_N(static_cast<Eigen::Index>(i)) * per_m;
      const double at = theta_rad[i] * (i == 0 ? table_.segment[0].slide_m_rad : 1.0);
      pose.servo.push_back(at - effort / tree_.servos[i].stiffness);
    }
    for (std::size_t c = 0; c < tree_.cables.size(); ++c)
      pose.cable_m.push_back(geometry.length_m[c + feeds] -
                             tension_N(static_cast<Eigen::Index>(c + feeds)) / tree_.cables[c].stiffness_N_per_m);
    return pose;
  }

  const config::RobotConfig& robot_;
  const RobotParams& table_;
  const cable::CableLayout layout_ = cable_layout(table_);
  RobotTree tree_;
  int modules_ = 0;
  double offset_m_ = 0.0;  // from the last link's joint to the next one
};

}  // namespace

RobotTree tree_of(const config::RobotConfig& robot) { return CableTree(robot).take(); }

}  // namespace liana::description
