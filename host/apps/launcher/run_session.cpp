#include "host/apps/launcher/run_session.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <utility>

#include "host/apps/launcher/observer.hpp"
#include "host/base/file/in_file.hpp"

namespace liana::launcher {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* kName = "liana run";  // as the reason of a stop names it
constexpr const char* kBench = "liana-bench";
constexpr double kStopTimeout_s = 15.0;
constexpr double kFinishGrace_s = 3.0;  // for the mission runner, when another program has ended
constexpr double kLook_s = 0.02;
constexpr double kSilentStop_s = 2.0;  // without a state after a stop: nothing more will come
constexpr double kSilent_s = 10.0;     // without a state: lianad does not go on
constexpr double kRested_s = 5.0;      // at rest after a failure: it is over
constexpr double kMaxAfter_s = 60.0;   // after a failure, at rest or not

Clock::duration seconds(double count) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(count));
}

Clock::time_point after(double count) { return Clock::now() + seconds(count); }

Pose pose_or_none(const Json& numbers) {
  Pose pose;
  if (!numbers.is_array() || numbers.size() != 7) return pose;
  for (std::size_t i = 0; i < 3; ++i) pose.position_m[i] = numbers[i].get<double>();
  for (std::size_t i = 0; i < 4; ++i) pose.quaternion[i] = numbers[i + 3].get<double>();
  return pose;
}

}  // namespace

RunSession::RunSession(const SystemLayout& plan)
    : plan_(plan),
      waits_for_us_(plan.time_mode != "real"),
      has_bench_(std::any_of(plan.programs.begin(), plan.programs.end(),
                             [](const auto& call) { return call.name == kBench; })),
      system_(plan) {}

RunSession::~RunSession() = default;

RunResult RunSession::run() {
  std::signal(SIGPIPE, SIG_IGN);
  RunResult end;
  Json greeting = hello(kName, Observer::kOwning);
  greeting["lockstep"] = waits_for_us_;
  if (const std::string problem = system_.start(greeting, interrupts_.any()); !problem.empty()) {
    end = dead_child(false).value_or(RunResult{"failed", problem, false});
  } else {
    end = watch();
  }
  const bool is_over = end.bad_input || interrupts_.count() >= 2;  // nothing has moved yet, or nobody wants to wait
  system_.end(is_over ? 0.0 : kEndGrace_s, [this](const Json& message) { take(Json(message)); });
  say_how_the_recorder_ended();
  return end;
}

// A new recorder goes on in the archive of the one before; what happened in between is a gap there.
void RunSession::revive_recorder() {
  const auto ended = system_.worst_end([this](const ChildProcess& child, const ExitStatus& end) {
    return child.name() == kRecorder && end.code != 0 && !matters(child);
  });
  if (!ended || recorders_ >= kMaxRecorders) return;
  ++recorders_;
  progress_.say(ended->text + "\nit is started again; what it missed is a gap in the archive");
  system_.start_again(kRecorder);
}

void RunSession::say_how_the_recorder_ended() {
  const auto failed = system_.worst_end(
      [](const ChildProcess& child, const ExitStatus& end) { return child.name() == kRecorder && end.code != 0; });
  if (failed) progress_.say("the archive of this run is not whole: " + failed->text);
}

RunResult RunSession::watch() {
  while (!system_.any_has_ended([this](const ChildProcess& child) { return matters(child); })) {
    look(kLook_s);
    if (interrupts_.count() > 0) return interrupted();
    say_silence();
    revive_recorder();
  }
  const RunResult end = conclusion();
  if (!system_.last().poll())  // without the others it has no purpose; the arm holds when it ends
    system_.send({{"op", "mission_control"}, {"command", "abort"}});
  if (!end.bad_input && (waits_for_us_ || has_failed(end))) follow();
  return end;
}

// A flight recorder that ends while the arm moves is said, and stops nothing: unless a recording is what was asked for.
// Before the first state lianad waits for it.
bool RunSession::matters(const ChildProcess& child) const {
  return child.name() != kRecorder || plan_.keep_directory || states_.empty();
}

// The run is no success as far as processes and mission tell.
bool RunSession::has_failed(const RunResult& end) const {
  const Json mission = Json::parse_or_null(file::content_of(plan_.file("mission.json")).value_or(""));
  return !end.outcome.empty() || mission.value("outcome", "") != "success";
}

// What a failure leads to belongs to the run. In virtual time lianad goes on until the arm is at rest, then ends by
// itself; in real time it holds the arm for as long as nobody says otherwise.
void RunSession::follow() {
  auto deadline = after(kSilent_s), rested = after(kRested_s);
  const auto enough = after(kMaxAfter_s);
  const auto is_enough = [&] { return !waits_for_us_ && Clock::now() > std::min(rested, enough); };
  while (!is_ending() && system_.is_connected() && system_.is_running("lianad") && interrupts_.count() == 0 &&
         Clock::now() < deadline && !is_enough()) {
    const std::uint64_t seen = states_seen_;
    look(kLook_s);
    if (states_seen_ == seen) continue;
    deadline = after(kSilent_s);
    if (!last_state_.value("at_rest", true)) rested = after(kRested_s);
  }
}

