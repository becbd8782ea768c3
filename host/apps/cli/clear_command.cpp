#include <chrono>
#include <cstdio>
#include <optional>
#include <stdexcept>

#include "host/api/server/client.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/observer.hpp"
#include "host/base/event/event_json.hpp"
#include "host/base/event/fault_groups.hpp"
#include "host/base/json/json.hpp"

namespace liana::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kVerdictTimeout_s = 15.0;  // the drives get their reset first

// What a clear is for, as it was before and as lianad judged it.
struct Clearing {
  Json stop;         // as in the state; null: no emergency stop was in force
  Json faults;       // as in the state
  std::string said;  // of the faults; empty when there were none
  bool good = true;
  bool is_needed() const { return !stop.is_null() || !faults.empty(); }
};

std::string only_system(const std::string& given) {
  const std::vector<std::string> systems = launcher::systems_to_ask(given);
  if (systems.size() == 1) return systems.front();
  std::string names;
  for (const std::string& system : systems) names += (names.empty() ? "" : ", ") + system;
  throw launcher::BadInput("clear: several systems run: " + names + "; name the one you have looked at with --api");
}

Json state_of(api::ApiClient& client) {
  auto state = launcher::wait_for(client, "state", kAnswerTimeout_s);
  if (!state) throw std::runtime_error("lianad runs but sent no state within 5 s: see docs/how-to/nothing-answers.md");
  return *state;
}

// An arm that is still on its way to standing still is left alone.
void require_settled(const Clearing& before, const Json& state) {
  const std::string name = state.value("state", "");
  const bool settled = name == "DISABLED" || name == "FAULT" || (before.stop.is_null() && name == "ENABLED");
  if (!settled)
    throw std::runtime_error("nothing was cleared: the arm is " + name +
                             "; wait until liana status says DISABLED or FAULT");
}

void ask(api::ApiClient& client, Json request, int id) {
  request["id"] = id;
  client.send(request);
  if (!launcher::wait_for(client, "ok", kAnswerTimeout_s))
    throw std::runtime_error("lianad did not answer " + request.value("op", "") +
                             " within 5 s: see docs/how-to/nothing-answers.md");
}

// What lianad says of the faults it was to clear.
event::Event verdict(api::ApiClient& client) {
  const auto deadline = Clock::now() + std::chrono::duration<double>(kVerdictTimeout_s);
  while (Clock::now() < deadline) {
    const auto message = launcher::wait_for(client, "event", kAnswerTimeout_s);
    if (message && message->value("kind", "") == event::event_kind_name(event::EventKind::kClear))
      return event::event_from_json(*message);
  }
  throw std::runtime_error("lianad did not say within 15 s whether the faults are cleared; look with liana status");
}

void clear(api::ApiClient& client, Clearing& clearing) {
  launcher::say_hello(client, "liana clear", launcher::Observer::kClient);
  const Json state = state_of(client);
  clearing.stop = state.value("stop", Json());
  clearing.faults = state.value("faults", Json::array());
  if (!clearing.is_needed()) return;
  require_settled(clearing, state);
  ask(client, {{"op", "acquire"}}, 1);
  ask(client, {{"op", "state_command"}, {"command", "clear"}}, 2);
  if (!clearing.faults.empty()) {
    const event::Event result = verdict(client);
    clearing.said = result.text;
    clearing.good = result.number == 0;
  }
  ask(client, {{"op", "release"}}, 3);
}

void print_text(const std::string& api, const Clearing& clearing) {
  if (!clearing.is_needed()) {
    std::printf("%s: nothing to clear\n", api.c_str());
    return;
  }
  if (!clearing.stop.is_null()) {
    const std::string reason = clearing.stop.value("reason", "");
    std::printf("%s: cleared: emergency stop by %s%s\n", api.c_str(), clearing.stop.value("by", "").c_str(),
                (reason.empty() ? "" : ": " + reason).c_str());
  }
  for (const event::FaultGroup& group : event::fault_groups(clearing.faults))
    std::printf("%s: %s: fault %s\n", api.c_str(), clearing.good ? "cleared" : "not cleared", group.title().c_str());
  if (!clearing.said.empty()) std::printf("%s: %s\n", api.c_str(), clearing.said.c_str());
}

}  // namespace

int clear_command(const ClientOptions& options) {
  const std::string api = only_system(options.api);
  Clearing clearing;
  std::string problem;  // that kept it from its end
  try {
    api::ApiClient client = api::ApiClient::connect(api, kConnectTimeout_s);
    clear(client, clearing);
  } catch (const std::exception& error) {
    clearing.good = false;
    clearing.said = problem = error.what();
  }
  if (options.json) {
    std::puts(Json{{"api", api},
                   {"cleared", clearing.good && clearing.is_needed()},
                   {"stop", clearing.stop},
                   {"faults", clearing.faults},
                   {"said", clearing.said}}
                  .dump()
                  .c_str());
  } else if (problem.empty()) {
    print_text(api, clearing);
  }
  if (!clearing.good) std::fprintf(stderr, "liana: %s: %s\n", api.c_str(), clearing.said.c_str());
  return clearing.good ? launcher::kExitOk : launcher::kExitFailure;
}

}  // namespace liana::cli
