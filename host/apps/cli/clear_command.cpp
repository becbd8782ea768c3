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

// What a clear is for, as it was before and as lianad judged it.
struct Clearing {
  Json stop;               // as in the state; null: no emergency stop was in force
  Json faults;             // as in the state
  int whole = 0;           // cable that was called whole, and taken so
  std::string taken_from;  // who owned motion; empty: nobody did
  std::string said;        // of the faults; empty when there were none
  bool good = true;
  bool is_needed() const { return !stop.is_null() || !faults.empty(); }
};

// An arm that is still on its way to standing still is left alone.
void require_settled(const Clearing& before, const Json& state) {
  const std::string name = state.value("state", "");
  const bool settled = name == "DISABLED" || name == "FAULT" || (before.stop.is_null() && name == "ENABLED");
  if (!settled)
    throw std::runtime_error("nothing was cleared: the arm is " + name +
                             "; wait until liana status says DISABLED or FAULT");
}

void clear(api::ApiClient& client, const ClearOptions& options, Clearing& clearing) {
  launcher::say_hello(client, "liana clear", launcher::Observer::kClient);
  const Json state = next_state(client);
  clearing.stop = state.value("stop", Json());
  clearing.faults = state.value("faults", Json::array());
  if (!clearing.is_needed() && options.whole == 0) return;
  require_settled(clearing, state);
  clearing.taken_from = take_motion(client, state, 1);
  Json request{{"op", "state_command"}, {"command", "clear"}};
  if (options.whole != 0) request["whole"] = options.whole;
  ask(client, request, 2);
  clearing.whole = options.whole;
  if (!clearing.faults.empty()) {
    const event::Event result = clear_verdict(client);
    clearing.said = result.text;
    clearing.good = result.number == 0;
  }
  ask(client, {{"op", "release"}}, 3);
}

void print_text(const std::string& api, const Clearing& clearing) {
  if (!clearing.is_needed()) {
    const std::string whole = "cable " + std::to_string(clearing.whole) + " counts as whole again";
    std::printf("%s: %s\n", api.c_str(), clearing.whole == 0 ? "nothing to clear" : whole.c_str());
    return;
  }
  if (!clearing.stop.is_null())
    std::printf("%s: cleared: emergency stop by %s\n", api.c_str(), terminal::stopped_by(clearing.stop).c_str());
  for (const event::FaultGroup& group : event::fault_groups(clearing.faults))
    std::printf("%s: %s: fault %s\n", api.c_str(), clearing.good ? "cleared" : "not cleared", group.alarm().c_str());
  if (!clearing.said.empty()) std::printf("%s: %s\n", api.c_str(), clearing.said.c_str());
}

}  // namespace

int clear_command(const ClearOptions& options) {
  const std::string api = only_system("clear", options.api);
  Clearing clearing;
  std::string problem;  // that kept it from its end
  try {
    api::ApiClient client = api::ApiClient::connect(api, kConnectTimeout_s);
    clear(client, options, clearing);
  } catch (const std::exception& error) {
    clearing.good = false;
    clearing.said = problem = error.what();
  }
  if (!options.json && !clearing.taken_from.empty())
    std::printf("%s: motion was taken from '%s' and is given back\n", api.c_str(), clearing.taken_from.c_str());
  if (options.json) {
    std::puts(Json{{"api", api},
                   {"cleared", clearing.good && clearing.is_needed()},
                   {"stop", clearing.stop},
                   {"faults", clearing.faults},
                   {"taken_from", clearing.taken_from},
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
