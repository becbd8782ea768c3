#include "host/system/run_session.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "host/api/registry.hpp"
#include "host/system/observer.hpp"

namespace liana {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* kName = "liana run";  // as the reason of a stop names it
constexpr double kStopTimeout_s = 15.0;
constexpr double kEndGrace_s = 10.0;    // for lianad to stop the arm
constexpr double kFinishGrace_s = 3.0;  // for the others to write their summaries after that
constexpr double kLook_s = 0.02;
constexpr double kAftermath_s = 0.5;  // between the end of one program and the ends of those that need it

Clock::time_point after(double seconds) {
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

Pose pose_of(const Json& numbers) {
  Pose pose;
  if (!numbers.is_array() || numbers.size() != 7) return pose;
  for (std::size_t i = 0; i < 3; ++i) pose.position_m[i] = numbers[i].get<double>();
  for (std::size_t i = 0; i < 4; ++i) pose.quaternion[i] = numbers[i + 3].get<double>();
  return pose;
}

}  // namespace

RunSession::RunSession(const SystemLayout& plan) : plan_(plan) {}

RunSession::~RunSession() = default;

RunEnd RunSession::run() {
  std::signal(SIGPIPE, SIG_IGN);
  RunEnd end;
  if (const auto failed = start()) {
    end = *failed;
  } else {
    end = watch();
  }
  shut_down();
  return end;
}

std::optional<RunEnd> RunSession::start() {
  for (const ProgramCall& call : plan_.programs) {
    children_.push_back(std::make_unique<ChildProcess>(call.name, call.argv, plan_.file(call.name + ".log")));
    const bool serves = call.name == "liana-bus" || call.name == "lianad";
    if (serves && !wait_for_socket(call.name == "lianad" ? plan_.api_socket() : plan_.bus_socket(), *children_.back(),
                                   interrupts_.any())) {
      if (const auto dead = dead_child(false)) return dead;
      return RunEnd{"failed", call.name + " did not open its socket within 30 s", false};
    }
    if (call.name == "lianad") {
      api_ = ApiClient::connect(plan_.api_socket());
      welcome_ = hello_as_observer(*api_, kName);
    }
  }
  mission_ = children_.back().get();
  return std::nullopt;
}

RunEnd RunSession::watch() {
  const auto ended = [](const auto& child) { return child->poll().has_value(); };
  while (std::none_of(children_.begin(), children_.end(), ended)) {
    look(kLook_s);
    if (interrupts_.count() > 0) return interrupted();
  }
  return conclusion();
}

// Somebody has ended. The others follow within moments, in any order: who failed by itself is seen only after that.
// Once the mission has ended, the others end in order.
RunEnd RunSession::conclusion() {
  const auto end = mission_->wait(kFinishGrace_s);
  if (!end || end->code != 0) {
    std::this_thread::sleep_for(std::chrono::duration<double>(kAftermath_s));
    if (const auto failed = dead_child(true)) return *failed;
  }
  return end ? end_of_mission(*end) : *dead_child(false);
}

// A mission runner that ended by itself has written its report; one that was killed has not.
RunEnd RunSession::end_of_mission(const ChildEnd& end) {
  if (end.signal == 0 && fs::exists(plan_.file("mission.json"))) return {};
  return {"failed",
          "the mission runner " + how(end) + "; lianad holds the arm when the owner of motion dies\n" +
              mission_->last_lines(kShownLines),
          end.code == 2};
}

// Of the programs beside the mission runner that have ended the one that ended worst: killed, failed or, unless
// `failed_only`, in order. Exit code 2 means that it refused its input.
std::optional<RunEnd> RunSession::dead_child(bool failed_only) {
  const auto worst = worst_end(children_, [&](const ChildProcess& child, const ChildEnd& end) {
    return &child != mission_ && !(failed_only && end.code == 0);
  });
  if (!worst) return std::nullopt;
  return RunEnd{"failed", worst->text, worst->end.code == 2 && states_.empty()};
}

RunEnd RunSession::interrupted() {
  progress_.say("stopping (again Ctrl-C ends at once)");
  request({{"op", "stop"}, {"reason", "interrupted"}});
  const auto deadline = after(kStopTimeout_s);
  while (api_ && interrupts_.count() < 2 && Clock::now() < deadline && !is_stopped()) look(kLook_s);
  return {"aborted", "interrupted: " + how_the_arm_was_left(), false};
}

// lianad has taken the stop, and the drives are without power.
bool RunSession::is_stopped() const {
  if (!last_state_.is_object()) return false;
  const std::string state = last_state_.value("state", "");
  return last_state_.value("stop", Json()).is_object() && (state == "DISABLED" || state == "FAULT");
}

// What lianad has said, no more.
std::string RunSession::how_the_arm_was_left() const {
  if (!last_state_.is_object()) return "lianad never reported a state of the arm";
  if (is_stopped()) return "the arm was stopped and is " + last_state_.value("state", "");
  char time[32];
  std::snprintf(time, sizeof time, "%.2f s", last_state_.value("time_s", 0.0));
  return std::string(api_ ? "lianad did not confirm the stop" : "lianad was gone before it confirmed the stop") +
         "; the arm was last seen " + last_state_.value("state", "") + ", at " + time +
         "; drives without a master stop and brake by themselves";
}

// Takes in what lianad has sent; a closed socket is noticed through lianad's end.
void RunSession::look(double timeout_s) {
  if (!api_) {
    std::this_thread::sleep_for(std::chrono::duration<double>(timeout_s));
    return;
  }
  bool more = take(timeout_s);
  while (more && (mission_ == nullptr || !mission_->poll())) more = take(0.0);
}

// Takes in one message; false when none came or lianad is gone.
bool RunSession::take(double timeout_s) {
  try {
    const auto message = api_ ? api_->receive(timeout_s) : std::nullopt;
    if (message && message->value("op", "") == "state") keep(*message);
    return message.has_value();
  } catch (const std::runtime_error&) {
    api_.reset();
    return false;
  }
}

void RunSession::keep(const Json& state) {
  progress_.show(state);
  states_.push_back({state.value("tick", std::uint64_t{0}), pose_of(state.value("setpoint_cp", Json()))});
  last_state_ = state;
  const Json step = state.value("step", Json());
  const int index = step.is_object() ? step.value("index", 0) : 0;
  if (index == 0 || state.value("owner", "").empty()) return;
  const std::uint64_t tick = states_.back().tick;
  if (announced_.empty() || announced_.back().index != index) {
    announced_.push_back({index, step.value("name", ""), step.value("device", ""), tick, tick});
  }
  announced_.back().last_tick = tick;
}

void RunSession::request(const Json& message) {
  try {
    if (api_) api_->send(message);
  } catch (const std::runtime_error&) {
    api_.reset();
  }
}

// A lianad that had to be killed leaves its entry among the running systems; looking at them removes it.
void RunSession::remove_stale_entry() const {
  const auto killed = [](const auto& child) {
    return child->name() == "lianad" && child->poll() && child->poll()->signal != 0;
  };
  if (std::none_of(children_.begin(), children_.end(), killed)) return;
  try {
    running_systems();
  } catch (const std::exception&) {
    // a folder that is not ours has no entry of ours
  }
}

// lianad stops the arm and leaves the bus; bus and bench then end by themselves and write their summaries.
void RunSession::shut_down() {
  request({{"op", "shutdown"}});
  auto deadline = after(interrupts_.count() < 2 ? kEndGrace_s : 0.0);
  const auto running = [](const auto& child) { return !child->poll(); };
  while (Clock::now() < deadline && std::any_of(children_.begin(), children_.end(), running)) {
    if (api_) {
      look(kLook_s);
      if (!api_) deadline = std::min(deadline, after(kFinishGrace_s));
    } else {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }
  for (const auto& child : children_) child->end(1.0);
  remove_stale_entry();
  while (take(0.0)) {  // what lianad said last may not have been read yet
  }
}

}  // namespace liana
