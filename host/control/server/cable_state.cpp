// What a cable arm adds to the state message.
#include "host/control/server/cable_arm_server.hpp"
#include "host/control/server/state_parts.hpp"
#include "host/model/config/theta_numbers.hpp"

namespace liana::server {

namespace {

Json first(const cable::CableVector& values, std::int32_t count) {
  return Json(std::vector<double>(values.begin(), values.begin() + count));
}

// Null for the drives of a base that feeds.
Json tensions_json(const cable::RobotParams& table, const cable::CableVector& tension_N) {
  Json out = first(tension_N, table.cable_count());
  for (std::size_t i = 0; i < static_cast<std::size_t>(table.feed_count()); ++i) out[i] = Json();
  return out;
}

Json nodes_json(const cable::RobotParams& table, const cable::Outputs& outputs) {
  Json nodes = Json::array();
  for (std::size_t m = 0; m < static_cast<std::size_t>(table.segment_count); ++m)
    nodes.push_back(outputs.node_command_m[m]);
  return nodes;
}

const char* contact_state_name(cable::ContactState state) {
  switch (state) {
    case cable::ContactState::kMoving:
      return "moving";
    case cable::ContactState::kDithered:
      return "dithered";
    case cable::ContactState::kStuck:
      break;
  }
  return "stuck";
}

// Along an axis on which the force is not known it is null.
Json contact_json(const cable::ContactStatus& contact) {
  Json force_N = Json::array();
  for (std::size_t i = 0; i < contact.force_N.size(); ++i)
    force_N.push_back((contact.seen & 1u << i) != 0 ? Json(contact.force_N[i]) : Json());
  return {{"force_N", force_N},
          {"sd_N", contact.sd_N},
          {"state", contact_state_name(contact.state)},
          {"on_body", contact.on_body != 0},
          {"segment", contact.segment},
          {"torque_Nm", contact.torque_Nm}};
}

// Null before the first sample of a device in use; `hz` null before its first second is over.
Json rate_json(const device::SampleRate& rate) {
  if (rate.count() == 0) return nullptr;
  const std::optional<double> now_hz = rate.now_hz();
  return {{"hz", now_hz ? Json(*now_hz) : Json()}, {"min_s", rate.least_s()}, {"max_s", rate.most_s()}};
}

// A hand is slowed by whatever leaves it least: what is near, or what the pose has room for.
virtual_fixtures::Ease slowdown_of(const virtual_fixtures::Ease& ease, const cable::Outputs& outputs, bool engaged) {
  virtual_fixtures::Ease out = ease;
  if (!engaged) return out;
  if (outputs.speed_share < out.share) out = {outputs.speed_share, virtual_fixtures::SlowdownCause::kTension};
  if (outputs.lost_share < out.share) out = {outputs.lost_share, virtual_fixtures::SlowdownCause::kSingular};
  return out;
}

std::string ease_name(const virtual_fixtures::Ease& ease) {
  switch (ease.cause) {
    case virtual_fixtures::SlowdownCause::kNone:
      return "";
    case virtual_fixtures::SlowdownCause::kTension:
      return "tension";
    case virtual_fixtures::SlowdownCause::kSingular:
      return "near singular";
    case virtual_fixtures::SlowdownCause::kLag:
      return "arm lags";
    case virtual_fixtures::SlowdownCause::kRefused:
      return ease.limit;
    case virtual_fixtures::SlowdownCause::kJointLimit:
      break;
  }
  return "theta " + std::to_string(ease.theta) + " near its limit";
}

}  // namespace

std::vector<double> theta_deg(const cable::RobotParams& table, const cable::ThetaVector& theta_rad) {
  std::vector<double> out;
  for (std::size_t i = 0; i < static_cast<std::size_t>(table.theta_count()); ++i)
    out.push_back(in_degrees(theta_rad[i]));
  return out;
}

// Null while nothing can be claimed.
Json CableArmServer::clearance_json() const {
  if (!clearance_) return nullptr;
  const clearance_bound::Claim& claim = clearance_->claim();
  if (claim.clearance.link < 0) return nullptr;  // the scene is empty
  const Vec3 turn_rad = clearance_->turn_rad();
  return {{"distance_m", claim.clearance.distance_m},
          {"bound_m", claim.clearance.bound_m},
          {"body", clearance_->body_name()},
          {"link", claim.clearance.link + 1},
          {"where_m", claim.clearance.where_m},
          {"confidence", confidence_name(claim.confidence)},
          {"observation_age_s", claim.picture_age_s ? Json(*claim.picture_age_s) : Json()},
          {"camera", trouble_name(claim.trouble)},
          {"level", level_name(claim.level)},
          {"shift_m", clearance_->shift_m()},
          {"turn_deg", {in_degrees(turn_rad[0]), in_degrees(turn_rad[1]), in_degrees(turn_rad[2])}}};
}

// What fixtures make of the hand, and the two figures that they are felt by.
Json CableArmServer::guidance_json() const {
  const virtual_fixtures::Guidance& guidance = arbiter_.guidance();
  const virtual_fixtures::Ease slowdown = slowdown_of(arbiter_.ease(), outputs(), arbiter_.device().engaged());
  Json out{{"fixtures", Json::array()},
           {"plane", guidance.plane_name()},
           {"taken_away_m", guidance.taken_away_m()},
           {"yaw_limited", guidance.is_yaw_limited()},
           {"speed_share", slowdown.share},
           {"slowed_by", ease_name(slowdown)},
           {"pitch_allowed_deg", nullptr},
           {"pitch_used_deg", nullptr}};
  for (const config::SceneFixture& one : guidance.fixtures()) {
    if (guidance.is_chosen(one.name)) out["fixtures"].push_back(one.name);
  }
  const std::optional<virtual_fixtures::PitchBudget> budget = pitch_budget();
  if (!budget) return out;
  out["pitch_allowed_deg"] = in_degrees(budget->allowed_rad);
  out["pitch_used_deg"] = in_degrees(budget->used_rad);
  return out;
}

void CableArmServer::add_state(Json& state) const {
  const cable::Outputs& o = outputs();
  const arbiter::DeviceUse& device = arbiter_.device().in_use();
  const bool awaits_held = arbiter_.is_asking() && o.held_at_target == 0;  // a hold that was refused awaits nothing
  state["is_busy"] = arbiter_.is_busy() || (o.state == OperatingState::kEnabled && (o.at_rest == 0 || awaits_held));
  add_retract(state, arbiter_.retract_state());
  state["recovery"] = recovery_json(loss(), arbiter_.path_history());
  state["path"] = path_json(arbiter_.path());
  state["servo"] = servo_json(arbiter_.servo_report());
  state["device"] = device.name;
  state["device_engaged"] = arbiter_.device().engaged();
  state["device_reason"] = arbiter_.device().reason();
  state["device_samples"] = arbiter_.device().samples();
  state["device_rate"] = rate_json(arbiter_.device().rate());
  state["devices"] = devices_.summary();
  state["mapping"] = {{"scale", device.mapping.scale},
                      {"rotation_scale", device.mapping.rotation_scale},
                      {"frame", arbiter::name_of(device.mapping.frame)},
                      {"feedback", feedback_}};
  state["guidance"] = guidance_json();
  if (arbiter_.ease().cause == virtual_fixtures::SlowdownCause::kJointLimit) state["limits"].push_back("near_theta");
  if (o.lost_share < 1.0) state["limits"].push_back("near_singular");
  state["shape"] = {{"missing_m", shape_progress_.missing_m()},
                    {"settled", shape_progress_.is_settled() && !arbiter_.is_searching()},
                    {"searching", arbiter_.is_searching()}};
  state["clearance"] = clearance_json();
  state["planar_segments"] = planar_segments_;
  state["measured_js_deg"] = theta_deg(table_, o.theta_measured_rad);
  state["setpoint_js_deg"] = theta_deg(table_, o.theta_command_rad);
  state["measured_cp"] = pose_json(tip_pose(table_, arm_trig(table_, o.theta_measured_rad)));
  state["node_m"] = nodes_json(table_, o);
  state["held"] = config::theta_numbers(o.held_mask);
  state["held_at_target"] = o.held_at_target != 0;
  state["tension_N"] = tensions_json(table_, o.tension_measured_N);
  if (const std::uint32_t cells = cables_with_cells(table_); cells != 0)
    state["load_cells_lost"] = config::theta_numbers(cells & ~o.load_cells);
  state["friction"] = {{"mu", o.friction.mu},
                       {"sd", o.friction.sd},
                       {"planned_mu", o.friction.planned_mu},
                       {"declared_mu", table_.friction_mu},
                       {"not_as_declared", o.friction.not_as_declared != 0}};
  state["contact"] = contact_json(o.contact);
  state["payload"] = payload_json(arbiter_.carried().mass_kg, arbiter_.carried().center_in_tip_m);
  add_tip(state, o);
}

void CableArmServer::add_drive_state(std::size_t drive, Json& state) const {
  state["position_m"] = paid_out_m(table_.drive[drive], inputs().drive[drive]);
  if (drive >= static_cast<std::size_t>(table_.feed_count()))
    state["tension_N"] = reported_tension_N(table_.drive[drive], inputs().drive[drive]);
}

}  // namespace liana::server
