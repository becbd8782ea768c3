#include "tests/lua/fake_lianad.hpp"

#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <stdexcept>

#include "host/apps/mission_runner/evaluate.hpp"
#include "host/apps/mission_runner/json_bridge.hpp"

namespace liana::mission_runner {
namespace {

constexpr int kTicksPerInterval = 5;
constexpr int kMaxIntervals = 40000;
constexpr int kMotionIntervals = 20;
constexpr int kPathIntervals = 60;  // longer: the arm also rests on the way

Json table(const std::string& kind, const std::string& name) {
  Activity activity;
  Script script(ScriptLimits{}, LIANA_SOURCE_DIR "/lua", activity);
  return Json::parse(evaluate(script, LIANA_SOURCE_DIR "/lua", kind, name));
}

Json tip_of(const Json& theta_deg) {
  Activity activity;
  Script script(ScriptLimits{}, LIANA_SOURCE_DIR "/lua", activity);
  std::string list;
  for (const auto& angle : theta_deg) list += angle.dump() + ",";
  script.run({"tip.lua", "return require('liana.geometry').tip(require 'robots.zhu2022', {" + list + "}).position"});
  Json pose = to_json(script.state(), -1, "tip.lua");
  for (const int q : {1, 0, 0, 0}) pose.push_back(q);
  return pose;
}

}  // namespace

FakeLianad::FakeLianad(const std::string& path, const FakeBehaviour& behaviour)
    : behaviour_(behaviour), robot_(table("robot", "zhu2022")), scene_(table("scene", "panel_slit")) {
  js_deg_ = named_pose("prepare");
  js_deg_[0] = js_deg_[0].get<double>() + 0.4;
  goal_deg_ = js_deg_;
  tip_ = tip_of(js_deg_);
  listener_ = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, sizeof address.sun_path - 1);
  if (bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 || listen(listener_, 1) != 0) {
    throw std::runtime_error("fake lianad: cannot listen at " + path);
  }
  thread_ = std::thread([this] { serve(); });
}

FakeLianad::~FakeLianad() {
  requests();
  close(listener_);
}

const std::vector<Json>& FakeLianad::requests() {
  if (thread_.joinable()) {
    shutdown(listener_, SHUT_RDWR);  // in case nobody ever connected
    thread_.join();
  }
  return requests_;
}

void FakeLianad::serve() {
  client_ = accept(listener_, nullptr, nullptr);
  if (client_ < 0) return;
  const timeval patience{60, 0};
  setsockopt(client_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  converse();
  close(client_);
}

void FakeLianad::converse() {
  char packet[65536];
  const auto hello = recv(client_, packet, sizeof packet, 0);
  if (hello <= 0) return;
  requests_.push_back(Json::parse({packet, static_cast<std::size_t>(hello)}));
  send({{"op", "welcome"},
        {"time_mode", "fast"},
        {"period_s", 0.004},
        {"interval_ticks", 5},
        {"robot", robot_},
        {"buses", table("buses", "embedded")},
        {"scene", scene_}});
  for (int interval = 0; interval < kMaxIntervals; ++interval) {
    if (behaviour_.vanish_in_step != 0 && step_ >= behaviour_.vanish_in_step) return;
    if (behaviour_.silent_in_step != 0 && step_ >= behaviour_.silent_in_step) {
      ssize_t length = 0;
      do length = recv(client_, packet, sizeof packet, 0);
      while (length < 0 && errno == EINTR);
      runner_left_ = length == 0 || (length < 0 && errno == ECONNRESET);  // reset: it left an answer unread
      return;
    }
    if (behaviour_.slow_in_step != 0 && step_ >= behaviour_.slow_in_step) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2500));
      behaviour_.slow_in_step = 0;
    }
    listen_to_people();
    send(state());
    if (!handle_until_done()) return;
    advance();
  }
}

void FakeLianad::send(const Json& message) const {
  const std::string text = message.dump();
  (void)!::send(client_, text.data(), text.size(), MSG_NOSIGNAL);
}

