// What a cable arm's desk makes of the scene's fixtures: where scene and tip are believed to be for them, and the
// figures by which they are felt.
#include "host/api/request_error.hpp"
#include "host/daemon/cable_desk.hpp"

namespace liana::daemon {

cable::ThetaVector CableDesk::believed_rad() const {
  cable::ThetaVector theta_rad = outputs().theta_measured_rad;
  for (std::size_t k = 0; k < theta_rad.size(); ++k) theta_rad[k] += outlook_.theta_off_rad[k];
  return theta_rad;
}

// The tip as it is believed to be beside where it is commanded; where nothing can be claimed, nothing is believed.
fixture::Sight CableDesk::sight() const {
  if (!clearance_) return {outlook_.drawing_in_base, {}, {}};
  const Pose tip = tip_pose(table_, arm_trig(table_, believed_rad())), &told = outputs().tip_command;
  return {outlook_.drawing_in_base, subtract(tip.position_m, told.position_m),
          rotation_vector(multiply(tip.quaternion, conjugate(told.quaternion)))};
}

std::optional<fixture::PitchBudget> CableDesk::pitch_budget() const {
  const std::int32_t planar = fixture::planar_of_mask(table_, outputs().held_mask);
  if (!scene_.slit || planar == 0) return std::nullopt;
  const double room_m = scene_.slit->half_gap_m - robot_.module_radius_m;
  return fixture::pitch_budget(table_, planar, room_m, believed_rad(), outputs().theta_command_rad);
}

// The smaller of what is certainly free and what the pitch budget leaves the tip. Where nothing is known: none.
double CableDesk::tip_room_m() const {
  const std::optional<fixture::PitchBudget> budget = pitch_budget();
  if (!clearance_ || !budget) return 0.0;
  const std::int32_t planar = fixture::planar_of_mask(table_, outputs().held_mask);
  return std::min(clearance_->claim().clearance.distance_m, budget->left_m(fixture::pitch_lever_m(table_, planar)));
}

std::vector<fixture::FeltPlane> CableDesk::felt_fixtures() const {
  const arbiter::DeviceSteer& device = arbiter_.device();
  if (!device.engaged()) return {};
  const fixture::HandMap map{device.anchor().hand_in_device.position_m, device.anchor().tip_in_base.position_m,
                             device.in_use().mapping.scale};
  return fixture::feel_scene(arbiter_.guidance(), outputs().tip_command.position_m, tip_room_m(),
                             robot_.module_radius_m, map);
}

fixture::Choice CableDesk::chosen_fixtures(const api::Arguments& fields) const {
  const std::vector<std::string> names = fields.texts("fixtures");
  for (const std::string& name : names) {
    if (arbiter_.guidance().knows(name)) continue;
    std::string known;
    for (const config::SceneFixture& one : scene_.fixtures) known += (known.empty() ? "" : ", ") + one.name;
    throw api::RequestError("out_of_range", "fixtures = " + name + ": allowed " +
                                                (known.empty() ? "none, the scene has no fixtures" : known) +
                                                ": name one of the scene's, or leave it out for all");
  }
  return fields.has("fixtures") ? fixture::Choice(names) : std::nullopt;
}

}  // namespace liana::daemon
