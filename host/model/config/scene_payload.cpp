// A payload and the adapter that it goes into: checks of the table.
#include "host/model/config/scene_parts.hpp"

namespace liana::config {
namespace {

constexpr Range kMass{1, 1e5};
constexpr Range kInertia{-1e6, 1e6};
constexpr std::size_t kLongestPoseName = 64;
constexpr Range kRadius{0.01, 10};
constexpr double kMinLength_m = 0.05;

void read_start(const Field& field, ScenePayload& payload) {
  payload.on_arm = field.at("start").choice({"mechanism", "arm"}) == "arm";
  const Json& json = field.json();
  if (json.contains("fetch_pose")) payload.fetch_pose = field.at("fetch_pose").name(kLongestPoseName);
  if (payload.on_arm && !payload.fetch_pose.empty())
    field.at("fetch_pose").refuse("no fetch_pose of a payload that is on the arm from the start", "leave it out");
  if (json.contains("start_lateral_m")) payload.start_lateral_m = field.at("start_lateral_m").number({0, 0.02});
  if (json.contains("start_tilt_deg")) payload.start_tilt_deg = field.at("start_tilt_deg").number({0, 5});
}

// Of each principal moment the other two are no less; of a tensor's diagonal so, too, whatever the axes.
void check_inertia(const Field& field, const std::array<double, 6>& inertia) {
  const auto& [xx, yy, zz, xy, xz, yz] = inertia;
  if (xx > 0 && yy > 0 && zz > 0 && xx <= yy + zz && yy <= xx + zz && zz <= xx + yy) return;
  field.refuse("moments over 0 of which none is larger than the other two together", "compute it from the body");
}

}  // namespace

ScenePayload read_payload(const Field& field) {
  field.only({"position_m", "quaternion_wxyz", "mass_kg", "center_m", "inertia_kgm2", "length_m", "radius_m", "start",
              "fetch_pose", "start_lateral_m", "start_tilt_deg"});
  ScenePayload payload;
  payload.pose = read_pose(field);
  payload.mass_kg = field.at("mass_kg").number(kMass);
  payload.center_m = field.at("center_m").numbers<3>({-20, 20});
  payload.inertia_kgm2 = field.at("inertia_kgm2").numbers<6>(kInertia);
  check_inertia(field.at("inertia_kgm2"), payload.inertia_kgm2);
  payload.length_m = field.at("length_m").number({kMinLength_m, 20});
  payload.radius_m = field.at("radius_m").number(kRadius);
  read_start(field, payload);
  return payload;
}

ScenePose read_adapter(const Field& field) {
  field.only({"position_m", "quaternion_wxyz"});
  return read_pose(field);
}

}  // namespace liana::config