bool FakeLianad::handle_until_done() {
  char packet[65536];
  while (true) {
    const auto length = recv(client_, packet, sizeof packet, 0);
    if (length <= 0) return false;
    const Json request = Json::parse({packet, static_cast<std::size_t>(length)});
    if (request["op"] == "done") return request["tick"] == tick_;
    requests_.push_back(request);
    answer(request);
  }
}

void FakeLianad::answer(const Json& request) {
  const std::string op = request["op"];
  const auto refusal = behaviour_.refuse.find(op);
  const Json id = request.value("id", Json());
  if (refusal != behaviour_.refuse.end() && step_ >= behaviour_.refuse_in_step) {
    return send({{"op", "error"}, {"id", id}, {"code", refusal->second}, {"message", "scripted refusal"}});
  }
  obey(request);
  send({{"op", "ok"}, {"id", id}});
}

void FakeLianad::obey(const Json& request) {
  const std::string op = request["op"];
  if (op == "acquire") owner_ = "mission";
  if (op == "release") owner_ = "";
  if (op == "state_command" && request["command"] == "home") is_homed_ = true;
  if (op == "state_command" && request["command"] == "enable") state_ = "ENABLING";
  if (op == "state_command" && request["command"] == "disable") state_ = "DISABLED";
  if (op == "move_jp") goal_deg_ = request["goal_deg"];
  if (op == "move_path") {
    goal_deg_ = request["points_deg"][request["points_deg"].size() - 1];
    path_intervals_ = kPathIntervals;
  }
  if (op == "announce" && request.member_or_null("step").is_object()) {
    step_ = request["step"]["index"];
    intervals_in_step_ = 0;
  }
  if (op == "stop") state_ = "STOPPING";
  if (op == "hold_theta") {
    held_ = Json::array();
    for (const auto& each : request["held"]) held_.push_back(each["theta"]);
  }
  if (op == "use_device") {
    device_ = request["device"];
    engaged_ = false;
    intervals_with_device_ = 0;
  }
  asked_back_ = asked_back_ || op == "retract";
  if (op == "move_jp" || op == "move_path" || op == "hold_theta" || op == "retract") busy_intervals_ = kMotionIntervals;
}

// One command interval: motions end, the operator steers to where the step should end, lets go and says so.
void FakeLianad::advance() {
  tick_ += kTicksPerInterval;
  if (state_ == "BOOTING" && tick_ > 50) state_ = "DISABLED";
  if (state_ == "ENABLING" && tick_ > 200) state_ = "ENABLED";
  if (path_intervals_ > 0) --path_intervals_;
  ++intervals_in_step_;
  if (behaviour_.hold_fault_goes && step_ == behaviour_.hold_fault_in_step && owner_.empty())
    behaviour_.hold_fault_in_step = 0;
  if (busy_intervals_ > 0 && --busy_intervals_ == 0) {
    js_deg_ = goal_deg_;
    if (step_ == 1) tip_ = tip_of(js_deg_);
  }
  if (behaviour_.operator_speaks_too_early && step_ == 1) said_ = {{"what", "arrived"}, {"tick", tick_}};
  if (device_ == "none") return;
  ++intervals_with_device_;
  engaged_ = intervals_with_device_ >= 10;
  if (intervals_with_device_ < 60 || !behaviour_.operator_arrives) return;
  if (device_ == "vr") tip_ = tip_of(named_pose("panel_edge"));
  if (device_ == "hand" && held_.size() == 1) {
    for (std::size_t k = 0; k < 3; ++k)
      tip_[k] = scene_["slit"]["u_axis"][k].get<double>() * behaviour_.tip_in_slit_u_m;
  }
  if (device_ == "hand" && held_.size() == 2) tip_ = tip_of(named_pose("press_rod"));
  if (intervals_with_device_ < 80) return;
  engaged_ = false;
  if (!behaviour_.operator_speaks_too_early) said_ = {{"what", "arrived"}, {"tick", tick_}};
}

void FakeLianad::listen_to_people() {
  if (asked_ == behaviour_.people.size() || behaviour_.people[asked_].first != step_) return;
  if (intervals_in_step_ < behaviour_.people_after_intervals) return;
  ++asked_;
  intervals_in_step_ = 0;
}

