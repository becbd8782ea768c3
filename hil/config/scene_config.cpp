#include "hil/config/scene_config.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "hil/config/fields.hpp"
#include "hil/config/json_file.hpp"
#include "hil/math/random.hpp"

namespace liana::bench {

namespace {

const RodConfig kNoRod{{{-1000.0, 0.0, 0.0}, {}}, 1e-4, 0.0};  // nothing reaches it, and no camera sees it

BoxConfig read_box(const JsonFile& file, const std::string& field) {
  BoxConfig box;
  box.name = file.text(field + "/name");
  box.center_m = file.vector(field + "/center_m");
  const auto half = file.numbers(field + "/half_extent_m", 3, 1e-4, 100.0);
  for (std::size_t k = 0; k < 3; ++k) {
    box.half_extent_m[k] = half[k];
    box.axis[k] = file.vector(at(field + "/rotation", k));
    if (std::fabs(norm(box.axis[k]) - 1.0) > 1e-6)
      file.fail(at(field + "/rotation", k), "must be a unit vector to 1e-6");
  }
  if (norm(cross(box.axis[0], box.axis[1]) - box.axis[2]) > 1e-6)
    file.fail(field + "/rotation", "must be right-handed and orthogonal");
  return box;
}

std::vector<Vec3> read_points(const JsonFile& file, const std::string& field, std::size_t least, std::size_t most) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < file.size(field); ++i) points.push_back(file.vector(at(field, i)));
  if (points.size() < least || points.size() > most)
    file.fail(field, "has " + std::to_string(points.size()) + " points, allowed are " + std::to_string(least) + " to " +
                         std::to_string(most));
  return points;
}

// A chain is a capsule for each of its pieces.
void read_convex(const JsonFile& file, const std::string& field, std::vector<ConvexConfig>& out) {
  using Kind = ConvexConfig::Kind;
  const std::string name = file.text(field + "/name"), round = field + "/cylinder", chain = field + "/chain";
  if (file.has(field + "/points_m"))
    out.push_back({name, Kind::hull, read_points(file, field + "/points_m", 4, 256), 0.0});
  if (file.has(round))
    out.push_back({name,
                   Kind::cylinder,
                   {file.vector(round + "/from_m"), file.vector(round + "/to_m")},
                   file.number(round + "/radius_m", 1e-4, 100.0)});
  if (!file.has(chain)) return;
  const std::vector<Vec3> points = read_points(file, chain + "/points_m", 2, 64);
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    out.push_back({name, Kind::capsule, {points[i], points[i + 1]}, file.number(chain + "/radius_m", 1e-4, 100.0)});
}

CameraConfig read_camera(const JsonFile& file) {
  CameraConfig camera{file.number("/camera/rate_hz", 0.1, 1000.0), file.number("/camera/latency_s", 0.0, 10.0),
                      file.number("/camera/noise_m", 0.0, 1.0),
                      kRadPerDeg * file.number("/camera/noise_deg", 0.0, 45.0),
                      file.number("/camera/range_m", 0.0, 1000.0)};
  if (file.has("/camera/bias_m")) camera.bias_m = file.number("/camera/bias_m", 0.0, 1.0);
  if (file.has("/camera/bias_deg")) camera.bias_rad = kRadPerDeg * file.number("/camera/bias_deg", 0.0, 45.0);
  if (file.has("/camera/dropout")) camera.dropout = file.number("/camera/dropout", 0.0, 1.0);
  return camera;
}

// What a displaced scene is turned about.
Vec3 pivot_of(const SceneConfig& scene) {
  if (scene.slit_frame) return scene.slit_frame->position_m;
  return scene.adapter ? scene.adapter->pose.position_m : scene.rod.pose.position_m;
}

Vec3 random_direction(Random& random) {
  const Vec3 raw{random.gaussian(1.0), random.gaussian(1.0), random.gaussian(1.0)};
  return (1.0 / norm(raw)) * raw;
}

}  // namespace

SceneConfig displaced(const SceneConfig& scene, const SceneOffset& offset, std::uint64_t seed) {
  if (offset.distance_m == 0.0 && offset.angle_rad == 0.0) return scene;  // to the bit
  Random random(seed, "scene offset");
  const Vec3 shift = offset.distance_m * random_direction(random);
  const Quat turn = from_rotation_vector(offset.angle_rad * random_direction(random));
  const Vec3 pivot = pivot_of(scene);
  const auto moved = [&](const Vec3& point) { return pivot + rotate(turn, point - pivot) + shift; };
  const auto moved_pose = [&](const Pose& pose) { return Pose{moved(pose.position_m), turn * pose.attitude}; };
  SceneConfig there = scene;
  for (BoxConfig& box : there.boxes) {
    box.center_m = moved(box.center_m);
    for (Vec3& axis : box.axis) axis = rotate(turn, axis);
  }
  for (SphereConfig& sphere : there.spheres) sphere.center_m = moved(sphere.center_m);
  if (there.slit_frame) there.slit_frame = moved_pose(*there.slit_frame);
  there.rod.pose = moved_pose(there.rod.pose);
  if (there.payload) there.payload->pose = moved_pose(there.payload->pose);
  if (there.adapter) there.adapter->pose = moved_pose(there.adapter->pose);
  return there;
}

