#include "host/control/server/cable_arm_server.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "firmware_like/math/trig.hpp"
#include "host/control/force_control/requests.hpp"
#include "host/model/config/slit_mouth.hpp"
#include "host/planning/planner/check/plan_check.hpp"
#include "host/planning/planner/check/way_check.hpp"

namespace liana::server {

namespace {

constexpr double kSlowShare = 0.5;  // of the tip's speed in the slit, where the claim says slow down

bool lengths_are_sound(const FaultList& faults) {
  for (std::int32_t i = 0; i < faults.count; ++i) {
    const FaultNumber number = faults.fault[static_cast<std::size_t>(i)].number;
    if (number == FaultNumber::kCableSlip || number == FaultNumber::kCableBreak) return false;
  }
  return true;
}

arbiter::SpeedZone zone_of(const config::RobotConfig& robot, const config::SceneConfig& scene) {
  return {scene.slit, robot.table.limits.tip_speed_slit_m_s};
}

std::unique_ptr<verification::SimulationVerifier<cable::CableArm>> simulation_verifier(
    const config::RobotConfig& robot, const config::SceneConfig& scene) {
  return std::make_unique<verification::SimulationVerifier<cable::CableArm>>(
      simulation::arm_model(robot),
      verification::MotionRules{robot.table, scene, zone_of(robot, scene), robot.machine, robot.module_radius_m});
}

// Called in another thread: it has all it needs with it.
arbiter::PathCheck<cable::CableArm> path_check(const config::RobotConfig& robot, const config::SceneConfig& scene) {
  return [robot, scene](const std::vector<cable::ThetaVector>& points_rad, std::optional<double> margin_m) {
    if (!margin_m) return planner::refusal_of_move(robot, scene, points_rad.front(), points_rad.back());
    return planner::refusal_of_way(robot, scene, points_rad, *margin_m, arbiter::kPathOff_m);
  };
}

// `what`, with how regularly the samples of `name` came.
event::Event device_event(event::DeviceEvent what, const std::string& name, const device::SampleRate& rate,
                          double rate_hz) {
  char text[200];
  const double min_ms = 1e3 * rate.least_s(), max_ms = 1e3 * rate.most_s();
  if (what == event::DeviceEvent::kLeft) {
    std::snprintf(text, sizeof text, "device %s is left: %llu samples at %.1f Hz, intervals %.1f to %.1f ms",
                  name.c_str(), static_cast<unsigned long long>(rate.count()), rate_hz, min_ms, max_ms);
  } else if (what == event::DeviceEvent::kSlow) {
    std::snprintf(text, sizeof text,
                  "device %s gives %.1f samples a second, least are %.0f: its driver or the way here is too slow",
                  name.c_str(), rate_hz, device::kMinRate_hz);
  } else {
    std::snprintf(text, sizeof text, "device %s gives %.1f samples a second again", name.c_str(), rate_hz);
  }
  return {.kind = event::EventKind::kDevice,
          .number = event::number_of(what),
          .subject = name,
          .values = {{"rate_hz", rate_hz},
                     {"min_s", rate.least_s()},
                     {"max_s", rate.most_s()},
                     {"samples", static_cast<double>(rate.count())}},
          .text = text};
}

// Friction that turned out to be another one than declared, or is as declared again.
event::Event friction_event(const cable::FrictionStatus& friction, double declared_mu) {
  const bool off = friction.not_as_declared != 0;
  char text[200];
  std::snprintf(
      text, sizeof text,
      off ? "friction mu %.3f +- %.3f found, %.3f declared: tensions are planned with what was found; measure "
            "again (liana calibrate --friction)"
          : "friction mu %.3f +- %.3f found, as declared (%.3f)",
      friction.mu, friction.sd, declared_mu);
  return {.kind = event::EventKind::kFriction,
          .number = off ? event::number_of(FaultNumber::kFrictionNotAsDeclared) : 0,
          .values = {{"mu", friction.mu}, {"sd", friction.sd}, {"declared_mu", declared_mu}},
          .text = text};
}

event::Event load_cell_event(std::size_t cable, bool is_lost) {
  const auto number = static_cast<double>(cable + 1);
  char text[120];
  std::snprintf(text, sizeof text, "load cell of cable %.0f: tension is by %s", number,
                is_lost ? "the drive's torque; check cell, amplifier and plug" : "the cell again");
  return {.kind = event::EventKind::kLoadCell,
          .number = is_lost ? event::number_of(FaultNumber::kLoadCellLost) : 0,
          .values = {{"cable", number}},
          .text = text};
}

}  // namespace

CableArmServer::CableArmServer(const config::RobotConfig& robot, const config::SceneConfig& scene,
                               const std::string& in_pose, timing::TimeMode time_mode,
                               realtime::ArmMailbox<cable::CableArm>& link, const device::DeviceEndpoint& devices)
    : TypedArmServer(robot.table, zone_of(robot, scene), time_mode, link, simulation_verifier(robot, scene),
                     taken(time_mode), path_check(robot, scene),
                     virtual_fixtures::Guidance(robot.table, scene.fixtures, robot.module_radius_m)),
      robot_(robot),
      scene_(scene),
      names_(robot),
      homing_(robot_, in_pose),
      shape_progress_(robot.table),
      devices_(devices, robot.table.interval_ticks * robot.table.tick_s, robot.table.limits.tip_speed_m_s),
      device_state_(robot.table.interval_ticks * robot.table.tick_s) {
  handlers_["move_cp"] = [this](const MotionRequest& r) { move_line(r.fields); };
  handlers_["hold_theta"] = [this](const MotionRequest& r) { hold_theta(r.fields.entries("held")); };
  handlers_["payload"] = [this](const MotionRequest& r) { carry(r.fields); };
  handlers_["shape"] = [this](const MotionRequest& r) { shape(r.fields); };
  handlers_["dither"] = [this](const MotionRequest& r) {
    arbiter_.dither(outputs(), r.fields.number("share"), r.fields.number("duration_s"));
  };
  handlers_["use_device"] = [this](const MotionRequest& r) { use_device(r.fields); };
  handlers_["devices"] = [](const MotionRequest&) {};  // only looks
}

// The slit is looked at by the commanded angles: they have no noise.
void CableArmServer::watch(bool booted) {
  shape_progress_.note(outputs(), arbiter_.nodes(), arbiter_.keep_clear());
  if (booted) homing_.look(report(), link_.image.value().controller.arm().estimator());
  watch_loss();
  watch_clearance();
  arbiter_.see(sight());
  if (!scene_.slit) return;
  const cable::LinkPoints links = link_points(table_, outputs().theta_command_rad);
  const inverse_kinematics::SlitMouth mouth = config::slit_mouth(*scene_.slit, robot_.module_radius_m);
  planar_segments_ =
      inverse_kinematics::planar_segments(table_, links, mouth, inverse_kinematics::PlanarSwitch{}, planar_segments_);
}

// Verified as the motion is, it is no more than its cables that are left: what stands in its way shows in them.
void CableArmServer::watch_loss() {
  if (outputs().state == OperatingState::kEnabled) called_whole_.clear();  // it has taken tension
  const std::string over = overpulled_cable(loss());
  if (!over.empty() && arbiter_.is_going_back()) arbiter_.hold(over);
}

std::string CableArmServer::why_not_clear(std::int64_t whole) {
  std::string why = why_loss_stands(loss());
  const std::vector<std::size_t> lost = lost_cables(loss());
  const auto cable = static_cast<std::size_t>(whole - 1);
  if (whole == 0) return why;
  if (whole < 1 || std::find(lost.begin(), lost.end(), cable) == lost.end())
    return "cable " + std::to_string(whole) + " is not lost" + (why.empty() ? "" : ": " + why);
  if (lost.size() > 1) return why;
  if (!why.empty()) call_whole(cable);
  return "";
}

std::vector<std::size_t> CableArmServer::lost() const {
  std::vector<std::size_t> cables = lost_cables(loss());
  cables.insert(cables.end(), called_whole_.begin(), called_whole_.end());
  return cables;
}

void CableArmServer::call_whole(std::size_t cable) {
  if (std::find(called_whole_.begin(), called_whole_.end(), cable) == called_whole_.end())
    called_whole_.push_back(cable);
}

std::string CableArmServer::why_not_recover() const { return server::why_not_recover(loss(), arbiter_.path_history()); }

bool CableArmServer::recovers() const { return cable::does_without(loss().release) && outputs().faults.count == 0; }

std::string CableArmServer::why_not_taut() const { return slack_cables(loss()); }

bool CableArmServer::is_untrue() const {
  return std::any_of(called_whole_.begin(), called_whole_.end(), [&](std::size_t cable) {
    return outputs().tension_measured_N[cable] < table_.tension.floor_anywhere_N;
  });
}

// An arm whose cables have slipped or broken, or that is not homed, may be anywhere: nothing is claimed of it, and what
// the camera has shown with such angles is forgotten. The scene stands where it was seen to stand.
void CableArmServer::watch_clearance() {
  if (!homing_.not_homed().is_homed() || !lengths_are_sound(outputs().faults) || cable::does_without(loss().release)) {
    clearance_.reset();
    foresee({{}, outlook_.drawing_in_base, std::max(outlook_.prediction_m, scene_.margins.prediction_m)});
    return arbiter_.cap_tip_speed(table_.limits.tip_speed_m_s);
  }
  if (!clearance_) clearance_.emplace(robot_, scene_);
  const clearance_bound::Claim& claim = clearance_->look(tick() - 1, outputs().theta_measured_rad);
  foresee(clearance_->outlook());
  const bool slow = claim.level != clearance_bound::Level::kFree;
  arbiter_.cap_tip_speed(slow ? kSlowShare * table_.limits.tip_speed_slit_m_s : table_.limits.tip_speed_m_s);
}

void CableArmServer::foresee(const clearance_bound::Outlook& outlook) {
  outlook_ = outlook;
  simulation_->believe(outlook.theta_off_rad, outlook.drawing_in_base, outlook.prediction_m);
}

void CableArmServer::take_observation(const CameraObservation& picture) {
  TypedArmServer::take_observation(picture);
  if (!clearance_) return;
  const auto capture_tick = static_cast<std::uint64_t>(std::llround(picture.capture_time_s / table_.tick_s));
  clearance_->see({capture_tick, picture.slit_in_tip, picture.rod_in_tip}, tick() - 1);
}

void CableArmServer::take_samples() { devices_.take_samples(arbiter_.device(), table_.interval_ticks * table_.tick_s); }

void CableArmServer::tell_devices(std::int64_t now_us) {
  const cable::Outputs& o = outputs();
  ArmForDevices arm{.tick = tick(),
                    .arm_time_us = now_us,
                    .is_enabled = o.state == OperatingState::kEnabled,
                    .measured_tip = tip_pose(table_, arm_trig(table_, o.theta_measured_rad)),
                    .commanded_tip = o.tip_command,
                    .predicted_tip = predicted_tip_};
  if (clearance_ && clearance_->claim().clearance.link >= 0) arm.clearance_m = clearance_->claim().clearance.distance_m;
  arm.planes = haptic_planes();
  device_state_.look(arm, table_.tick_s);
  devices_.tell(device_state_, arbiter_.device(), now_us);
}

Json CableArmServer::ask(const MotionRequest& request) {
  TypedArmServer::ask(request);
  return std::string_view(request.op) == "devices" ? devices_.details() : Json::object();
}

// What a released command was made of, and where the twin ends with it, is told to the devices.
std::optional<LastVerdict> CableArmServer::release_next(bool may_release, std::uint32_t owner) {
  std::optional<LastVerdict> verdict = TypedArmServer::release_next(may_release, owner);
  if (!verdict || !verdict->released) return verdict;
  const arbiter::TeleopInput& steer = arbiter_.device();
  if (steer.engaged() && steer.made_of_us() >= 0)
    verdict->source_stamp = SourceStamp{steer.made_of_us(), steer.made_from_us()};
  device_state_.note_release(verdict->first_tick, steer.engaged() ? steer.made_of_us() : -1);
  cable::ThetaVector theta_rad{};
  for (std::size_t i = 0; i < verdict->twin_js_deg.size(); ++i) theta_rad[i] = verdict->twin_js_deg[i] * kDegree;
  predicted_tip_ = tip_pose(table_, arm_trig(table_, theta_rad));
  return verdict;
}

void CableArmServer::drop_motion() {
  arbiter_.hold();
  arbiter_.use_device(outputs(), arbiter::DeviceUse{});
}

std::vector<event::Event> CableArmServer::take_events() {
  std::vector<event::Event> events = devices_.take_events();
  tell_device(events);
  tell_load_cells(events);
  const cable::FrictionStatus& friction = outputs().friction;
  if ((friction.not_as_declared != 0) == friction_is_off_) return events;
  friction_is_off_ = friction.not_as_declared != 0;
  events.push_back(friction_event(friction, table_.friction_mu));
  return events;
}

void CableArmServer::tell_load_cells(std::vector<event::Event>& events) {
  if (outputs().homed == 0) return;  // until then they may still be starting
  const std::uint32_t lost = cables_with_cells(table_) & ~outputs().load_cells;
  for (std::size_t c = 0; c < as_index(table_.cable_count()); ++c) {
    if ((lost ^ load_cells_lost_) >> c & 1u) events.push_back(load_cell_event(c, (lost >> c & 1u) != 0));
  }
  load_cells_lost_ = lost;
}

void CableArmServer::tell_device(std::vector<event::Event>& events) {
  using enum event::DeviceEvent;
  if (const auto ended = arbiter_.device().take_ended_use()) {
    device_is_slow_ = false;
    events.push_back(device_event(kLeft, ended->name, ended->rate, ended->rate.mean_hz()));
  }
  const device::SampleRate& rate = arbiter_.device().rate();
  if (rate.is_slow() == device_is_slow_) return;
  device_is_slow_ = rate.is_slow();
  events.push_back(device_event(device_is_slow_ ? kSlow : kFastAgain, arbiter_.device().in_use().name, rate,
                                rate.now_hz().value_or(0.0)));
}

std::vector<double> CableArmServer::joints_deg(const cable::Outputs& outputs) const {
  return theta_deg(table_, outputs.theta_command_rad);
}

void CableArmServer::move_line(const api::Arguments& fields) {
  if (fields.has("hold")) hold_theta(fields.entries("hold"));
  arbiter_.move_line(outputs(), fields.pose("goal"), swings_of(fields));
}

void CableArmServer::hold_theta(const std::vector<api::Arguments>& held) {
  std::uint32_t mask = 0;
  cable::ThetaVector held_rad{};
  for (const api::Arguments& entry : held) {
    const auto i = static_cast<std::size_t>(entry.integer("theta")) - 1;
    if ((mask & 1u << i) != 0)
      throw api::RequestError("bad_request", "held: theta " + std::to_string(i + 1) + " stands twice; leave one out");
    held_rad[i] = entry.number("target_deg") * kDegree;
    mask |= 1u << i;
  }
  arbiter_.hold_theta(outputs(), mask, held_rad);
}

void CableArmServer::shape(const api::Arguments& fields) {
  cable::NodeTargets nodes{};
  std::size_t count = 0;
  for (const api::Arguments& entry : fields.entries("nodes")) {
    const auto node = static_cast<std::int32_t>(entry.integer("node"));
    const double weight = entry.has("weight") ? entry.number("weight") : default_node_weight(table_, node);
    nodes[count++] = {node, entry.point("position_m"), weight, entry.number("threshold_m")};
  }
  cable::KeepClearTargets clear{};
  count = 0;
  for (const api::Arguments& entry : fields.entries("keep_clear"))
    clear[count++] = {entry.point("center_m"), entry.number("distance_m"), entry.number("weight")};
  arbiter_.shape(outputs(), nodes, clear, fields.flag("search"));
  shape_progress_.restart();
}

void CableArmServer::carry(const api::Arguments& fields) {
  const cable::TipLoad payload = force_control::tip_load_of(fields);
  config::RobotConfig loaded = robot_;
  loaded.table.tool = joined(robot_.table.tool, payload);
  planner::PlanCheck check;
  planner::check_tension(loaded.table, {outputs().theta_command_rad}, check);
  const std::string why = planner::tension_refusal(loaded.table, check, loaded.table.tension.ceiling_free_N);
  if (!why.empty()) throw api::RequestError("refused", "with this payload " + why);
  arbiter_.carry(outputs(), payload, path_check(loaded, scene_));
  simulation_->carry(loaded.table.tool);
}

void CableArmServer::use_device(const api::Arguments& fields) {
  arbiter::DeviceUse use;
  use.name = fields.text("device");
  use.kind = devices_.kind_of(use.name);
  use.mapping.scale = fields.number("scale");
  use.mapping.rotation_scale = fields.number("rotation_scale");
  if (fields.has("frame")) use.mapping.frame = arbiter::frame_of(fields.text("frame"));
  use.node = static_cast<std::int32_t>(fields.integer("node"));
  use.speed_m_s = fields.number("speed_m_s");
  use.anywhere = fields.flag("anywhere");
  const virtual_fixtures::Choice fixtures = chosen_fixtures(fields);
  arbiter_.use_device(outputs(), use);
  arbiter_.choose_fixtures(fixtures);
  feedback_ = fields.has("feedback") ? fields.text("feedback") : "aligned";
}

}  // namespace liana::server