Json FakeLianad::state() const {
  const bool fault = behaviour_.fault_in_step != 0 && step_ >= behaviour_.fault_in_step;
  const bool stopped = behaviour_.stop_in_step != 0 && step_ >= behaviour_.stop_in_step;
  const bool stolen = behaviour_.steal_in_step != 0 && step_ >= behaviour_.steal_in_step;
  const bool held = behaviour_.hold_fault_in_step != 0 && step_ >= behaviour_.hold_fault_in_step;
  const bool refused_motion = behaviour_.refuse_motion_in_step != 0 && step_ >= behaviour_.refuse_motion_in_step;
  Json faults = Json::array();
  if (held)
    faults.push_back(
        {{"number", 5001}, {"name", "cable_slack"}, {"index", 2}, {"where", "drive 3 (node 3, segment 1)"}});
  if (fault)
    faults.push_back(
        {{"number", 3101}, {"name", "drive_silent"}, {"index", 3}, {"where", "drive 4 (node 4, segment 2)"}});
  return {{"op", "state"},
          {"tick", tick_},
          {"time_s", static_cast<double>(tick_) * 0.004},
          {"state", fault     ? "FAULT"
                    : stopped ? "STOPPING"
                              : state_},
          {"stop_category", fault || stopped ? "stop" : "none"},
          {"is_homed", is_homed_},
          {"is_busy", busy_intervals_ > 0},
          {"path", path_intervals_ > 0 ? Json{{"hash", "0"}, {"share", 0.5}} : Json()},
          {"retracted", retract()["phase"] == "done"},
          {"retract", retract()},
          {"at_rest", busy_intervals_ == 0 && !engaged_},
          {"owner", stolen ? "somebody" : owner_},
          {"device", device_},
          {"device_engaged", engaged_},
          {"guidance", {{"speed_share", engaged_ ? behaviour_.speed_share : 1.0}, {"slowed_by", ""}}},
          {"setpoint_js_deg", js_deg_},
          {"measured_js_deg", js_deg_},
          {"measured_cp", tip_},
          {"held", held_},
          {"held_at_target", busy_intervals_ == 0},
          {"faults", faults},
          {"refusals", refused_motion ? 1 : 0},
          {"refused_motions", refused_motion ? 1 : 0},
          {"verdict", {{"text", "joint rate 1.2"}}},
          {"planar_segments", planar_segments()},
          {"shape", {{"missing_m", 0.02}, {"settled", busy_intervals_ == 0}, {"searching", false}}},
          {"mission_control",
           asked_ == 0 ? Json()
                       : Json{{"number", asked_}, {"command", behaviour_.people[asked_ - 1].second}, {"by", "ann"}}},
          {"operator_says", said_}};
}

Json FakeLianad::retract() const {
  if (!asked_back_) return {{"phase", "none"}, {"points_left", 0}, {"reason", ""}};
  if (behaviour_.way_back_stalls) return {{"phase", "back"}, {"points_left", 7}, {"reason", ""}};
  if (busy_intervals_ > 0) return {{"phase", "back"}, {"points_left", busy_intervals_}, {"reason", ""}};
  if (!behaviour_.way_back_ends_early) return {{"phase", "done"}, {"points_left", 0}, {"reason", ""}};
  return {{"phase", "ended"}, {"points_left", 42}, {"reason", "refused ten times"}};
}

// By the tip alone, as if the arm were straight behind it: a segment 0.65 m deep has to be planar.
int FakeLianad::planar_segments() const {
  double depth_m = -scene_["slit"]["mouth_u_m"].get<double>();
  for (std::size_t k = 0; k < 3; ++k) depth_m += scene_["slit"]["u_axis"][k].get<double>() * tip_[k].get<double>();
  return depth_m > 1.35 ? 2 : (depth_m > 0.65 ? 1 : 0);
}

Json FakeLianad::named_pose(const char* name) const { return robot_["named_poses_deg"][name]; }

}  // namespace liana::mission_runner
