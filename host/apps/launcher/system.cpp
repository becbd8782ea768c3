#include "host/apps/launcher/system.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <utility>

#include "host/api/server/registry.hpp"

namespace liana::launcher {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kSummaryGrace_s = 3.0;  // for the others to write their summaries after lianad has left
constexpr double kRestGrace_s = 20.0;    // for a bench, which goes on until its arm is at rest
constexpr double kLastGrace_s = 1.0;     // from SIGTERM to SIGKILL, for all together
constexpr double kProcessLook_s = 0.02;

Clock::time_point time_after(double seconds) {
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

void sleep(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

}  // namespace

System::~System() { end(0.0); }

std::string System::start(const Json& hello, const std::atomic<bool>& stop) {
  for (const ProgramCall& call : layout_.programs) {
    children_.push_back(
        std::make_unique<ChildProcess>(call.name, call.argv, layout_.file(call.name + ".log"), call.realtime_priority));
    const bool is_daemon = call.name == "lianad";
    if (!is_daemon && call.name != "liana-bus") continue;
    const std::string socket = is_daemon ? layout_.api_socket() : layout_.bus_socket();
    if (!wait_for_socket(socket, *children_.back(), stop)) return call.name + " did not open its socket within 30 s";
    if (!is_daemon) continue;
    api_ = api::ApiClient::connect(socket);
    api_->send(hello);
  }
  return "";
}

void System::start_again(std::string_view name) {
  for (std::size_t i = 0; i < children_.size(); ++i) {
    const ProgramCall& call = layout_.programs[i];
    if (call.name != name) continue;
    children_[i] =
        std::make_unique<ChildProcess>(call.name, call.argv, layout_.file(call.name + ".log"), call.realtime_priority);
  }
}

std::optional<Json> System::receive(double timeout_s) {
  if (!api_) {
    sleep(std::min(timeout_s, kProcessLook_s));
    return std::nullopt;
  }
  try {
    return api_->receive(timeout_s);
  } catch (const std::runtime_error&) {
    api_.reset();
    return std::nullopt;
  }
}

void System::send(const Json& message) {
  try {
    if (api_) api_->send(message);
  } catch (const std::runtime_error&) {
    api_.reset();
  }
}

std::optional<NamedResult> System::worst_end(const Counts& counts, double settle_s) {
  const auto deadline = time_after(settle_s);
  while (Clock::now() < deadline && !all_have_ended()) sleep(kProcessLook_s);
  return liana::launcher::worst_end(children_, counts);
}

bool System::any_has_ended() const {
  return any_has_ended([](const ChildProcess&) { return true; });
}

bool System::any_has_ended(const std::function<bool(const ChildProcess&)>& matters) const {
  return std::any_of(children_.begin(), children_.end(),
                     [&](const auto& child) { return child->poll().has_value() && matters(*child); });
}

bool System::is_running(std::string_view name) const {
  return std::any_of(children_.begin(), children_.end(),
                     [&](const auto& child) { return child->name() == name && !child->poll(); });
}

std::string System::standing_still() const {
  std::string names;
  for (const auto& child : children_) {
    if (const auto process = child->stopped())
      names += (names.empty() ? "" : ", ") + child->name() + " (process " + std::to_string(*process) + ")";
  }
  return names;
}

bool System::all_have_ended() const {
  return std::all_of(children_.begin(), children_.end(), [](const auto& child) { return child->poll().has_value(); });
}

void System::dismiss() {
  if (!std::exchange(shutdown_requested_, true)) send({{"op", "shutdown"}});
}

void System::end(double grace_s, const Sink& sink) {
  dismiss();
  if (!sink) api_.reset();  // a client in lockstep that no longer answers would hold lianad up
  auto deadline = time_after(standing_still().empty() ? grace_s : 0.0);
  while (Clock::now() < deadline && !all_have_ended()) {
    const bool was_connected = is_connected();
    if (const auto message = receive(kProcessLook_s); message && sink) sink(*message);
    if (was_connected && !is_connected())
      deadline = std::min(deadline, time_after(is_running("liana-bench") ? kRestGrace_s : kSummaryGrace_s));
  }
  for (const auto& child : children_) child->ask_to_end();
  const auto last_moment = time_after(kLastGrace_s);
  while (Clock::now() < last_moment && !all_have_ended()) sleep(kProcessLook_s);
  for (const auto& child : children_) child->end(0.0);
  remove_stale_entry();
  while (const auto message = receive(0.0)) {  // what lianad said last may not have been read yet
    if (sink) sink(*message);
  }
}

// A lianad that had to be killed leaves its entry among the running systems; looking at them removes it.
void System::remove_stale_entry() const {
  const auto killed = [](const auto& child) {
    return child->name() == "lianad" && child->poll() && child->poll()->signal != 0;
  };
  if (std::none_of(children_.begin(), children_.end(), killed)) return;
  try {
    api::running_systems();
  } catch (const std::exception&) {
    // a folder that is not ours has no entry of ours
  }
}

}  // namespace liana::launcher
