// What each request of docs/reference/api.md does.
#include <cmath>

#include "host/api/server/request_check.hpp"
#include "host/api/server/request_error.hpp"
#include "host/api/server/request_text.hpp"
#include "host/control/server/service.hpp"
#include "host/control/server/timing_message.hpp"

namespace liana::server {

namespace {
constexpr double kRounding_s = 0.1;  // of virtual time: the bench may be some slots ahead
}  // namespace

const std::map<std::string, Service::Handler>& Service::handlers() {
  static const std::map<std::string, Handler> kHandlers{{"acquire", &Service::on_acquire},
                                                        {"release", &Service::on_release},
                                                        {"state_command", &Service::on_state_command},
                                                        {"tool", &Service::on_tool},
                                                        {"stop", &Service::on_stop},
                                                        {"shutdown", &Service::on_shutdown},
                                                        {"announce", &Service::on_announce},
                                                        {"mission_control", &Service::on_mission_control},
                                                        {"operator_says", &Service::on_operator_says},
                                                        {"archive_alarm", &Service::on_archive_alarm},
                                                        {"camera", &Service::on_camera},
                                                        {"tool_report", &Service::on_tool_report},
                                                        {"timing", &Service::on_timing}};
  return kHandlers;
}

Json Service::handle(const api::ClientInfo& client, const Json& request) {
  try {
    return act_on(client, request);
  } catch (const api::RequestError& error) {
    const Json& op = request.member_or_null("op");
    const event::Event refusal =
        refusal_event(client.name, op.is_string() ? printable(op.text()) : "", error.code(), error.what());
    if (note(refusal) && dispatch_) dispatch_->note_request(tick(), refusal);
    throw;
  }
}

Json Service::act_on(const api::ClientInfo& client, const Json& request) {
  const api::RequestRow& row = api::row_of(request);
  api::require_may(row, client.role, bounds_);
  if (row.owner_only) owner_.require(client.id);
  const api::Arguments fields = api::checked(row, request, bounds_);
  stream_.check(row, fields, time_s(), desk_.tip_command());
  Json answer = answer_to(row, client, fields);
  stream_.note(row, fields, time_s());
  return answer;
}

Json Service::answer_to(const api::RequestRow& row, const api::ClientInfo& client, const api::Arguments& fields) {
  if (desk_.knows(row.op)) return desk_.ask({row.op, fields});
  const auto found = handlers().find(row.op);
  if (found == handlers().end())
    throw api::RequestError("refused", std::string(row.op) + " is not served here: leave it out");
  return (this->*found->second)(client, fields);
}

Json Service::welcome(const api::ClientInfo& client) {
  if (client.role == api::Role::kMission) notes_.mission_control = nullptr;  // that was for the mission before
  return {{"op", "welcome"},
          {"time_mode", timing::time_mode_name(config_.time_mode)},
          {"period_s", config_.buses.tick_s()},
          {"interval_ticks", config_.buses.interval_ticks()},
          {"config_hash", config::config_hash(config_.robot_json, config_.scene_json, config_.buses.canonical_json)},
          {"robot", Json::parse(config_.robot_json)},
          {"scene", Json::parse(config_.scene_json)},
          {"buses", Json::parse(config_.buses.canonical_json)}};
}

void Service::gone(const api::ClientInfo& client, const std::string& why) {
  note({.kind = event::EventKind::kClient,
        .subject = client.name,
        .text = std::string(api::role_name(client.role)) + " '" + client.name + "' is gone (" + why + ")"});
  if (client.role == api::Role::kTool) {
    if (auto lost = notes_.tool.lose()) note(std::move(*lost));
  }
  if (owner_.gone(client.id)) drop_motion(owner_event(event::OwnerEvent::kGone, client.name));
  if (config_.ends_with_mission && client.role == api::Role::kMission) lifecycle_.mission_ends(tick());
}

// An owner that stands still must not keep the arm where it is; one that works is left alone.
Json Service::on_acquire(const api::ClientInfo& client, const api::Arguments& fields) {
  const bool is_new = owner_.client() != client.id;
  const Claimant wanted{client.id, static_cast<std::uint32_t>(client.role) + 1, client.name, client.process};
  const TakeOver how{.is_allowed = client.role == api::Role::kClient,
                     .from = fields.has("from") ? fields.text("from") : "",
                     .stop_in_force = notes_.stop.order().has_value(),
                     .silent_s = server_.silence_s(owner_.client())};
  if (const auto from = owner_.acquire(wanted, how)) drop_motion(taken_event(*from, wanted, why_taken(how)));
  if (is_new) note(owner_event(event::OwnerEvent::kAcquired, client.name));
  stream_.restart();
  if (client.role == api::Role::kClient) notes_.stop.release();  // a mission may have asked before it saw the stop
  return Json::object();
}

std::string Service::why_taken(const TakeOver& how) const {
  const auto& stop = notes_.stop.order();
  const std::string silence = "silent for " + api::text_of(std::round(how.silent_s)) + " s";
  return stop ? "after " + text_of(*stop) + (how.silent_s < kMaxSilence_s ? "" : ", " + silence) : silence;
}

Json Service::on_release(const api::ClientInfo& client, const api::Arguments&) {
  owner_.release(client.id);
  drop_motion(owner_event(event::OwnerEvent::kReleased, client.name));
  return Json::object();
}

Json Service::on_state_command(const api::ClientInfo&, const api::Arguments& fields) {
  const std::string command = fields.text("command");
  if (boot_seen_ == realtime::BootPhase::kFailed && command != "clear")
    throw api::RequestError("fault", "booting failed: " + realtime::text_of(notes_.boot_problems));
  if (boot_seen_ == realtime::BootPhase::kBooting)
    throw api::RequestError("busy", "the drives are still booting: wait until they are booted");
  if (command == "enable") {
    if (const auto& stop = notes_.stop.order()) {
      throw api::RequestError(
          "refused", text_of(*stop) + " is in force: a client has to take motion anew (acquire), or to send clear");
    }
    if (stop_tick_ == tick())
      throw api::RequestError("refused",
                              "a stop was asked for in the same command interval: ask again if the arm should go on");
    if (now().faults.count > 0) throw api::RequestError("fault", "a fault is latched: clear it first");
    if (const std::string why = why_remembered(); !why.empty()) throw api::RequestError("fault", why);
    if (lifecycle_.is_stopping()) throw api::RequestError("refused", "lianad is stopping: start it again afterwards");
    if (now().state == OperatingState::kStopping || disable_tick_ == tick())
      throw api::RequestError("busy", "the arm is stopping: ask again when it is disabled");
    require_homed();
    this->request(Request::kEnable);
  } else if (command == "disable") {
    disable_tick_ = tick();
    this->request(Request::kDisable);
  } else if (command == "clear") {
    const std::int64_t whole = fields.has("whole") ? fields.integer("whole") : 0;
    const bool is_recalled = remembers(whole);
    const bool boots_again = boot_seen_ == realtime::BootPhase::kFailed;
    std::string why = is_recalled || boots_again ? "" : why_remembered();
    if (why.empty()) why = desk_.why_not_clear(is_recalled ? 0 : whole);
    if (!why.empty()) throw api::RequestError("fault", "not cleared: " + why);
    if (is_recalled) recall(static_cast<std::size_t>(whole - 1));
    notes_.stop.release();
    this->request(Request::kClear);
  } else if (command == "recover") {
    std::string why = why_remembered();
    if (why.empty()) why = desk_.why_not_recover();
    if (!why.empty()) throw api::RequestError("refused", why);
    if (now().state != OperatingState::kFault && !desk_.recovers())
      throw api::RequestError("busy", "the arm is stopping: ask again when it stands in FAULT, without power");
    notes_.stop.release();
    if (!desk_.recovers()) this->request(Request::kRecover);
  } else {
    require_homed();  // "home": encoders are absolute, nothing has to be done
  }
  return Json::object();
}

void Service::require_homed() const {
  if (!desk_.not_homed().is_homed()) throw api::RequestError("refused", "not homed: " + desk_.not_homed().text);
}

Json Service::on_tool(const api::ClientInfo& client, const api::Arguments& fields) {
  const Json told = notes_.tool.ask(fields.text("command"), time_s(), server_.has_role(api::Role::kTool));
  server_.publish(api::Topic::kTool, told.dump(), true);
  note({.kind = event::EventKind::kTool, .subject = client.name, .text = "tool: " + fields.text("command")});
  return {{"tick", tick()}};
}

// Never refused, and first of all the flag: nothing that may fail stands before it.
Json Service::on_stop(const api::ClientInfo& client, const api::Arguments& fields) {
  press_stop();
  desk_.hold();
  const StopOrder order{printable(client.name), stop_reason(fields.json().find("reason")), tick()};
  // A mission's own stop is how it ends; everybody else's stays in force, so that nothing enables the arm by itself
  // afterwards.
  if (client.role != api::Role::kMission) notes_.stop.press(order);
  note(stop_event(order));
  return Json::object();
}

// Acted on at the next interval.
Json Service::on_shutdown(const api::ClientInfo& client, const api::Arguments&) {
  lifecycle_.ask_to_end();
  note({.kind = event::EventKind::kShutdown,
        .subject = client.name,
        .text = "shutdown asked for by '" + client.name + "'"});
  return Json::object();
}

Json Service::on_announce(const api::ClientInfo&, const api::Arguments& fields) {
  notes_.step = nullptr;
  const std::string after = fields.has("after") ? fields.text("after") : "";
  if (!fields.has("step")) {
    if (!after.empty()) note(last_step_event(after));
    return Json::object();
  }
  const api::Arguments step = fields.object("step");
  notes_.step = {{"index", step.integer("index")}, {"name", step.text("name")}, {"device", step.text("device")}};
  notes_.step["waits"] = step.has("waits") ? Json(step.text("waits")) : Json();
  if (step.has("task")) notes_.step["task"] = step.text("task");
  if (step.has("entry")) notes_.step["entry"] = step.integer("entry");
  note(step_event(static_cast<int>(step.integer("index")), step.text("name"),
                  step.has("waits") ? step.text("waits") : "", after));
  return {{"tick", tick()}};
}

// The mission reads it in the next state, and does what its step allows.
Json Service::on_mission_control(const api::ClientInfo& client, const api::Arguments& fields) {
  const std::string command = fields.text("command");
  if (!server_.has_role(api::Role::kMission))
    throw api::RequestError(
        "refused", "no mission runs, so there is nothing to " + command + ": liana status says what the arm does");
  notes_.mission_control = {{"number", ++mission_asked_}, {"command", command}, {"by", printable(client.name)}};
  note({.kind = event::EventKind::kOperator, .subject = client.name, .text = "mission: " + command});
  return {{"tick", tick()}};
}

Json Service::on_operator_says(const api::ClientInfo& client, const api::Arguments& fields) {
  const std::string what = fields.text("what");
  notes_.operator_says = {{"what", what}, {"tick", tick()}};
  note({.kind = event::EventKind::kOperator, .subject = client.name, .text = what});
  return Json::object();
}

// Nothing of the arm depends on the archive: it is said, and the arm goes on.
Json Service::on_archive_alarm(const api::ClientInfo& client, const api::Arguments& fields) {
  note({.kind = event::EventKind::kHostWarning,
        .number = event::number_of(event::HostTroubleEvent::kArchive),
        .subject = printable(client.name),
        .values = {{"count", static_cast<double>(fields.integer("count"))}},
        .text = "archive: " + printable(fields.text("text"))});
  return Json::object();
}

// One clock for all in virtual time: what is said to be of the future would keep those behind it waiting.
void Service::require_past(const char* field, double said_s) const {
  if (config_.time_mode == timing::TimeMode::kReal || said_s <= time_s() + kRounding_s) return;
  throw api::RequestError("out_of_range", std::string(field) + " = " + api::text_of(said_s) + ": allowed 0 to " +
                                              api::text_of(time_s()) + " s, which is now: give the arm's time");
}

Json Service::on_camera(const api::ClientInfo&, const api::Arguments& fields) {
  CameraFrame frame{0, fields.json().dump(), {}};
  frame.picture.capture_time_s = fields.number("capture_time_s");
  if (fields.has("slit")) frame.picture.slit_in_tip = fields.pose("slit");
  if (fields.has("rod")) frame.picture.rod_in_tip = fields.pose("rod");
  if (fields.has("target")) frame.picture.target_in_tip = fields.pose("target");
  if (fields.has("target_name")) frame.picture.target_name = fields.text("target_name");
  if (frame.picture.target_name == "slit" || frame.picture.target_name == "rod") {
    throw api::RequestError("bad_request", "target_name = " + frame.picture.target_name +
                                               ": allowed any other name, slit and rod have fields of their own: "
                                               "choose another name");
  }
  require_past("capture_time_s", frame.picture.capture_time_s);
  frame.due_tick = certainly_heard_tick(frame.picture.capture_time_s + config_.camera_latency_s);
  if (camera_.size() >= 64)
    throw api::RequestError(
        "busy", "64 camera frames are waiting: their time stamps lie in the future: stamp them with the arm's time");
  camera_.push_back(frame);
  return Json::object();
}

Json Service::on_tool_report(const api::ClientInfo&, const api::Arguments& fields) {
  require_past("time_s", fields.number("time_s"));
  notes_.tool.hear(fields, certainly_heard_tick(fields.number("time_s")));
  return Json::object();
}

Json Service::on_timing(const api::ClientInfo&, const api::Arguments& fields) {
  if (config_.time_mode != timing::TimeMode::kReal) {
    throw api::RequestError("refused", "timing: time mode " + std::string(timing::time_mode_name(config_.time_mode)) +
                                           " has no wake-ups to measure; only --time real has");
  }
  desk_.refresh_report();
  const realtime::Overruns& overruns = desk_.report().overruns;
  Json answer = timing_message(desk_.link().timing.wakeup_us.counts(), desk_.link().timing.tick_us.counts(),
                               overruns.since(overruns_before_));
  if (!fields.flag("reset")) return answer;
  desk_.link().timing.wakeup_us.reset();
  desk_.link().timing.tick_us.reset();
  overruns_before_ = overruns;
  return answer;
}

}  // namespace liana::server
