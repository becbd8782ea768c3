// The emergency stop of every running system, side by side: none waits for another, and within a second it is said
// which one could not be reached.
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>

#include "host/api/address.hpp"
#include "host/api/socket.hpp"
#include "host/cli/commands.hpp"
#include "host/json/json.hpp"
#include "host/system/errors.hpp"
#include "host/system/observer.hpp"

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
  }

 private:
  enum class Stage { kOutside, kSending, kSent, kConfirmed };

  // A lianad that stands still has a full queue of connections: trying again costs nothing, waiting would cost all.
  void connect() {
    const sockaddr_un address = api::unix_address(api_);
    api::UniqueFd fd(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    if (fd.get() >= 0 && ::connect(fd.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
      fd_ = std::move(fd);
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
  // Where every place is taken hello is refused, but not the stop: only its own answer counts.
  void listen() {
    std::string packet;
    api::SocketResult result = api::SocketResult::kDone;
    while ((result = api::receive_packet(fd_.get(), packet)) == api::SocketResult::kDone) {
      const Json answer = Json::parse(packet);
      if (answer.value("id", 0) != 1) continue;
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
    std::puts(Json{{"api", call.api()}, {"stopped", call.is_confirmed()}}.dump().c_str());
  } else if (call.is_confirmed()) {
    std::printf("%s: stop, brakes, then disabled\n", call.api().c_str());
  }
  if (!call.is_confirmed()) std::fprintf(stderr, "liana: %s: %s\n", call.api().c_str(), call.problem().c_str());
}

}  // namespace

int estop_command(const ClientOptions& options) {
  std::vector<StopCall> calls;
  for (const std::string& api : system::systems_to_ask(options.api)) calls.emplace_back(api);
  stop_all(calls);
  for (const StopCall& call : calls) print(call, options.json);
  const bool all = std::all_of(calls.begin(), calls.end(), [](const StopCall& call) { return call.is_confirmed(); });
  return all ? system::kExitOk : system::kExitFailure;
}

}  // namespace liana::cli