// Somebody has ended. The others follow within moments, in any order: who failed by itself is seen only after that.
// Once the mission has ended, the others end in order.
RunResult RunSession::conclusion() {
  look_until(kFinishGrace_s, [this] { return system_.last().poll().has_value(); });
  const auto end = system_.last().poll();  // the mission runner's
  if (!end || end->code != 0) {
    look_until(kAftermath_s, [this] { return system_.all_have_ended(); });
    if (const auto failed = dead_child(true)) return *failed;
  }
  if (end) return end_of_mission(*end);
  if (const std::string still = system_.standing_still(); !still.empty())
    return {"failed", still + " stopped, and the others did not wait for it any longer", false};
  return *dead_child(false);
}

// A mission runner that ended by itself has written its report; one that was killed has not.
RunResult RunSession::end_of_mission(const ExitStatus& end) {
  if (end.signal == 0 && fs::exists(plan_.file("mission.json"))) return {};
  return {"failed",
          "the mission runner " + how(end) + "; lianad holds the arm when the owner of motion dies\n" +
              system_.last().last_lines(kShownLines),
          end.code == 2};
}

// Of the programs beside the mission runner that have ended the one that ended worst: killed, failed or, unless
// `failed_only`, in order. Exit code 2 means that it refused its input.
std::optional<RunResult> RunSession::dead_child(bool failed_only) {
  const auto counts = [&](const ChildProcess& child, const ExitStatus& end) {
    return child.name() != "liana-mission" && matters(child) && !(failed_only && end.code == 0);
  };
  const auto worst = system_.worst_end(counts);
  if (!worst) return std::nullopt;
  return RunResult{"failed", worst->text, worst->end.code == 2 && states_.empty()};
}

RunResult RunSession::interrupted() {
  progress_.say("stopping (again Ctrl-C ends at once)");
  system_.send({{"op", "stop"}, {"reason", "interrupted"}});
  const auto deadline = after(kStopTimeout_s);
  watch_.heard();
  while (system_.is_connected() && interrupts_.count() < 2 && Clock::now() < deadline && !is_stopped() &&
         !watch_.silent_for(kSilentStop_s))
    look(kLook_s);
  return {"aborted", "interrupted: " + how_the_arm_was_left(), false};
}

bool RunSession::is_ending() const { return last_state_.is_object() && last_state_.value("stopping", false); }

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
  return std::string(system_.is_connected() ? "lianad did not confirm the stop"
                                            : "lianad was gone before it confirmed the stop") +
         "; the arm was last seen " + last_state_.value("state", "") + ", at " + time +
         "; drives without a master stop and brake by themselves";
}

// Takes in what lianad has sent; a closed socket is noticed through lianad's end.
void RunSession::look(double timeout_s) {
  auto message = system_.receive(timeout_s);
  while (message) {
    take(std::move(*message));
    if (system_.last().poll()) return;  // that is acted on before more is read
    message = system_.receive(0.0);
  }
}

// Nothing moves any more, and nobody would know why.
void RunSession::say_silence() {
  if (const auto silence = watch_.silence(system_)) progress_.say(*silence + "; Ctrl-C ends the run");
}

void RunSession::look_until(double timeout_s, const std::function<bool()>& is_over) {
  const auto deadline = after(timeout_s);
  while (!is_over() && Clock::now() < deadline) look(kLook_s);
}

void RunSession::take(Json message) {
  const std::string op = message.value("op", "");
  if (op == "welcome") welcome_ = std::move(message);
  if (op != "state") return;
  last_state_ = std::move(message);
  keep(last_state_);
  if (!waits_for_us_) return;
  if (is_ending()) system_.dismiss();  // in the interval in which every run does
  system_.send({{"op", "done"}, {"tick", last_state_.value("tick", std::uint64_t{0})}});
}

void RunSession::keep(const Json& state) {
  watch_.heard();
  progress_.show(state);
  ++states_seen_;
  if (!has_bench_) states_.clear();
  states_.push_back({state.value("tick", std::uint64_t{0}), pose_or_none(state.member_or_null("setpoint_cp"))});
  report::keep_stage(stages_, state);
  const Json& clearance = state.member_or_null("clearance");
  if (has_bench_ && clearance.is_object() && states_.back().tick > 0)  // of the angles at the tick before
    claims_.push_back({states_.back().tick - 1, clearance.value("distance_m", 0.0)});
  samples_.look(state);
  const Json& step = state.member_or_null("step");
  const int index = step.is_object() ? step.value("index", 0) : 0;
  if (index == 0 || state.value("owner", "").empty()) return;
  const std::uint64_t tick = states_.back().tick;
  if (announced_.empty() || announced_.back().index != index) {
    announced_.push_back({index, step.value("name", ""), step.value("device", ""), tick, tick});
  }
  announced_.back().last_tick = tick;
}

}  // namespace liana::launcher
