#include <cstdio>
#include <stdexcept>

#include "host/apps/cli/clearing.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/observer.hpp"
#include "host/base/event/fault_groups.hpp"
#include "host/operator/terminal/state_text.hpp"

namespace liana::cli {
namespace {

constexpr double kEnable_s = 65.0;   // of arm time: a ramp of tension has 60 s
constexpr double kTold_s = 5.0;      // of arm time, from line to line of progress
constexpr double kDisable_s = 15.0;  // of arm time
constexpr int kRetracts = 3;         // each tries every place up to ten times itself

// One recovery, step by step; lines of progress go to stderr.
class Recovery {
 public:
  explicit Recovery(const std::string& api) : client_(api::ApiClient::connect(api, kConnectTimeout_s)) {}

  // Throws std::runtime_error with what keeps the arm where it is.
  void run() {
    launcher::say_hello(client_, "liana recover", launcher::Observer::kClient);
    begin();
    clear();
    enable();
    lead_back();
    disable();
  }
  const Json& loss() const { return loss_; }
  const Json& state() const { return state_; }
  const std::string& taken_from() const { return taken_from_; }

 private:
  void tell(const std::string& text) {
    std::fprintf(stderr, "%8.1f s  %s\n", state_.value("time_s", 0.0), text.c_str());
  }
  const Json& look() { return state_ = next_state(client_); }
  std::string name() const { return state_.value("state", ""); }
  double time_s() const { return state_.value("time_s", 0.0); }
  void request(Json message) { ask(client_, std::move(message), ++asked_); }
  void command(const char* what) { request({{"op", "state_command"}, {"command", what}}); }

  void begin() {
    loss_ = look().value("recovery", Json());
    taken_from_ = take_motion(client_, state_, ++asked_);
    if (!taken_from_.empty()) tell("motion was taken from '" + taken_from_ + "'");
    if (!loss_.is_object()) return command("recover");  // lianad says why not
    std::string slack;
    for (const Json& cable : loss_["slack"]) slack += (slack.empty() ? "" : ", ") + std::to_string(cable.get<int>());
    tell("lost: " + loss_.value("where", "") + "; cables " + slack +
         " stay slack, the others are pulled by their plan");
  }

  void clear() {
    const bool had_fault = !state_.value("faults", Json::array()).empty();
    if (name() == "ENABLED") return;
    command("recover");
    if (!had_fault) return;
    const event::Event verdict = clear_verdict(client_);
    if (verdict.number != 0) throw std::runtime_error(verdict.text);
    tell("cleared for the way back");
  }

  void enable() {
    if (name() == "ENABLED") return;
    while (look().value("state", "") != "DISABLED") require_no_fault();
    command("enable");
    tell("enabling");
    const double begin_s = time_s();
    std::string waits;
    while (look().value("state", "") != "ENABLED") {
      require_no_fault();
      const std::string now = state_.value("enabling_waits", "");
      if (!now.empty() && now != waits) tell("enabling waits: " + (waits = now));
      if (time_s() > begin_s + kEnable_s) throw std::runtime_error("not enabled within 65 s" + because(waits));
      if (name() == "DISABLED" && time_s() > begin_s + 1.0)
        throw std::runtime_error("the arm is DISABLED again" + because(waits));
    }
    tell("enabled: only the way back is allowed");
  }

  void lead_back() {
    std::string reason;
    for (int i = 0; i < kRetracts; ++i) {
      look();
      request({{"op", "retract"}});
      if (goes_back(reason)) return tell("the arm is back at the beginning of its path");
      tell("held: " + reason);
    }
    throw std::runtime_error("the arm is held, with tension: " + reason);
  }

  // True: all the way. `reason`: why not.
  bool goes_back(std::string& reason) {
    double told_s = -kTold_s;
    for (std::string phase = "stopping"; phase != "done"; phase = state_["retract"].value("phase", "")) {
      if (phase == "ended") {
        reason = state_["retract"].value("reason", "");
        return false;
      }
      look();
      require_enabled();
      if (time_s() < told_s + kTold_s) continue;
      told_s = time_s();
      if (const std::string left = terminal::retract_progress(state_); !left.empty()) tell(left);
    }
    return true;
  }

  void disable() {
    command("disable");
    const double begin_s = time_s();
    while (look().value("state", "") != "DISABLED" && name() != "FAULT" && time_s() < begin_s + kDisable_s) continue;
    request({{"op", "release"}});
    tell(name() + ": brakes closed, no torque");
  }

  static std::string because(const std::string& waits) { return waits.empty() ? "" : ": " + waits; }
  void require_no_fault() const {
    const auto groups = event::fault_groups(state_.value("faults", Json::array()));
    if (!groups.empty()) throw std::runtime_error("fault " + groups.front().alarm() + ": " + groups.front().text);
  }
  // A fault that holds leaves the way back open.
  void require_enabled() const {
    if (name() == "ENABLED") return;
    require_no_fault();
    throw std::runtime_error("the arm is " + name() + " and no longer goes back");
  }

  api::ApiClient client_;
  Json loss_, state_ = Json::object();
  std::string taken_from_;  // who owned motion; empty: nobody did
  int asked_ = 0;
};

}  // namespace

int recover_command(const ClientOptions& options) {
  const std::string api = only_system("recover", options.api);
  Json result{{"api", api}, {"recovered", false}, {"said", ""}, {"taken_from", ""}};
  try {
    Recovery recovery(api);
    try {
      recovery.run();
      result["recovered"] = true;
    } catch (const std::exception& error) {
      result["said"] = error.what();
    }
    result["recovery"] = recovery.loss();
    result["taken_from"] = recovery.taken_from();
    result["state"] = recovery.state().value("state", "");
    result["points_left"] = recovery.state().value("retract", Json::object()).value("points_left", 0);
  } catch (const std::exception& error) {
    result["said"] = error.what();
  }
  const bool good = result["recovered"].get<bool>();
  if (options.json)
    std::puts(result.dump().c_str());
  else if (good)
    std::printf("%s: out, without %s; replace the cable, then follow docs/how-to/a-cable-broke.md\n", api.c_str(),
                result["recovery"].value("where", "").c_str());
  if (!good) std::fprintf(stderr, "liana: %s: %s\n", api.c_str(), result["said"].text().c_str());
  return good ? launcher::kExitOk : launcher::kExitFailure;
}

}  // namespace liana::cli
