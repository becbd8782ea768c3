#include "host/daemon/service.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string_view>

#include "host/api/request_error.hpp"
#include "host/canopen/emergency.hpp"
#include "host/config/slit_mouth.hpp"

namespace liana {

namespace {

constexpr double kLockstepPatience_s = 10.0;  // a client that stays silent longer is dead
constexpr double kAfterMission_s = 1.0;       // of arm time: the hold at the end of the mission comes to rest
constexpr double kHoming_s = 0.5;             // of arm time after booting: homing takes 0.1 s
constexpr double kShutdownLimit_s = 10.0;     // of arm time, until the drives are off

double reach_of(const cable::RobotTable& table) {
  double reach_m = 0.0;
  for (std::size_t m = 0; m < static_cast<std::size_t>(table.segment_count); ++m) {
    reach_m += table.segment[m].modules * table.segment[m].module_length_m;
  }
  return reach_m;
}

}  // namespace

Service::Service(const ServiceConfig& config, Link& link)
    : config_(config),
      link_(link),
      reach_m_(reach_of(config.robot.table)),
      homing_(config_.robot, config.in_pose),
      zone_(config.scene.slit, config.robot.table.limits.tip_speed_slit_m_s),
      arbiter_(config.robot.table, zone_,
               config.time_mode == TimeMode::kReal ? SearchResult::kWhenThere : SearchResult::kInItsInterval),
      shape_progress_(config.robot.table),
      server_(config.api_path, *this) {}

void Service::wait_for(const std::vector<Role>& roles, double timeout_s) {
  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + std::chrono::duration<double>(timeout_s);
  for (const Role role : roles) {
    while (!server_.has_role(role)) {
      server_.pump(0.05);
      if (Clock::now() > deadline)
        throw std::runtime_error("--expect: a client with role '" + std::string(role_name(role)) +
                                 "' did not come within the time");
    }
  }
}

void Service::cycle() {
  link_.report.refresh();
  link_.image.refresh();
  watch_arm();
  watch_homing();
  watch_slit();
  watch_shape();
  forward_ticks();
  idle(0.0);  // what came from clients outside lockstep
  forward_camera();
  publish_state();
  if (config_.time_mode != TimeMode::kReal) server_.wait_done(tick(), kLockstepPatience_s);
  server_.dispatch();
  release_next();
}

void Service::idle(double timeout_s) {
  server_.pump(timeout_s);
  server_.dispatch();
}

void Service::watch_shape() {
  shape_progress_.note(now(), arbiter_.nodes(), arbiter_.keep_clear());
  notes_.shape = {shape_progress_.missing_m(), shape_progress_.is_settled() && !arbiter_.is_searching(),
                  arbiter_.is_searching()};
}

void Service::publish_state() {
  if (!server_.has_subscriber(Topic::kState)) return;
  const Json state = state_message(config_.robot.table, config_.buses, link_.report.value(), arbiter_, owner_, notes_);
  const char* name = state_name(link_.report.value());
  server_.publish(Topic::kState, state.dump(),
                  name != published_);  // a slow reader may lose states, but no change of state
  published_ = name;
}

// A clear says what it looked at, and what kept it from clearing.
void Service::note_clear() {
  const ClearReport& clear = link_.image.value().controller.supervisor().clear;
  if (clear.tick == clear_seen_tick_) return;
  clear_seen_tick_ = clear.tick;
  const auto names = [](std::uint32_t conditions) {
    std::string text;
    for (std::uint32_t bit = 1; bit != 0; bit <<= 1) {
      if ((conditions & bit) != 0) text += (text.empty() ? "" : ", ") + std::string(condition_name(bit));
    }
    return text;
  };
  note((clear.missing == 0 ? "faults cleared" : "faults not cleared, not met: " + names(clear.missing)) +
       "; checked: " + names(clear.checked));
}

// By the commanded angles: they have no noise.
void Service::watch_slit() {
  if (!config_.scene.slit) return;
  const cable::RobotTable& table = config_.robot.table;
  const cable::LinkPoints links = link_points(table, link_.report.value().outputs.theta_command_rad);
  const solve::SlitMouth mouth = slit_mouth(*config_.scene.slit, config_.robot.module_radius_m);
  notes_.planar_segments = solve::planar_segments(table, links, mouth, solve::PlanarSwitch{}, notes_.planar_segments);
}

// An arm that is not homed some time after booting says why, once; the refusal to enable it says how it stands.
void Service::watch_homing() {
  if (boot_seen_ != BootPhase::kDone) return;
  homing_.look(link_.report.value(), link_.image.value().controller.arm().estimator());
  notes_.homed = homing_.is_homed();
  if (!homing_due_tick_ || tick() < *homing_due_tick_) return;
  homing_due_tick_.reset();
  if (!homing_.is_homed()) note("not homed: " + homing_.why_not());
}

// What changes by itself: the end of booting, the end of the run after the mission.
void Service::watch_arm() {
  note_clear();
  for (const std::string& change : trouble_.changes(config_.buses, link_.report.value())) note(change);
  if (mission_end_tick_) {
    const double since_s = static_cast<double>(tick() - *mission_end_tick_) * config_.robot.table.tick_s;
    if (since_s > kAfterMission_s) begin_shutdown("the mission has ended");
  } else if (dismissed_) {
    begin_shutdown("asked for");
  }
  const BootPhase boot = link_.report.value().boot;
  if (boot == boot_seen_) return;
  boot_seen_ = boot;
  if (boot == BootPhase::kDone) {
    note("all drives are booted");
    notes_.serials = config_.serials();
    homing_due_tick_ = tick() + static_cast<std::uint64_t>(std::lround(kHoming_s / config_.robot.table.tick_s));
  }
  if (boot != BootPhase::kFailed) return;
  notes_.boot_problems = config_.boot_problems();
  note("booting failed: " + text_of(notes_.boot_problems));
}

// What a drive reports beside its statusword; whether it is a fault, its statusword says.
void Service::note_emergencies(const cable::Inputs& inputs) {
  for (std::size_t i = 0; i < inputs.drive.size(); ++i) {
    const std::uint16_t code = inputs.drive[i].emergency_code;
    if (code == 0) continue;
    char text[96];
    std::snprintf(text, sizeof text, "drive %zu sent emergency 0x%04X: %s", i, static_cast<unsigned>(code),
                  canopen::emergency_text(code));
    note(text);
  }
}

// Tick records and controller images for the archive. The image before the first tick makes a recording complete.
void Service::forward_ticks() {
  const bool wanted = server_.has_subscriber(Topic::kTick);
  const TwinImage& image = link_.image.value();
  const std::uint64_t lost = link_.report.value().records_lost + server_.dropped_ticks();
  while (const TickRecord* record = link_.ticks.front()) {
    note_emergencies(record->inputs);
    if (wanted) server_.publish(Topic::kTick, tick_packet(*record, lost, counts_of(config_.robot.table)));
    link_.ticks.pop();
  }
  if (boot_seen_ == BootPhase::kBooting || !wanted) return;
  if (image_sent_ && image.next_tick % kImageEveryTicks != 0) return;
  server_.publish(Topic::kTick, image.fresh ? image_packet(image.next_tick, config_.robot.table)
                                            : image_packet(image.next_tick, image.controller));
  image_sent_ = true;
}

// In lockstep time a frame waits until every run has certainly received it, so that runs repeat; see on_camera.
void Service::forward_camera() {
  while (!camera_.empty() && camera_.front().due_tick <= tick()) {
    server_.publish(Topic::kCamera, camera_.front().packet);
    camera_.pop_front();
  }
}

// While a stop is on its way to the next tick, the arm is given nothing else.
void Service::release_next() {
  const std::optional<cable::Setpoint> setpoint = arbiter_.next_setpoint(tick(), now());
  const std::uint64_t next_tick = link_.image.value().next_tick;
  std::erase_if(released_, [next_tick](const cable::Telecommand& t) { return t.first_tick() < next_tick; });
  if (setpoint && owner_.client() != 0 && !link_.stop.is_pressed()) verify_and_release(*setpoint);
}

void Service::verify_and_release(const cable::Setpoint& setpoint) {
  const cable::RobotTable& table = config_.robot.table;
  const TwinImage& image = link_.image.value();
  const auto interval = static_cast<std::uint64_t>(table.interval_ticks);
  const Candidate candidate = release_.candidate(setpoint, owner_.role_number(), image.next_tick + interval, interval);
  const Prediction prediction = Twin::run(image, released_, candidate, max_stop_ticks(table));
  ExecutionVerdict execution = judge_execution(table, candidate, prediction);
  const SimulationVerdict simulation = judge_motion(table, candidate, prediction, zone_);
  if (config_.time_mode == TimeMode::kReal) {
    link_.report.refresh();
    judge_time(candidate, tick(), execution);
  }

  const std::optional<cable::Telecommand> telecommand = release_.release(candidate, execution, simulation);
  const Verdict& worst = execution.passed() ? static_cast<const Verdict&>(simulation) : execution;
  notes_.verdict = {candidate.sequence(), telecommand.has_value(), worst,
                    prediction.ticks[prediction.command_ticks - 1].theta_command_rad};
  if (telecommand && link_.released.push(*telecommand)) {
    released_.push_back(*telecommand);
    return;
  }
  ++notes_.refusals;
  note("refused " + std::to_string(candidate.sequence()) + ", M_e " + std::to_string(static_cast<int>(worst.code)) +
       ": " + worst.text);
  arbiter_.refused();
}

void Service::note(const std::string& text) {
  notes_.events.push_back({{"tick", tick()}, {"text", text}});
  if (notes_.events.size() > Notes::kKeptEvents) notes_.events.pop_front();
}

void Service::request(Request what) {
  if (boot_seen_ != BootPhase::kDone)
    return;  // drives that are not booted have no power, and a stop in force keeps it so
  if (!link_.requests.push(what)) throw RequestError("busy", "too many requests are waiting for the next ticks");
}

// Drives that are not booted have no power.
void Service::press_stop() noexcept {
  stop_tick_ = tick();
  if (boot_seen_ == BootPhase::kDone) link_.stop.press();
}

// Nobody asks for motion any more: the command in force expires and the arm holds.
void Service::drop_motion(const std::string& why) {
  arbiter_.hold();
  arbiter_.use_device(DeviceUse{});
  note(why + ": the arm holds");
}

void Service::begin_shutdown(const std::string& reason) {
  if (shutdown_tick_) return;
  shutdown_tick_ = tick();
  notes_.stopping = true;
  press_stop();
  note("shutdown: " + reason);
}

void Service::stop_by_itself(const std::string& reason) {
  press_stop();
  const StopOrder order{"lianad", printable(reason), tick()};
  notes_.stop.press(order);
  note(text_of(order));
  publish_state();
}

bool Service::finished() const {
  if (!shutdown_tick_) return false;
  const double waited_s = static_cast<double>(tick() - *shutdown_tick_) * config_.robot.table.tick_s;
  const bool off = now().state == OperatingState::kDisabled || now().state == OperatingState::kFault;
  const bool told = tick() > *shutdown_tick_ + static_cast<std::uint64_t>(config_.robot.table.interval_ticks);
  return (off && told) || waited_s > kShutdownLimit_s;
}

}  // namespace liana
