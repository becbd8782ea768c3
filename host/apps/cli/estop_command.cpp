// The emergency stop of every running system, side by side: none waits for another, nothing that fails keeps it from
// the others, and within a second it is said which one could not be reached.
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "host/api/server/registry.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/observer.hpp"
#include "host/base/json/json.hpp"
#include "host/base/net/socket.hpp"

namespace liana::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kPatience_s = 0.9;  // for all of them together
constexpr useconds_t kLook_us = 2000;

// The stop of one system, as far as it has come. Nothing in it ever waits.
class StopCall {
 public:
  explicit StopCall(const std::string& api) : api_(api) {}

  const std::string& api() const { return api_; }
  bool is_over() const { return stage_ == Stage::kConfirmed || !failed_.empty(); }
  bool is_confirmed() const { return stage_ == Stage::kConfirmed; }
  // Why it has not been confirmed so far.
  std::string problem() const {
    if (!failed_.empty()) return failed_;
    if (stage_ == Stage::kOutside) return "cannot be reached (" + hindrance_ + "); cut the power";
    return "lianad did not confirm the stop, perhaps it stands still; cut the power";
  }

  void go_on() {
    try {
      if (stage_ == Stage::kOutside) connect();
      if (stage_ == Stage::kSending) send();
      if (stage_ == Stage::kSent) listen();
    } catch (const std::exception& error) {
      failed_ = error.what();
    }
    if (is_over()) fd_ = api::UniqueFd();  // descriptors may be few, and others need one
  }

 private:
  enum class Stage { kOutside, kSending, kSent, kConfirmed };

  // A lianad that stands still has a full queue of connections: trying again costs nothing, waiting would cost all.
  void connect() {
    fd_ = api::try_to_connect(api_);
    if (fd_.get() >= 0) {
      stage_ = Stage::kSending;
      return;
    }
    hindrance_ = errno == EAGAIN ? "its queue of connections is full: lianad stands still" : std::strerror(errno);
  }
  void send() {
    static const std::string kHello =
        Json{{"op", "hello"}, {"name", "liana estop"}, {"role", "observer"}, {"lockstep", false}}.dump();
    static const std::string kStop = Json{{"op", "stop"}, {"id", 1}}.dump();
    while (sent_ < 2) {
      const api::SocketResult result = api::send_packet(fd_.get(), sent_ == 0 ? kHello : kStop);
      if (result == api::SocketResult::kWouldBlock) return;
      if (result == api::SocketResult::kClosed) return start_again();
      ++sent_;
    }
    stage_ = Stage::kSent;
  }
  // Where every place is taken hello is refused, but not the stop: only its own answer counts, whatever else comes.
  void listen() {
    std::string packet;
    api::SocketResult result = api::SocketResult::kDone;
    while ((result = api::receive_packet(fd_.get(), packet)) == api::SocketResult::kDone) {
      const Json answer = Json::parse_or_null(packet);
      if (answer.member_or_null("id") != 1) continue;
      if (answer.value("op", "") == "ok") stage_ = Stage::kConfirmed;
      if (answer.value("op", "") == "error") failed_ = "lianad: " + answer.value("message", answer.dump());
      return;
    }
    if (result == api::SocketResult::kClosed) start_again();
  }
  void start_again() {
    hindrance_ = "lianad closed the connection";
    fd_ = api::UniqueFd();
    sent_ = 0;
    stage_ = Stage::kOutside;
  }

  std::string api_;
  api::UniqueFd fd_;
  Stage stage_ = Stage::kOutside;
  int sent_ = 0;  // packets
  std::string hindrance_, failed_;
};

void stop_all(std::vector<StopCall>& calls) {
  const auto deadline = Clock::now() + std::chrono::duration<double>(kPatience_s);
  const auto is_open = [](const StopCall& call) { return !call.is_over(); };
  for (;;) {
    for (StopCall& call : calls) {
      if (is_open(call)) call.go_on();
    }
    if (std::none_of(calls.begin(), calls.end(), is_open) || Clock::now() > deadline) return;
    ::usleep(kLook_us);
  }
}

void print(const StopCall& call, bool json) {
  if (json) {
    Json line{{"api", call.api()}, {"stopped", call.is_confirmed()}};
    if (!call.is_confirmed()) line["problem"] = call.problem();
    std::puts(line.dump(-1, Json::BadUtf8::kReplace).c_str());
  } else if (call.is_confirmed()) {
    std::printf("%s: stop, brakes, then disabled\n", call.api().c_str());
  }
  if (!call.is_confirmed()) std::fprintf(stderr, "liana: %s: %s\n", call.api().c_str(), call.problem().c_str());
}

std::string places_of(const std::vector<api::Unseen>& unseen) {
  std::string text;
  for (const api::Unseen& each : unseen) text += (text.empty() ? "" : ", ") + each.place + " (" + each.why + ")";
  return text;
}

std::string nothing_stopped(const std::string& why) {
  return "NOTHING WAS STOPPED. If an arm moves, cut its power. " + why;
}

// Every stop is on its way before the next place is looked at.
std::vector<api::Unseen> call_all(const std::string& given, std::vector<StopCall>& calls) {
  const auto call = [&calls](const std::string& api) { calls.emplace_back(api).go_on(); };
  if (given.empty()) return api::look_everywhere(call);
  try {
    call(launcher::systems_to_ask(given).front());
  } catch (const launcher::BadInput& error) {
    throw launcher::BadInput(nothing_stopped(error.what()));
  }
  return {};
}

[[noreturn]] void end_without_systems(const std::vector<api::Unseen>& unseen, bool all_seen) {
  const std::string text = nothing_stopped("No running system was found in " + api::places_to_look() +
                                           (unseen.empty() ? "" : "; could not look at " + places_of(unseen)));
  if (all_seen) throw launcher::NothingStopped(text);
  throw std::runtime_error(text);
}

}  // namespace

int estop_command(const ClientOptions& options) {
  std::vector<StopCall> calls;
  const std::vector<api::Unseen> unseen = call_all(options.api, calls);
  const bool all_seen =
      std::none_of(unseen.begin(), unseen.end(), [](const api::Unseen& each) { return each.is_ours; });
  if (calls.empty()) end_without_systems(unseen, all_seen);
  stop_all(calls);
  for (const StopCall& call : calls) print(call, options.json);
  if (!unseen.empty()) std::fprintf(stderr, "liana: could not look for systems at %s\n", places_of(unseen).c_str());
  const bool all = std::all_of(calls.begin(), calls.end(), [](const StopCall& call) { return call.is_confirmed(); });
  return all && all_seen ? launcher::kExitOk : launcher::kExitFailure;
}

}  // namespace liana::cli
