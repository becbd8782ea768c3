#include "hil/arm/mjcf.hpp"

#include <cmath>
#include <iomanip>
#include <sstream>

#include "hil/arm/mujoco_model.hpp"

namespace liana::bench {

namespace {

constexpr int kBodiesPerFile = 64;  // MuJoCo 2.2.2 reads no file with elements more than 100 deep

std::ostream& operator<<(std::ostream& out, const Vec3& v) { return out << v.x << ' ' << v.y << ' ' << v.z; }

// The points of every hull, of which MuJoCo takes the hull when it looks for contacts.
void write_meshes(std::ostream& out, const SceneConfig& scene) {
  out << "<asset>";
  for (std::size_t i = 0; i < scene.convex.size(); ++i) {
    if (scene.convex[i].kind != ConvexConfig::Kind::hull) continue;
    out << "<mesh name='convex" << i << "' vertex='";
    for (const Vec3& point : scene.convex[i].points_m) out << point << ' ';
    out << "'/>";
  }
  out << "</asset>\n";
}

void write_convex(std::ostream& out, const ConvexConfig& body, std::size_t i) {
  out << "<geom contype='0' conaffinity='1' ";
  if (body.kind == ConvexConfig::Kind::hull) {
    out << "type='mesh' mesh='convex" << i << "'/>\n";
    return;
  }
  out << "type='" << (body.kind == ConvexConfig::Kind::cylinder ? "cylinder" : "capsule") << "' fromto='"
      << body.points_m[0] << ' ' << body.points_m[1] << "' size='" << body.radius_m << "'/>\n";
}

// Collision classes: scene shapes are 1, the rod is 2; links carry 3, the last link 1.
void write_scene(std::ostream& out, const SceneConfig& scene) {
  for (const auto& box : scene.boxes) {
    out << "<geom type='box' contype='0' conaffinity='1' pos='" << box.center_m << "' size='" << box.half_extent_m[0]
        << ' ' << box.half_extent_m[1] << ' ' << box.half_extent_m[2] << "' xyaxes='" << box.axis[0] << ' '
        << box.axis[1] << "'/>\n";
  }
  for (const auto& sphere : scene.spheres)
    out << "<geom type='sphere' contype='0' conaffinity='1' pos='" << sphere.center_m << "' size='" << sphere.radius_m
        << "'/>\n";
  for (std::size_t i = 0; i < scene.convex.size(); ++i) write_convex(out, scene.convex[i], i);
  out << "<geom name='rod' type='sphere' contype='0' conaffinity='2' pos='" << scene.rod.pose.position_m << "' size='"
      << scene.rod.radius_m << "'/>\n";
}

void write_sites(std::ostream& out, const RobotConfig& robot, const char* side, int link, double x_m) {
  std::size_t cable = 0;
  for (const auto& segment : robot.segments) {
    for (const double phase : segment.cable_phase_rad) {
      out << "<site name='" << side << link << '_' << cable++ << "' pos='" << x_m << ' '
          << segment.hole_radius_m * std::cos(phase) << ' ' << segment.hole_radius_m * std::sin(phase) << "'/>";
    }
  }
  out << '\n';
}

// Opens the carriage, a solid cylinder of the wheel's radius: only its turn about x counts, so it is as a ball.
void write_carriage(std::ostream& out, const BaseConfig& base) {
  const double inertia = 0.5 * base.mass_kg * base.roll_radius_m * base.roll_radius_m;
  out << "<body><joint type='slide' axis='1 0 0'/><joint type='hinge' axis='1 0 0'/><inertial pos='0 0 0' mass='"
      << base.mass_kg << "' diaginertia='" << inertia << ' ' << inertia << ' ' << inertia << "'/>\n";
}

void write_link(std::ostream& out, const RobotConfig& robot, const SegmentConfig& segment, double offset_m,
                bool pitch_first, bool last) {
  const double l = segment.module_length_m;
  const double r = robot.module_radius_m;
  const double m = segment.module_mass_kg;
  const double across = m * (3.0 * r * r + l * l) / 12.0;
  const char* axes[2] = {pitch_first ? "0 0 1" : "0 1 0", pitch_first ? "0 1 0" : "0 0 1"};
  out << "<body pos='" << offset_m << " 0 0'><joint type='hinge' axis='" << axes[0] << "'/><joint type='hinge' axis='"
      << axes[1] << "'/>"
      << "<inertial pos='" << segment.module_center * l << " 0 0' mass='" << m << "' diaginertia='" << 0.5 * m * r * r
      << ' ' << across << ' ' << across << "'/>"
      << "<geom type='capsule' fromto='0 0 0 " << l << " 0 0' size='" << r << "' contype='" << (last ? 1 : 3)
      << "' conaffinity='0'/>\n";
  if (last && robot.tool_kg > 0.0)
    out << "<body pos='" << l << " 0 0'><inertial pos='" << robot.tool_center_m << "' mass='" << robot.tool_kg
        << "' diaginertia='1e-6 1e-6 1e-6'/></body>\n";
}

void write_tendons(std::ostream& out, const RobotConfig& robot) {
  out << "<tendon>\n";
  std::size_t cable = 0;
  int links = 0;
  for (const auto& segment : robot.segments) {
    links += segment.modules;
    for (std::size_t c = 0; c < segment.cable_phase_rad.size(); ++c, ++cable) {
      out << "<spatial>";
      for (int i = 0; i < links; ++i)
        out << "<site site='n" << i << '_' << cable << "'/><site site='f" << i << '_' << cable << "'/>";
      out << "</spatial>\n";
    }
  }
  out << "</tendon>\n";
}

// The links, one in the other; part i lies in the last body of part i - 1.
std::vector<std::string> bodies(const RobotConfig& robot, bool with_tendons) {
  std::vector<std::string> parts;
  std::ostringstream out;
  out << std::setprecision(17);
  double offset_m = 0.0;
  int link = 0;
  int in_part = 0;
  const auto end_part = [&] {
    parts.push_back(out.str());
    out.str("");
    in_part = 0;
  };
  if (robot.base) write_carriage(out, *robot.base), ++in_part;
  for (std::size_t s = 0; s < robot.segments.size(); ++s) {
    const SegmentConfig& segment = robot.segments[s];
    for (int i = 0; i < segment.modules; ++i, ++link, ++in_part) {
      if (in_part == kBodiesPerFile) end_part();
      // The disc before a joint belongs to the link before it: world or carriage for the first.
      if (with_tendons) write_sites(out, robot, "n", link, offset_m - segment.face_offset_m);
      const bool last = s + 1 == robot.segments.size() && i + 1 == segment.modules;
      write_link(out, robot, segment, offset_m, i % 2 == 0, last);
      if (with_tendons) write_sites(out, robot, "f", link, segment.face_offset_m);
      offset_m = segment.module_length_m;
    }
  }
  const int in_last = in_part;
  end_part();
  for (std::size_t part = 0; part < parts.size(); ++part) {
    const bool last = part + 1 == parts.size();
    if (!last) parts[part] += "<include file='" + mjcf_name(part + 1) + "'/>";
    for (int i = 0; i < (last ? in_last : kBodiesPerFile); ++i) parts[part] += "</body>";
  }
  return parts;
}

}  // namespace

std::vector<std::string> make_mjcf(const RobotConfig& robot, const SceneConfig& scene, bool with_tendons) {
  std::vector<std::string> files = bodies(robot, with_tendons);
  for (std::size_t i = 1; i < files.size(); ++i) files[i] = "<mujoco>" + files[i] + "</mujoco>\n";
  std::ostringstream out;
  out << std::setprecision(17);
  out << "<mujoco><compiler angle='radian' autolimits='true'/><size nconmax='2000' njmax='1'/><option gravity='0 0 "
         "0'/>\n";
  write_meshes(out, scene);
  out << "<worldbody>\n";
  write_scene(out, scene);
  out << files.front() << "</worldbody>\n";
  if (with_tendons) write_tendons(out, robot);
  out << "</mujoco>\n";
  files.front() = out.str();
  return files;
}

}  // namespace liana::bench
