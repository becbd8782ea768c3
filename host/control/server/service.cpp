#include "host/control/server/service.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "host/api/server/request_error.hpp"
#include "host/api/server/request_text.hpp"
#include "host/api/server/welcome_size.hpp"
#include "host/base/clock/steady.hpp"
#include "host/base/event/event_json.hpp"
#include "host/control/verification/refusal_table.hpp"
#include "host/storage/recording/tick_packet.hpp"

namespace liana::server {

namespace {

constexpr double kLockstepPatience_s = 10.0;  // a client that stays silent longer is dead
constexpr double kEnabling_s = 4.5;           // after which an enable says what it waits for: the ramp takes 3 s
constexpr double kWriteAgain_s = 1.0;         // a disk that has refused the file of lost cables
constexpr double kHoming_s = 0.5;             // of arm time after booting: homing takes 0.1 s

}  // namespace

Service::Service(const ServiceConfig& config, ArmServer& desk)
    : config_(config),
      desk_(desk),
      bounds_(api::request_bounds(Json::parse(config.robot_json))),
      stream_(bounds_),
      log_(
          [this](const event::Event& event) {
            server_.publish_event(event::event_json(event).dump(-1, Json::BadUtf8::kReplace));
            if (file_) file_->append(event);
          },
          config_.buses.tick_s()),
      lifecycle_(config_.buses.tick_s(), static_cast<std::uint64_t>(config_.buses.interval_ticks())),
      server_(config.api_path, *this, config.api_group) {
  api::require_fit_in_welcome(config.robot_json, config.scene_json, config.buses.canonical_json);
  notes_.drive_names = config.drive_names;
  if (!config.events_file.empty()) file_.emplace(config.events_file, config_.buses.tick_s());
  if (!config.commands_file.empty()) dispatch_.emplace(config.commands_file);
  if (!config.verify_times_file.empty())
    verify_times_.emplace(config.verify_times_file, "--verify-times", "# us from setpoint to release, of each command");
  if (config.way_file.empty()) return;
  Json robot = Json::parse(config.robot_json);
  for (const char* poses : {"named_poses_deg", "jig_poses"}) robot.erase(poses);  // they move nothing of the arm
  way_file_.emplace(config.way_file,
                    PathBasis{robot.at("name").text(), robot.dump(), config.calibration, config.scene_json},
                    desk.joint_count());
  desk.restore_way(way_file_->kept());
  losses_.emplace(config.way_file + ".lost", robot.at("name").text(), desk.drive_count());
  remembered_ = losses_->cables();
}

// In real time finer than ticks: both ways of a device's packets are measured with it.
std::int64_t Service::arm_time_us() {
  const std::int64_t tick_us = std::llround(time_s() * 1e6);
  if (config_.time_mode != timing::TimeMode::kReal) return tick_us;
  const std::int64_t clock_us = timing::steady_us();
  if (!clock_ahead_us_) clock_ahead_us_ = clock_us - tick_us;
  return clock_us - *clock_ahead_us_;
}

std::uint64_t Service::ticks_in(double time_s) const {
  return static_cast<std::uint64_t>(std::lround(time_s / config_.buses.tick_s()));
}

bool Service::wait_for(const std::vector<api::Role>& roles, double timeout_s, const std::function<bool()>& stop) {
  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + std::chrono::duration<double>(timeout_s);
  for (const api::Role role : roles) {
    while (!server_.has_role(role)) {
      server_.pump(0.05);
      if (stop()) return false;
      if (Clock::now() > deadline) {
        throw std::runtime_error("--expect: a client with role '" + std::string(api::role_name(role)) +
                                 "' did not come within the time");
      }
    }
  }
  return true;
}

void Service::cycle() {
  desk_.refresh();
  log_.begin_interval(tick());
  watch_events_file();
  watch_arm();
  desk_.watch(boot_seen_ == realtime::BootPhase::kDone);
  watch_homing();
  watch_enabling();
  forward_ticks();
  idle(0.0);  // what came from clients outside lockstep
  forward_camera();
  watch_tool();
  desk_.tell_devices(arm_time_us());  // first: who has the state has had what its device was told
  publish_state();
  if (config_.time_mode != timing::TimeMode::kReal) server_.wait_done(tick(), kLockstepPatience_s);
  desk_.hear_devices(arm_time_us());
  server_.dispatch();
  desk_.take_samples();
  watch_stream();
  release_next();
}

void Service::idle(double timeout_s) {
  server_.pump(timeout_s, desk_.devices_fd());
  desk_.hear_devices(arm_time_us());  // before requests, which may name a device that has just come
  server_.dispatch();
}

void Service::publish_state() {
  if (!server_.has_subscriber(api::Topic::kState)) return;
  if (config_.time_mode == timing::TimeMode::kReal)
    notes_.tick_us = tick_watch_.longest_us(desk_.link().timing.tick_us.counts()).value_or(0);
  const Json state = state_message(config_.buses, desk_, owner_, notes_, log_.shown());
  const char* name = state_name(desk_);
  // Its events may name files, whose names are any bytes.
  server_.publish(api::Topic::kState, state.dump(-1, Json::BadUtf8::kReplace),
                  name != published_);  // a slow reader may lose states, but no change of state
  published_ = name;
}

// A clear says what it looked at, and what kept it from clearing.
void Service::note_clear() {
  const ClearResult& clear = desk_.supervisor().clear;
  if (clear.tick == clear_seen_tick_) return;
  clear_seen_tick_ = clear.tick;
  note(clear_event(clear, drives_that_keep(desk_, config_.drive_names)));
}

// An arm that is not homed some time after booting says why, once; the refusal to enable it says how it stands.
void Service::watch_homing() {
  if (boot_seen_ == realtime::BootPhase::kDone && !homed_told_ && desk_.not_homed().is_homed()) {
    homed_told_ = true;
    note(homed_event());
  }
  if (!homing_due_tick_ || tick() < *homing_due_tick_) return;
  homing_due_tick_.reset();
  if (!desk_.not_homed().is_homed()) note(not_homed_event(desk_.not_homed().text));
}

// Who enables has to know soon what keeps the arm; a cable that is not whole is not pulled for up to a minute.
void Service::watch_enabling() {
  const bool was_told = !notes_.enabling_waits.empty();
  notes_.enabling_waits.clear();
  if (takes_back_ && now().state == OperatingState::kDisabled) {
    takes_back_ = false;
    request(Request::kRecover);
  }
  if (now().state != OperatingState::kEnabling) return enabling_since_.reset();
  if (!enabling_since_) enabling_since_ = tick();
  const std::uint64_t waited = tick() - *enabling_since_;
  if (waited < ticks_in(kEnabling_s)) return;
  notes_.enabling_waits = why_enabling_waits(desk_, config_.drive_names);
  if (notes_.enabling_waits.empty() || was_told) return;
  note({.kind = event::EventKind::kHostWarning,
        .number = event::number_of(event::HostTroubleEvent::kEnablingWaits),
        .text = "enabling waits: " + notes_.enabling_waits});
  if (!desk_.is_untrue()) return;
  remembered_.insert(remembered_.end(), recalled_.begin(), recalled_.end());
  recalled_.clear();
  note({.kind = event::EventKind::kHostWarning,
        .number = event::number_of(event::HostTroubleEvent::kEnablingWaits),
        .text = "enabling ends: a cable that was called whole takes no tension, and counts as lost again"});
  takes_back_ = true;
  request(Request::kDisable);
}

// An owner that streams tip goals with a time to live and stands still: nobody stands behind its last goal any more.
void Service::watch_stream() {
  const double next_s = time_s() + config_.buses.interval_ticks() * config_.buses.tick_s();
  const std::optional<double> ttl_s = stream_.overdue(next_s, desk_.tip_command());
  if (!ttl_s || now().state != OperatingState::kEnabled) return;
  desk_.hold();
  note(stands_still_event(owner_.name(), *ttl_s));
}

// What changes by itself: the end of booting, the end of the run after the mission.
void Service::watch_arm() {
  note_clear();
  if (dispatch_) dispatch_->note_active(tick(), now().active_sequence);
  note(trouble_.changes(config_.buses, desk_.report()));
  note(faults_.changes(now().faults, config_.buses, config_.drive_names));
  note(desk_.take_events());
  if (const char* why = lifecycle_.why_to_stop(tick(), now())) begin_shutdown(why);
  const realtime::BootPhase boot = desk_.report().boot;
  if (boot == boot_seen_) return;
  if (boot == realtime::BootPhase::kBooting) note(boot_goes_on_event());
  boot_seen_ = boot;
  notes_.boot_problems.clear();
  if (boot == realtime::BootPhase::kDone) {
    note(booted_event());
    image_sent_ = false;  // one from the time before, after a boot that had failed, is of another tick
    notes_.serials = config_.serials();
    if (config_.unwatched)
      for (const std::string& line : config_.unwatched()) note(unwatched_event(line));
    homing_due_tick_ = tick() + ticks_in(kHoming_s);
  }
  if (boot != realtime::BootPhase::kFailed) return;
  notes_.boot_problems = config_.boot_problems();
  note(boot_failed_events(notes_.boot_problems, config_.drive_names));
}

// What a drive reports beside its statusword; whether it is a fault, its statusword says.
void Service::note_emergencies(const CycleInputs& inputs) {
  for (std::size_t i = 0; i < inputs.drive.size(); ++i) {
    const std::uint16_t code = inputs.drive[i].emergency_code;
    if (code == 0) continue;
    note(emergency_event(i, code, config_.drive_names));
  }
}

// Tick records and controller images for the archive. The image before the first tick makes a recording complete.
void Service::forward_ticks() {
  const bool wanted = server_.has_subscriber(api::Topic::kTick);
  desk_.take_ticks(server_.dropped_ticks(), [&](const CycleInputs& inputs, const std::function<std::string()>& packet) {
    note_emergencies(inputs);
    if (wanted) server_.publish(api::Topic::kTick, packet());
  });
  if (boot_seen_ == realtime::BootPhase::kBooting || !wanted) return;
  if (image_sent_ && desk_.image_tick() % recording::kImageEveryTicks != 0) return;
  server_.publish(api::Topic::kTick, desk_.image_packet());
  image_sent_ = true;
}

// In lockstep time a frame waits until every run has certainly received it, so that runs repeat.
void Service::forward_camera() {
  while (!camera_.empty() && camera_.front().due_tick <= tick()) {
    server_.publish(api::Topic::kCamera, camera_.front().packet);
    desk_.take_observation(camera_.front().picture);
    camera_.pop_front();
  }
}

void Service::watch_tool() {
  if (auto ended = notes_.tool.pass(tick())) note(std::move(*ended));
}

// What was said at `said_s` of arm time, in the slot that begins then, is certainly here two slots later; one more for
// rounding. In real time it counts at once.
std::uint64_t Service::certainly_heard_tick(double said_s) const {
  if (config_.time_mode == timing::TimeMode::kReal) return 0;
  return static_cast<std::uint64_t>(std::ceil(said_s / config_.buses.tick_s() - 1e-6)) + 3;
}

std::optional<LastVerdict> Service::timed_release() {
  const auto began = std::chrono::steady_clock::now();
  std::optional<LastVerdict> verdict = desk_.release_next(owner_.client() != 0, owner_.role_number());
  const std::chrono::duration<double, std::micro> took_us = std::chrono::steady_clock::now() - began;
  if (verdict && verify_times_) verify_times_->append(std::to_string(std::lround(took_us.count())));
  return verdict;
}

void Service::release_next() {
  const std::optional<LastVerdict> verdict = timed_release();
  tell_of_paths();
  keep_way();
  if (!verdict) return;
  if (dispatch_) dispatch_->note(tick(), owner_.name(), *verdict);
  if (!verdict->is_news) return;
  notes_.verdict = *verdict;
  notes_.verdict_us = arm_time_us();
  if (verdict->released) return;
  ++notes_.refusals;
  if (!verdict->goes_on) ++notes_.refused_motions;
  note(verdict_event(verdict->sequence, verdict->worst));
  if (verdict->stops)
    order_stop({"lianad", std::string("refused: ") + verification::row_of(verdict->worst.code).says, tick()});
}

// A path that does not begin is a refusal as that of a command is: who asked for it looks there.
void Service::tell_of_paths() {
  for (const arbiter::PathEvents& news : desk_.take_path_news()) {
    note(path_event(news));
    if (news.what != event::PathEvent::kRefused) continue;
    if (dispatch_) dispatch_->note_request(tick(), refusal_event(owner_.name(), "refused", news.text));
    ++notes_.refusals;
    ++notes_.refused_motions;
    notes_.verdict.released = false;
    notes_.verdict.worst.code = verification::Refusal::kPath;
    notes_.verdict.worst.text = news.text;
  }
}

void Service::keep_way() {
  for (const arbiter::RetractEvents& news : desk_.take_way_news()) note(way_event(news));
  if (!way_file_) return;
  if (const auto change = desk_.take_way_change()) way_file_->follow(*change);
  if (auto trouble = way_file_->trouble()) note(std::move(*trouble));
  keep_losses();
}

// What is lost stays so beyond this lianad until the arm has been enabled with it: that somebody calls a cable whole is
// no proof.
void Service::keep_losses() {
  if (now().state == OperatingState::kEnabled) recalled_.clear();
  std::vector<std::size_t> lost = desk_.lost();
  lost.insert(lost.end(), remembered_.begin(), remembered_.end());
  std::sort(lost.begin(), lost.end());
  lost.erase(std::unique(lost.begin(), lost.end()), lost.end());
  if (!loss_told_ && !remembered_.empty()) {
    note({.kind = event::EventKind::kHostWarning,
          .number = event::number_of(event::HostTroubleEvent::kEnablingWaits),
          .text = "enabling is refused: " + why_remembered()});
  }
  loss_told_ = true;
  if (lost == losses_->cables() || tick() < next_loss_tick_) return;
  const bool is_written = losses_->note(lost), was_written = next_loss_tick_ == 0;
  next_loss_tick_ = is_written ? 0 : tick() + ticks_in(kWriteAgain_s);
  if (is_written || !was_written) return;
  note({.kind = event::EventKind::kHostWarning,
        .number = event::number_of(event::HostTroubleEvent::kEnablingWaits),
        .text = "a lianad that is started anew will not know of the lost cables: their file cannot be written"});
}

// What an earlier lianad has left: the core of this one does not know of it.
std::string Service::why_remembered() const {
  if (remembered_.empty()) return "";
  const std::size_t cable = remembered_.front();
  return config_.drive_names.cable(cable) +
         " was lost before this lianad was started. If you have looked and it is whole, liana clear --whole " +
         std::to_string(cable + 1) + "; else take the arm out by hand (docs/how-to/a-cable-broke.md)";
}

bool Service::remembers(std::int64_t cable) const {
  return cable >= 1 &&
         std::find(remembered_.begin(), remembered_.end(), static_cast<std::size_t>(cable - 1)) != remembered_.end();
}

// A cable that an earlier lianad has lost is whole again.
void Service::recall(std::size_t cable) {
  std::erase(remembered_, cable);
  recalled_.push_back(cable);
  desk_.call_whole(cable);
}

bool Service::note(event::Event event) { return log_.add(tick(), std::move(event)); }

void Service::note(std::vector<event::Event> events) {
  for (event::Event& event : events) note(std::move(event));
}

// A disk that takes no events is trouble of the host, and no reason to stop the arm.
void Service::watch_events_file() {
  if (auto change = file_ ? file_->change() : std::nullopt) note(std::move(*change));
  if (auto change = dispatch_ ? dispatch_->change() : std::nullopt) note(std::move(*change));
}

void Service::request(Request what) {
  const bool asks_again = boot_seen_ == realtime::BootPhase::kFailed && what == Request::kClear;
  if (boot_seen_ != realtime::BootPhase::kDone && !asks_again)
    return;  // drives that are not booted have no power, and a stop in force keeps it so
  if (!desk_.link().requests.push(what))
    throw api::RequestError("busy",
                            "too many requests are waiting for the next ticks: send fewer in a command interval");
}

// Drives that are not booted have no power.
void Service::press_stop() noexcept {
  stop_tick_ = tick();
  if (boot_seen_ == realtime::BootPhase::kDone) desk_.link().stop.press();
}

// Nobody asks for motion any more: the command in force expires and the arm holds.
void Service::drop_motion(event::Event why) {
  stream_.end();
  desk_.drop_motion();
  note(std::move(why));
}

void Service::begin_shutdown(const std::string& reason) {
  if (!lifecycle_.stop(tick())) return;
  notes_.stopping = true;
  press_stop();
  note({.kind = event::EventKind::kShutdown, .text = "shutdown: " + reason});
}

void Service::order_stop(const StopOrder& order) {
  press_stop();
  notes_.stop.press(order);
  note(stop_event(order));
}

void Service::stop_by_itself(const std::string& reason) {
  order_stop({"lianad", printable(reason), tick()});
  publish_state();
}

}  // namespace liana::server
