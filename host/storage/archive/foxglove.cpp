#include "host/storage/archive/foxglove.hpp"

#include <cmath>

#include "host/model/description/robot_tree.hpp"

namespace liana::archive::foxglove {
namespace {

struct Colour {
  double r, g, b, a;
};
constexpr Colour kPlate{0.60, 0.62, 0.66, 0.45}, kBody{0.85, 0.55, 0.25, 0.8}, kRod{0.85, 0.2, 0.2, 1.0};
constexpr Colour kBase{0.3, 0.3, 0.33, 1.0}, kEven{0.25, 0.45, 0.75, 1.0}, kOdd{0.45, 0.65, 0.9, 1.0};
constexpr double kBaseBox_m = 0.12;

// To 10 um and 1e-5 of a turn: finer digits are noise, and cost most of the file.
double rounded(double value) { return std::round(value * 1e5) / 1e5; }

Json vector(const Vec3& v) { return {{"x", rounded(v[0])}, {"y", rounded(v[1])}, {"z", rounded(v[2])}}; }
Json rotation(const Quat& q) {
  return {{"x", rounded(q[1])}, {"y", rounded(q[2])}, {"z", rounded(q[3])}, {"w", rounded(q[0])}};
}
Json pose(const Vec3& position_m, const Quat& quaternion) {
  return {{"position", vector(position_m)}, {"orientation", rotation(quaternion)}};
}
Json colour(const Colour& c) { return {{"r", c.r}, {"g", c.g}, {"b", c.b}, {"a", c.a}}; }

Json entity(double time_s, const std::string& frame, const std::string& id) {
  Json out{{"timestamp", time(time_s)},
           {"frame_id", frame},
           {"id", id},
           {"lifetime", {{"sec", 0}, {"nsec", 0}}},
           {"frame_locked", true}};
  for (const char* list :
       {"metadata", "arrows", "cubes", "spheres", "cylinders", "lines", "triangles", "texts", "models"})
    out[list] = Json::array();
  return out;
}

Json cube(const Vec3& center_m, const Quat& turn, const Vec3& size_m, const Colour& c) {
  return {{"pose", pose(center_m, turn)}, {"size", vector(size_m)}, {"color", colour(c)}};
}
Json sphere(const Vec3& center_m, double radius_m, const Colour& c) {
  const double d = 2.0 * radius_m;
  return {{"pose", pose(center_m, {1, 0, 0, 0})}, {"size", vector({d, d, d})}, {"color", colour(c)}};
}

Json surroundings(double time_s, const config::SceneConfig& scene) {
  Json out = entity(time_s, "base", "scene");
  out["cubes"].push_back(cube({-kBaseBox_m, 0, 0}, {1, 0, 0, 0}, scale({1, 1, 1}, 2 * kBaseBox_m), kBase));
  for (const config::SceneBox& box : scene.boxes)
    out["cubes"].push_back(
        cube(box.center_m, description::quaternion_of_axes(box.rotation), scale(box.half_extent_m, 2.0), kPlate));
  for (const config::SceneConvex& body : scene.convex)
    out["cubes"].push_back(cube(body.center_m, {1, 0, 0, 0}, scale(body.half_extent_m, 2.0), kBody));
  for (const config::SceneSphere& ball : scene.spheres)
    out["spheres"].push_back(sphere(ball.center_m, ball.radius_m, kBody));
  if (scene.rod) out["spheres"].push_back(sphere(scene.rod->pose.position_m, scene.rod->radius_m, kRod));
  return out;
}

std::string frame_of(std::size_t link) { return "link_" + std::to_string(link); }

Json link(double time_s, std::size_t number, double length_m, double radius_m) {
  Json out = entity(time_s, frame_of(number), frame_of(number));
  out["cylinders"].push_back({{"pose", pose({0, 0, length_m / 2}, {1, 0, 0, 0})},
                              {"size", vector({2 * radius_m, 2 * radius_m, length_m})},
                              {"bottom_scale", 1.0},
                              {"top_scale", 1.0},
                              {"color", colour(number % 2 == 0 ? kEven : kOdd)}});
  return out;
}

}  // namespace

Json time(double time_s) {
  const std::int64_t total_us = std::llround(time_s * 1e6);
  return {{"sec", total_us / 1'000'000}, {"nsec", total_us % 1'000'000 * 1000}};
}

Json scene_update(double time_s, const config::SceneConfig& scene, const std::vector<Vec3>& points, double radius_m) {
  Json entities = Json::array();
  entities.push_back(surroundings(time_s, scene));
  for (std::size_t i = 1; i < points.size(); ++i)
    entities.push_back(link(time_s, i, norm(subtract(points[i], points[i - 1])), radius_m));
  return {{"deletions", Json::array()}, {"entities", entities}};
}

Json frame_transforms(double time_s, const std::vector<Vec3>& points) {
  Json transforms = Json::array();
  Pose parent;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Pose link{points[i - 1], description::turn_from_z(subtract(points[i], points[i - 1]))};
    const Pose in_parent = compose(inverse(parent), link);
    transforms.push_back({{"timestamp", time(time_s)},
                          {"parent_frame_id", i == 1 ? "base" : frame_of(i - 1)},
                          {"child_frame_id", frame_of(i)},
                          {"translation", vector(in_parent.position_m)},
                          {"rotation", rotation(in_parent.quaternion)}});
    parent = link;
  }
  return {{"transforms", transforms}};
}

Json joint_states(double time_s, const std::vector<double>& values) {
  Json joints = Json::array();
  for (std::size_t i = 0; i < values.size(); ++i)
    joints.push_back({{"name", "theta_" + std::to_string(i + 1)}, {"position", rounded(values[i])}});
  return {{"timestamp", time(time_s)}, {"joints", joints}};
}

int level_of(const event::Event& event) {
  using enum event::EventKind;
  constexpr int kWarning = kInfo + 1, kError = kInfo + 2;
  const event::EventKind kind = event.kind;
  if (kind == kDevice && event.number == event::number_of(event::DeviceEvent::kSlow)) return kWarning;
  if (kind == kFault || kind == kEmergency || kind == kStop || kind == kBootProblem) return kError;
  return kind == kVerdict || kind == kRefusal || kind == kHostWarning ? kWarning : kInfo;
}

Json log(double time_s, const event::Event& event) {
  return {{"timestamp", time(time_s)},
          {"level", level_of(event)},
          {"message", event.text},
          {"name", event::event_kind_name(event.kind)},
          {"file", ""},
          {"line", 0}};
}

}  // namespace liana::archive::foxglove
