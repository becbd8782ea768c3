// What a cable arm's desk makes of the scene's fixtures: where scene and tip are believed to be for them, and the
// figures by which they are felt.
#include <algorithm>

#include "host/api/server/request_error.hpp"
#include "host/base/options/nearest.hpp"
#include "host/control/server/cable_arm_server.hpp"

namespace liana::server {

namespace {

constexpr std::uint32_t kPushes = LIANA_X | LIANA_Y | LIANA_Z;
constexpr double kBeforeStops_m = 0.005;  // the workspace's ends are felt so far before the device's own stops

}  // namespace

cable::ThetaVector CableArmServer::believed_rad() const {
  cable::ThetaVector theta_rad = outputs().theta_measured_rad;
  for (std::size_t k = 0; k < theta_rad.size(); ++k) theta_rad[k] += outlook_.theta_off_rad[k];
  return theta_rad;
}

// The tip as it is believed to be beside where it is commanded; where nothing can be claimed, nothing is believed.
virtual_fixtures::Sight CableArmServer::sight() const {
  if (!clearance_) return {outlook_.drawing_in_base, {}, {}};
  const Pose tip = tip_pose(table_, arm_trig(table_, believed_rad())), &told = outputs().tip_command;
  return {outlook_.drawing_in_base, subtract(tip.position_m, told.position_m),
          rotation_vector(multiply(tip.quaternion, conjugate(told.quaternion)))};
}

std::optional<virtual_fixtures::PitchBudget> CableArmServer::pitch_budget() const {
  const std::int32_t planar = virtual_fixtures::planar_of_mask(table_, outputs().held_mask);
  if (!scene_.slit || planar == 0) return std::nullopt;
  const double room_m = scene_.slit->half_gap_m - robot_.module_radius_m;
  return virtual_fixtures::pitch_budget(table_, planar, room_m, believed_rad(), outputs().theta_command_rad);
}

// The smaller of what is certainly free and what the pitch budget leaves the tip. Where nothing is known: none.
double CableArmServer::tip_room_m() const {
  const std::optional<virtual_fixtures::PitchBudget> budget = pitch_budget();
  if (!clearance_ || !budget) return 0.0;
  const std::int32_t planar = virtual_fixtures::planar_of_mask(table_, outputs().held_mask);
  return std::min(clearance_->claim().clearance.distance_m,
                  budget->left_m(virtual_fixtures::pitch_lever_m(table_, planar)));
}

// A refused command makes new anchors without the hand letting go.
void CableArmServer::note_grip() {
  const arbiter::TeleopInput& steer = arbiter_.device();
  const virtual_fixtures::HandMap now{steer.anchor().hand_in_device.position_m, steer.anchor().tip_in_base.position_m,
                                      steer.in_use().mapping.scale, grip_.grip + 1};
  if (now.hand_anchor_m != grip_.hand_anchor_m || now.tip_anchor_m != grip_.tip_anchor_m || now.scale != grip_.scale)
    grip_ = now;
}

// What the hand of the device in use is to feel: the ends of a workspace in which the device can push, and, while it
// steers, the scene's fixtures.
virtual_fixtures::PlaneSlots::Told CableArmServer::haptic_planes() {
  const device::Device* device = devices_.in_use();
  if (device == nullptr || !device->newest(0)) return plane_slots_.next({}, {});
  std::vector<virtual_fixtures::HapticPlane> planes;
  const liana_hand& can = device->capability().hand[0];
  if ((can.actuated & kPushes) == kPushes) {
    planes = virtual_fixtures::feel_workspace({can.low_m[0], can.low_m[1], can.low_m[2]},
                                              {can.high_m[0], can.high_m[1], can.high_m[2]}, kBeforeStops_m);
  }
  if (arbiter_.device().engaged()) {
    note_grip();
    const auto felt = virtual_fixtures::feel_scene(arbiter_.guidance(), outputs().tip_command.position_m, tip_room_m(),
                                                   robot_.module_radius_m, grip_);
    planes.insert(planes.end(), felt.begin(), felt.end());
  }
  return plane_slots_.next(planes, device->newest(0)->pose.position_m);
}

virtual_fixtures::Choice CableArmServer::chosen_fixtures(const api::Arguments& fields) const {
  const std::vector<std::string> names = fields.texts("fixtures");
  for (const std::string& name : names) {
    if (arbiter_.guidance().knows(name)) continue;
    std::vector<std::string> known;
    for (const config::SceneFixture& one : scene_.fixtures) known.push_back(one.name);
    throw api::RequestError(
        "out_of_range", "fixtures = " + name + ": allowed " +
                            (known.empty() ? "none, the scene has no fixtures" : options::allowed_names(name, known)) +
                            ": name one of the scene's, or leave it out for all");
  }
  if (!has_fixtures_) return virtual_fixtures::Choice(std::vector<std::string>{});
  return fields.has("fixtures") ? virtual_fixtures::Choice(names) : std::nullopt;
}

}  // namespace liana::server
