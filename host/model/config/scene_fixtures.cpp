// Virtual fixtures of a scene: checks of the table, and those that a slit has by itself.
#include <cmath>
#include <set>

#include "firmware_like/math/pose.hpp"
#include "host/model/config/scene_parts.hpp"

namespace liana::config {
namespace {

constexpr Range kAngle{-180, 180};   // degrees
constexpr double kOpen_m = 100.0;    // a slit is open along its width
constexpr double kBefore_m = 0.2;    // of the mouth: what guides begins here, while the tip is in the open
constexpr double kApproach_m = 0.3;  // of the way to the rod
constexpr double kApproachRadius_m = 0.01;

const std::vector<std::string> kKinds{"plane", "walls", "axis"};  // in the order of FixtureKind

FixtureKind read_kind(const Field& field) {
  const std::string word = field.choice(kKinds);
  return word == "plane" ? FixtureKind::kPlane : word == "walls" ? FixtureKind::kWalls : FixtureKind::kAxis;
}

std::set<std::string> known_members(FixtureKind kind) {
  std::set<std::string> known{"name", "kind", "frame", "depth_m", "half_width_m", "half_gap_m"};
  if (kind == FixtureKind::kPlane) known.insert("yaw_deg");
  if (kind == FixtureKind::kAxis) known.insert({"radius_m", "opening_deg"});
  return known;
}

void read_yaw(const Field& field, SceneFixture& fixture) {
  const auto range = field.numbers<2>(kAngle);
  if (range[0] > range[1]) field.refuse("the lower angle first", "exchange the two");
  fixture.yaw_low_deg = range[0];
  fixture.yaw_high_deg = range[1];
}

SceneFixture read_fixture(const Field& field) {
  SceneFixture fixture;
  fixture.name = field.at("name").name(40);
  fixture.kind = read_kind(field.at("kind"));
  field.only(known_members(fixture.kind));
  field.at("frame").only({"position_m", "quaternion_wxyz"});
  fixture.frame = read_pose(field.at("frame"));
  fixture.depth_m = field.at("depth_m").number(kLength);
  fixture.half_width_m = field.at("half_width_m").number(kLength);
  fixture.half_gap_m = field.at("half_gap_m").number({0, 10, true});
  if (field.json().contains("yaw_deg")) read_yaw(field.at("yaw_deg"), fixture);
  if (fixture.kind == FixtureKind::kAxis) fixture.radius_m = field.at("radius_m").number({0, 10, true});
  if (field.json().contains("opening_deg")) fixture.opening_deg = field.at("opening_deg").number({0, 80});
  return fixture;
}

// The last piece of the way to the rod, which is along the rod frame's x.
SceneFixture approach(const SceneSlit& slit, const SceneRod& rod) {
  SceneFixture out{"slit_approach", FixtureKind::kAxis, rod.pose, kApproach_m, kOpen_m, slit.half_gap_m};
  const Vec3 back = rotate(rod.pose.quaternion_wxyz, {-kApproach_m, 0.0, 0.0});
  out.frame.position_m = add(rod.pose.position_m, back);
  out.radius_m = kApproachRadius_m;
  return out;
}

}  // namespace

std::vector<SceneFixture> read_fixtures(const Field& list) {
  std::vector<SceneFixture> fixtures(list.size(0, kMaxFixtures, "at most 16 fixtures"));
  std::set<std::string> names;
  for (std::size_t i = 0; i < fixtures.size(); ++i) {
    fixtures[i] = read_fixture(list.element(i));
    if (!names.insert(fixtures[i].name).second)
      list.element(i).at("name").refuse("a name that no other fixture has", "rename one of the two");
  }
  return fixtures;
}

std::vector<SceneFixture> slit_fixtures(const std::optional<SceneSlit>& slit, const std::optional<SceneRod>& rod) {
  if (!slit) return {};
  const double depth_m = slit->end_u_m - slit->mouth_u_m;
  ScenePose before = slit->frame;
  before.position_m = add(before.position_m, scale(slit->u_axis, -kBefore_m));
  std::vector<SceneFixture> out{
      {"slit_plane", FixtureKind::kPlane, before, kBefore_m + depth_m, kOpen_m, slit->half_gap_m},
      {"slit_walls", FixtureKind::kWalls, slit->frame, depth_m, kOpen_m, slit->half_gap_m}};
  if (rod) out.push_back(approach(*slit, *rod));
  return out;
}

}  // namespace liana::config