double depth_in_slit_m(const SceneConfig& scene, const Vec3& point_m) {
  constexpr double kNoSlit_m = -1000.0;
  if (!scene.slit_frame) return kNoSlit_m;
  return dot(rotate(scene.slit_frame->attitude, {1.0, 0.0, 0.0}), point_m - scene.slit_frame->position_m);
}

SceneConfig load_scene(const std::string& path) {
  const JsonFile file(path, "scene");
  SceneConfig scene;
  for (std::size_t i = 0; i < file.size("/boxes"); ++i) scene.boxes.push_back(read_box(file, at("/boxes", i)));
  for (std::size_t i = 0; i < file.size("/spheres"); ++i) {
    const std::string field = at("/spheres", i);
    scene.spheres.push_back(
        {file.text(field + "/name"), file.vector(field + "/center_m"), file.number(field + "/radius_m", 1e-4, 100.0)});
  }
  for (std::size_t i = 0; file.has("/convex") && i < file.size("/convex"); ++i)
    read_convex(file, at("/convex", i), scene.convex);
  if (file.has("/slit")) scene.slit_frame = file.pose("/slit/frame");
  scene.rod = kNoRod;
  if (file.has("/rod"))
    scene.rod = {file.pose("/rod"), file.number("/rod/radius_m", 1e-4, 1.0),
                 file.number("/rod/stiffness_N_per_m", 0.0, 1e5)};
  scene.camera = read_camera(file);
  scene.contact = {file.number("/contact/stiffness_N_per_m", 1.0, 1e5),
                   file.number("/contact/damping_Ns_per_m", 0.0, 1e4), file.number("/contact/friction", 0.0, 2.0)};
  scene.payload = read_payload(file);
  scene.adapter = read_adapter(file);
  return scene;
}

namespace {

void read_load_cells(const JsonFile& file, std::size_t b, BusesConfig& buses) {
  const std::string list = at("/buses", b) + "/load_cells";
  if (!file.has(list)) return;
  for (std::size_t i = 0; i < file.size(list); ++i) {
    const std::string field = at(list, i);
    LoadCellNodeConfig node{file.integer(field + "/node", 1, 126), b, {}, {}};
    for (std::size_t k = 0; k < file.size(field + "/cables"); ++k) {
      node.cables.push_back(static_cast<std::size_t>(file.integer(at(field + "/cables", k), 1, 32) - 1));
      node.zero_N.push_back(file.has(field + "/zero_N") ? file.number(at(field + "/zero_N", k), -1000, 1000) : 0.0);
    }
    buses.load_cells.push_back(node);
  }
  buses.newtons_per_step = file.number("/load_cell/newtons_per_step", 1e-6, 10);
}

// 3, or {"node": 3, "axis": 2}.
AxisConfig read_axis(const JsonFile& file, const std::string& field, std::size_t bus) {
  const bool has_axis = file.has(field + "/axis");
  return {file.integer(has_axis ? field + "/node" : field, 1, 126), has_axis ? file.integer(field + "/axis", 1, 2) : 1,
          static_cast<std::uint8_t>(bus)};
}

// Each axis once, and a second one beside the first.
void check_axes(const JsonFile& file, const BusesConfig& buses) {
  const AxisConfig* before = nullptr;
  for (const AxisConfig& each : buses.axes) {
    const bool is_next = before != nullptr && before->node == each.node;
    if (is_next ? each.axis != 2 || before->axis != 1 || before->bus != each.bus : each.axis != 1)
      file.fail("/buses", "has axis " + std::to_string(each.axis) + " of node " + std::to_string(each.node) +
                              "; allowed is each axis once, and axis 2 beside axis 1 on one bus");
    before = &each;
  }
}

}  // namespace

BusesConfig load_buses(const std::string& path) {
  const JsonFile file(path, "buses");
  BusesConfig buses;
  buses.period_us = static_cast<std::uint32_t>(std::lround(1e6 / file.number("/rate_hz", 10.0, 1000.0)));
  const std::size_t count = file.size("/buses");
  if (count < 1 || count > 8) file.fail("/buses", "has " + std::to_string(count) + " entries, allowed is 1 to 8");
  for (std::size_t b = 0; b < count; ++b) {
    buses.names.push_back(file.text(at("/buses", b) + "/name"));
    const std::string nodes = at("/buses", b) + "/nodes";
    for (std::size_t i = 0; i < file.size(nodes); ++i) buses.axes.push_back(read_axis(file, at(nodes, i), b));
    read_load_cells(file, b, buses);
  }
  std::sort(buses.axes.begin(), buses.axes.end(), [](const AxisConfig& a, const AxisConfig& b) {
    return std::pair(a.node, a.axis) < std::pair(b.node, b.axis);
  });
  check_axes(file, buses);
  buses.dictionaries = read_dictionaries(file);
  return buses;
}

DictionaryConfig BusesConfig::dictionary_of(int node) const {
  const auto found = dictionaries.find(node);
  return found == dictionaries.end() ? DictionaryConfig{} : found->second;
}

AxisConfig BusesConfig::axis_of(std::size_t drive) const {
  if (drive < axes.size()) return axes[drive];
  throw std::runtime_error("bus table: drive " + std::to_string(drive + 1) +
                           " is on no bus; add its node to one bus's \"nodes\"");
}

int BusesConfig::axes_of(int node) const {
  return static_cast<int>(
      std::count_if(axes.begin(), axes.end(), [node](const AxisConfig& axis) { return axis.node == node; }));
}

}  // namespace liana::bench
