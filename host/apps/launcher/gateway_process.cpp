#include "host/apps/launcher/gateway_process.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/health_check.hpp"
#include "host/apps/launcher/runs.hpp"
#include "host/base/clock/steady.hpp"

namespace liana::launcher {
namespace {

constexpr const char* kUsual = "127.0.0.1:8765";
constexpr const char* kFreePort = "127.0.0.1:0";
constexpr const char* kSays = "liana-gateway: ";
constexpr double kPatience_s = 10.0;
constexpr double kLookAfter_s = 0.05;
constexpr double kFirstPause_s = 0.1, kLongestPause_s = 10.0;  // before it is started again
constexpr double kStays_s = 60.0;                              // it is well again
constexpr int kMaxTold = 3;                                    // ends in a row that are said
constexpr double kMaxSilence_s = 15.0;                         // it hangs

using GatewayClock = std::chrono::steady_clock;

GatewayClock::duration wall_s(double count) {
  return std::chrono::duration_cast<GatewayClock::duration>(std::chrono::duration<double>(count));
}

// The last line with an address: a gateway that was started again has written another one.
std::string address_in(const std::string& log_file) {
  std::ifstream log(log_file);
  std::string address;
  for (std::string line; std::getline(log, line);) {
    if (line.starts_with("http") && !log.eof()) address = line;
  }
  return address;
}

std::string without_name(std::string text) {
  if (text.starts_with(kSays)) text.erase(0, std::string(kSays).size());
  return text;
}

}  // namespace

GatewayProcess::GatewayProcess(std::string api, GatewayOptions options, std::string log_file)
    : api_(std::move(api)), log_file_(std::move(log_file)), options_(std::move(options)) {
  try {
    start(options_.listen.empty() ? kUsual : options_.listen);
  } catch (const BadInput&) {
    if (!options_.listen.empty()) throw;
    start(kFreePort);
  }
  thread_ = std::thread([this] { look_after(); });
}

GatewayProcess::~GatewayProcess() {
  over_ = true;
  if (thread_.joinable()) thread_.join();
}

void GatewayProcess::start(const std::string& listen) {
  std::vector<std::string> argv{sibling_program("liana-gateway"), "--api", api_, "--listen", listen};
  const auto add = [&argv](const char* option, const std::string& value) {
    if (!value.empty()) argv.insert(argv.end(), {option, value});
  };
  add("--token-file", options_.token_file);
  add("--cert", options_.certificate);
  add("--key", options_.key);
  add("--practice", options_.practice);
  add("--runs", runs_folder());
  child_ = std::make_unique<ChildProcess>("liana-gateway", argv, log_file_);
  wait_until_it_listens();
}

void GatewayProcess::wait_until_it_listens() {
  const auto deadline = GatewayClock::now() + wall_s(kPatience_s);
  while (GatewayClock::now() < deadline && !over_) {
    const std::optional<ExitStatus> end = child_->poll();
    if (end && end->code == kExitBadInput) throw BadInput(without_name(child_->last_lines(1)));
    if (end) throw std::runtime_error("liana-gateway " + how(*end) + "\n" + child_->last_lines(kShownLines));
    if (address_.empty()) address_ = address_in(log_file_);
    if (!address_.empty()) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  throw std::runtime_error("liana-gateway did not listen within 10 s\n" + child_->last_lines(kShownLines));
}

void GatewayProcess::pause(double length_s) {
  const auto end = GatewayClock::now() + wall_s(length_s);
  while (!over_ && GatewayClock::now() < end) std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

// ADDR:PORT.
std::string GatewayProcess::place() const {
  const std::size_t begin = address_.find("//") + 2;
  return address_.substr(begin, address_.size() - begin - 1);
}

// How it ended, in words; nothing while it lives. One that hangs is killed: it would keep its port.
std::optional<std::string> GatewayProcess::look(HealthCheck& health) {
  if (const std::optional<ExitStatus> end = child_->poll()) return how(*end);
  if (health.silent_s(timing::steady_s()) < kMaxSilence_s) return std::nullopt;
  const std::optional<pid_t> stopped = child_->stopped();
  child_->end(0.0);
  return "answered nothing for " + std::to_string(static_cast<int>(kMaxSilence_s)) + " s and was ended" +
         (stopped ? ": its process " + std::to_string(*stopped) + " was stopped (SIGSTOP, a debugger)" : std::string());
}

// Its port may be taken for a moment, by a connection of somebody else: another try follows.
std::string GatewayProcess::started_again() {
  try {
    start(place());
    return "";
  } catch (const std::exception& error) {
    child_->end(0.0);
    return error.what();
  }
}

void GatewayProcess::look_after() {
  double pause_s = kFirstPause_s;
  int ends = 0;
  auto since = GatewayClock::now();
  HealthCheck health(api::parse_internet_address("--listen", place()), timing::steady_s());
  for (; !over_; pause(kLookAfter_s)) {
    const std::optional<std::string> end = look(health);
    if (!end) continue;
    if (GatewayClock::now() - since > wall_s(kStays_s)) pause_s = kFirstPause_s, ends = 0;
    pause(pause_s);
    if (over_) return;
    pause_s = std::min(2.0 * pause_s, kLongestPause_s);
    const std::string problem = started_again();
    since = GatewayClock::now();
    health.restart(timing::steady_s());
    if (++ends > kMaxTold) continue;
    std::fprintf(stderr, "liana: liana-gateway %s; %s%s\n", end->c_str(),
                 problem.empty() ? "it was started again" : ("it is not there again yet: " + problem).c_str(),
                 ends == kMaxTold ? "; further ends of it are not said before it has stayed for a minute" : "");
  }
}

}  // namespace liana::launcher
