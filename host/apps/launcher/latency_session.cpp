#include "host/apps/launcher/latency_session.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/observer.hpp"

namespace liana::launcher {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kReadyTimeout_s = 20.0;  // boot and enabling, each; they take about 2 s
constexpr double kAnswerTimeout_s = 10.0;
constexpr double kStateLook_s = 0.05;
constexpr double kWay_m = 0.1;        // the tip's, to and fro along the base's z, at most
constexpr double kWayOfReach = 0.16;  // of how far the tip is from the base
// Bus and bench stand for hardware, which is never late for want of a processor; under lianad's real-time thread (80).
constexpr int kHardwarePriority = 70;

double now_s() { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); }

void show_progress(double passed_s, double seconds) {
  if (isatty(STDERR_FILENO) == 0) return;
  dprintf(STDERR_FILENO, passed_s < seconds ? "\r\x1b[Kmeasuring: %.0f of %.0f s" : "\r\x1b[K", passed_s, seconds);
}

}  // namespace

SystemLayout for_latency(SystemLayout layout) {
  for (ProgramCall& call : layout.programs) {
    if (call.name != "lianad") call.realtime_priority = kHardwarePriority;
  }
  return layout;
}

LatencySession::LatencySession(const SystemLayout& plan) : system_(plan) {}

LatencySession::~LatencySession() {
  system_.end(kEndGrace_s, [](const Json&) {});
}

report::LatencyMeasurement LatencySession::measure(double seconds) {
  start();
  report::LatencyMeasurement measured;
  measured.enabled = enable();
  ask({{"op", "timing"}, {"reset", true}});
  const double begin_s = now_s();
  int states = 0, moving = 0;
  for (double passed_s = 0.0; passed_s < seconds; passed_s = now_s() - begin_s) {
    show_progress(passed_s, seconds);
    look(std::min(kStateLook_s, seconds - passed_s));
    measured.enabled = measured.enabled && state_.value("state", "") == "ENABLED";
    ++states;
    moving += state_.value("at_rest", true) ? 0 : 1;
    if (measured.enabled) keep_moving();
  }
  show_progress(seconds, seconds);
  measured.timing = ask({{"op", "timing"}});
  if (measured.timing.value("op", "") != "ok")
    throw std::runtime_error("lianad: " + measured.timing.value("message", ""));
  measured.last_state = state_;
  measured.moving = states == 0 ? 0.0 : static_cast<double>(moving) / states;
  return measured;
}

void LatencySession::start() {
  const std::string problem = system_.start(hello("liana latency", Observer::kClient), interrupts_.any());
  if (problem.empty()) return;
  require_alive();
  throw std::runtime_error(problem);
}

bool LatencySession::enable() {
  if (!reaches("DISABLED")) return false;
  ask({{"op", "acquire"}});
  return ask({{"op", "state_command"}, {"command", "enable"}}).value("op", "") == "ok" && reaches("ENABLED");
}

void LatencySession::keep_moving() {
  if (state_.value("is_busy", true) || !state_.contains("setpoint_cp")) return;
  if (ends_.empty()) {
    Json away = state_["setpoint_cp"];
    const double reach_m = std::hypot(away[0].get<double>(), away[1].get<double>(), away[2].get<double>());
    away[2] = away[2].get<double>() + std::min(kWay_m, kWayOfReach * reach_m);
    ends_ = {away, state_["setpoint_cp"]};
  }
  if (ask({{"op", "move_cp"}, {"goal", ends_[0]}}).value("op", "") != "ok") return;
  std::swap(ends_[0], ends_[1]);
  const double deadline_s = now_s() + kAnswerTimeout_s;  // until a state tells of it
  while (!state_.value("is_busy", false) && now_s() < deadline_s) look(kStateLook_s);
}

bool LatencySession::reaches(const std::string& state) {
  const double deadline_s = now_s() + kReadyTimeout_s;
  while (now_s() < deadline_s && state_.value("state", "") != "FAULT") {
    look(kStateLook_s);
    if (state_.value("state", "") == state && state_.value("is_homed", false) && state_.value("at_rest", false))
      return true;
  }
  return false;
}

void LatencySession::look(double timeout_s) {
  require_alive();
  const std::optional<Json> message = system_.receive(timeout_s);
  if (!message && !system_.is_connected()) {
    require_alive(kAftermath_s);
    throw std::runtime_error("lianad has left");
  }
  if (const auto silence = watch_.silence(system_)) std::fprintf(stderr, "liana: %s\n", silence->c_str());
  if (!message) return;
  watch_.heard();
  const std::string op = message->value("op", "");
  if (op == "state") state_ = *message;
  if (op == "ok" || op == "error") answer_ = *message;
}

Json LatencySession::ask(Json request) {
  request["id"] = ++last_id_;
  system_.send(request);
  const double deadline_s = now_s() + kAnswerTimeout_s;
  while (answer_.value("id", 0) != last_id_) {
    if (now_s() > deadline_s)
      throw std::runtime_error("lianad did not answer " + request.value("op", "") + " within 10 s");
    look(kStateLook_s);
  }
  return answer_;
}

void LatencySession::require_alive(double settle_s) {
  if (interrupts_.count() > 0) throw Interrupted("interrupted: the arm is stopped, nothing was measured");
  const auto worst = system_.worst_end([](const ChildProcess&, const ExitStatus&) { return true; }, settle_s);
  if (worst) throw std::runtime_error(worst->text);
}

}  // namespace liana::launcher
