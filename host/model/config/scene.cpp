// Scenes: checks of the table.
#include <cmath>
#include <set>
#include <stdexcept>

#include "host/model/config/canonical.hpp"
#include "host/model/config/config.hpp"
#include "host/model/config/convex_shape.hpp"
#include "host/model/config/scene_parts.hpp"

namespace liana::config {
namespace {

double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

bool near(const Vec3& a, const Vec3& b, double tolerance) {
  return std::fabs(a[0] - b[0]) < tolerance && std::fabs(a[1] - b[1]) < tolerance && std::fabs(a[2] - b[2]) < tolerance;
}

bool right_handed(const std::array<Vec3, 3>& axes) {
  const bool unit =
      std::fabs(dot(axes[0], axes[0]) - 1) < kUnitTolerance && std::fabs(dot(axes[1], axes[1]) - 1) < kUnitTolerance;
  return unit && std::fabs(dot(axes[0], axes[1])) < kUnitTolerance &&
         near(cross(axes[0], axes[1]), axes[2], kUnitTolerance);
}

// Columns of the rotation matrix of a unit quaternion: the frame's axes in base coordinates.
std::array<Vec3, 3> axes_of(const std::array<double, 4>& q) {
  const auto [w, x, y, z] = q;
  return {Vec3{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
          Vec3{2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
          Vec3{2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
}

SceneBox read_box(const Field& field) {
  field.only({"name", "center_m", "half_extent_m", "rotation"});
  SceneBox box;
  box.name = field.at("name").name(40);
  box.center_m = field.at("center_m").numbers<3>(kPlace);
  box.half_extent_m = field.at("half_extent_m").numbers<3>(kThickness);
  const Field rotation = field.at("rotation");
  rotation.size(3, 3, "give the three axes as rows");
  for (std::size_t i = 0; i < 3; ++i) box.rotation[i] = rotation.element(i).numbers<3>(kDirection);
  if (!right_handed(box.rotation)) rotation.refuse("three orthonormal right-handed rows", "recompute the axes");
  return box;
}

SceneSphere read_sphere(const Field& field) {
  field.only({"name", "center_m", "radius_m"});
  return {field.at("name").name(40), field.at("center_m").numbers<3>(kPlace), field.at("radius_m").number(kThickness)};
}

constexpr std::size_t kMaxConvex = 64;
constexpr std::size_t kMaxSceneBytes = 122880;  // as canonical JSON, all of it: a client gets it in one packet
constexpr double kMinThickness_m = 1e-6;

std::vector<Vec3> read_points(const Field& field, std::size_t least, std::size_t most, const char* what_to_do) {
  std::vector<Vec3> points_m(field.size(least, most, what_to_do));
  for (std::size_t i = 0; i < points_m.size(); ++i) points_m[i] = field.element(i).numbers<3>(kPlace);
  return points_m;
}

SceneConvex read_hull(const Field& field, const std::string& name) {
  const Field points = field.at("points_m");
  SceneConvex body = hull_of(name, read_points(points, 4, kMaxHullPoints, "leave out points inside the hull"));
  if (thickness_m(body.points_m) < kMinThickness_m)
    points.refuse("points that do not lie in one plane to 1e-6 m", "give the body its thickness");
  return body;
}

SceneConvex read_cylinder(const Field& field, const std::string& name) {
  field.only({"from_m", "to_m", "radius_m"});
  const Vec3 from_m = field.at("from_m").numbers<3>(kPlace), to_m = field.at("to_m").numbers<3>(kPlace);
  if (near(from_m, to_m, kMinThickness_m))
    field.at("to_m").refuse("another point than from_m, by 1e-6 m or more", "give both ends of the cylinder's axis");
  return cylinder(name, from_m, to_m, field.at("radius_m").number(kThickness));
}

void read_chain(const Field& field, const std::string& name, std::vector<SceneConvex>& out) {
  field.only({"points_m", "radius_m"});
  const std::vector<Vec3> points_m = read_points(field.at("points_m"), 2, 64, "divide the chain");
  const double radius_m = field.at("radius_m").number(kThickness);
  for (std::size_t i = 0; i + 1 < points_m.size(); ++i)
    out.push_back(capsule(name, points_m[i], points_m[i + 1], radius_m));
}

// One entry is one of the kinds; a chain is one body for each of its pieces.
void read_convex(const Field& field, std::vector<SceneConvex>& out) {
  field.only({"name", "points_m", "cylinder", "chain"});
  const std::string name = field.at("name").name(40);
  const Json& json = field.json();
  if (json.contains("points_m") + json.contains("cylinder") + json.contains("chain") != 1)
    field.at("name").refuse("one of points_m, cylinder, chain beside it", "say which body it is; for two give two");
  if (json.contains("points_m")) out.push_back(read_hull(field, name));
  if (json.contains("cylinder")) out.push_back(read_cylinder(field.at("cylinder"), name));
  if (json.contains("chain")) read_chain(field.at("chain"), name, out);
}

SceneSlit read_slit(const Field& field) {
  field.only({"normal", "offset_m", "u_axis", "w_axis", "mouth_u_m", "end_u_m", "half_gap_m", "frame"});
  field.at("frame").only({"position_m", "quaternion_wxyz"});
  SceneSlit slit;
  slit.normal = field.at("normal").numbers<3>(kDirection);
  slit.offset_m = field.at("offset_m").number(kPlace);
  slit.u_axis = field.at("u_axis").numbers<3>(kDirection);
  slit.w_axis = field.at("w_axis").numbers<3>(kDirection);
  slit.mouth_u_m = field.at("mouth_u_m").number(kPlace);
  slit.end_u_m = field.at("end_u_m").number({slit.mouth_u_m, 100, true});
  slit.half_gap_m = field.at("half_gap_m").number({0, 10, true});
  slit.frame = read_pose(field.at("frame"));
  return slit;
}

void check_slit(const Field& field, const SceneSlit& slit) {
  const std::array<Vec3, 3> axes = {slit.u_axis, slit.normal, slit.w_axis};
  if (!right_handed(axes))
    field.at("w_axis").refuse("u x n of unit vectors u and n at right angles", "compute w_axis from u_axis and normal");
  const std::array<Vec3, 3> frame = axes_of(slit.frame.quaternion_wxyz);
  for (std::size_t i = 0; i < 3; ++i) {
    if (!near(frame[i], axes[i], 1e-8))
      field.at("frame").at("quaternion_wxyz").refuse("axes x = u, y = n, z = w", "compute it from the axes");
  }
  Vec3 mouth{};
  for (std::size_t i = 0; i < 3; ++i) mouth[i] = slit.u_axis[i] * slit.mouth_u_m + slit.normal[i] * slit.offset_m;
  if (!near(mouth, slit.frame.position_m, 1e-8))
    field.at("frame").at("position_m").refuse("u_axis * mouth_u_m + normal * offset_m", "compute it from these fields");
}

SceneRod read_rod(const Field& field) {
  field.only({"position_m", "quaternion_wxyz", "radius_m", "stiffness_N_per_m"});
  return {read_pose(field), field.at("radius_m").number({0, 1, true}), field.at("stiffness_N_per_m").number({0, 1e6})};
}

SceneCamera read_camera(const Field& field) {
  field.only({"rate_hz", "latency_s", "noise_m", "noise_deg", "range_m", "bias_m", "bias_deg", "dropout"});
  SceneCamera camera{field.at("rate_hz").number({1, 1000}), field.at("latency_s").number({0, 10}),
                     field.at("noise_m").number({0, 1}), field.at("noise_deg").number({0, 45}),
                     field.at("range_m").number(kLength)};
  const auto read = [&](const char* name, const Range& range, double& value) {
    if (field.json().contains(name)) value = field.at(name).number(range);
  };
  read("bias_m", {0, 1}, camera.bias_m);
  read("bias_deg", {0, 45}, camera.bias_deg);
  read("dropout", {0, 1}, camera.dropout);
  return camera;
}

SceneContact read_contact(const Field& field) {
  field.only({"stiffness_N_per_m", "damping_Ns_per_m", "friction"});
  return {field.at("stiffness_N_per_m").number({0, 1e7, true}), field.at("damping_Ns_per_m").number({0, 1e5}),
          field.at("friction").number({0, 2})};
}

// Each may be left out.
SceneMargins read_margins(const Field& field) {
  field.only({"prediction_m", "slow_m", "refuse_m", "shift_m", "turn_deg"});
  SceneMargins margins;
  const auto read = [&](const char* name, const Range& range, double& value) {
    if (field.json().contains(name)) value = field.at(name).number(range);
  };
  read("prediction_m", {0, 1}, margins.prediction_m);
  read("refuse_m", {-0.1, 0.1}, margins.refuse_m);
  read("slow_m", {-0.1, 0.1}, margins.slow_m);
  read("shift_m", {0, 0.1}, margins.shift_m);
  read("turn_deg", {0, 10}, margins.turn_deg);
  if (margins.slow_m < margins.refuse_m)
    field.refuse("slow_m not below refuse_m", "slow down no later than nothing is allowed any more");
  return margins;
}

// Messages and reports name a body: no two may share a name. The pieces of a chain are one body.
void check_names(const Field& table) {
  std::set<std::string> names;
  for (const char* kind : {"boxes", "spheres", "convex"}) {
    if (!table.json().contains(kind)) continue;
    const Field bodies = table.at(kind);
    for (std::size_t i = 0; i < bodies.json().size(); ++i) {
      const Field name = bodies.element(i).at("name");
      if (!names.insert(name.name(40)).second)
        name.refuse("a name that no other body of the scene has", "rename one of them");
    }
  }
}

}  // namespace

ScenePose read_pose(const Field& field) {
  ScenePose pose;
  pose.position_m = field.at("position_m").numbers<3>(kPlace);
  pose.quaternion_wxyz = field.at("quaternion_wxyz").numbers<4>(kDirection);
  double square = 0.0;
  for (const double q : pose.quaternion_wxyz) square += q * q;
  if (std::fabs(square - 1) > kUnitTolerance)
    field.at("quaternion_wxyz").refuse("unit length to 1e-9", "divide it by its length");
  return pose;
}

SceneConfig parse_scene(const std::string& text, const std::string& file) {
  Json json = parse_json(text, file);
  for (const char* bodies : {"boxes", "spheres"}) {  // a scene names what it has; who reads it finds lists
    if (json.is_object() && !json.contains(bodies)) json[bodies] = Json::array();
  }
  const Field table(json, file, "");
  check_kind(table, "scene");
  table.only({"format", "kind", "name", "boxes", "spheres", "convex", "slit", "rod", "camera", "contact", "margins",
              "fixtures", "payload", "adapter"});
  SceneConfig out;
  out.name = table.at("name").name(40);
  const Field boxes = table.at("boxes");
  const Field spheres = table.at("spheres");
  const std::size_t box_count = boxes.size(0, 64, "at most 64 boxes");
  for (std::size_t i = 0; i < box_count; ++i) out.boxes.push_back(read_box(boxes.element(i)));
  const std::size_t sphere_count = spheres.size(0, 64, "at most 64 spheres");
  for (std::size_t i = 0; i < sphere_count; ++i) out.spheres.push_back(read_sphere(spheres.element(i)));
  if (json.contains("convex")) {
    const Field convex = table.at("convex");
    const std::size_t convex_count = convex.size(0, kMaxConvex, "at most 64 convex bodies");
    for (std::size_t i = 0; i < convex_count; ++i) read_convex(convex.element(i), out.convex);
  }
  check_names(table);
  if (json.contains("slit")) check_slit(table.at("slit"), out.slit.emplace(read_slit(table.at("slit"))));
  if (json.contains("rod")) out.rod = read_rod(table.at("rod"));
  if (json.contains("camera")) out.camera = read_camera(table.at("camera"));
  if (json.contains("contact")) out.contact = read_contact(table.at("contact"));
  for (const auto& [has, lacks] : {std::pair{"payload", "adapter"}, std::pair{"adapter", "payload"}}) {
    if (json.contains(has) && !json.contains(lacks))
      table.at(has).refuse("a payload and the adapter that it goes into, both or neither",
                           std::string("add ") + lacks + ", or leave " + has + " out");
  }
  if (json.contains("payload")) {
    out.payload = read_payload(table.at("payload"));
    out.adapter = read_adapter(table.at("adapter"));
  }
  if (json.contains("margins")) out.margins = read_margins(table.at("margins"));
  out.fixtures = json.contains("fixtures") ? read_fixtures(table.at("fixtures")) : slit_fixtures(out.slit, out.rod);
  out.canonical_json = canonical_json(json);
  if (out.canonical_json.size() > kMaxSceneBytes)
    throw std::runtime_error(file + ": " + std::to_string(out.canonical_json.size()) + " bytes as JSON: allowed are " +
                             std::to_string(kMaxSceneBytes) +
                             ", all bodies together; give fewer bodies or points, or numbers with fewer digits");
  return out;
}

SceneConfig load_scene(const std::string& path) { return parse_scene(read_text_file(path), path); }

}  // namespace liana::config
