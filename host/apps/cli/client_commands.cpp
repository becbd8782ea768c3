#include <algorithm>
#include <cstdio>
#include <optional>
#include <stdexcept>

#include "host/api/server/client.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/cli/udp_feed.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/interrupt.hpp"
#include "host/apps/launcher/observer.hpp"
#include "host/base/json/json.hpp"
#include "host/operator/terminal/state_text.hpp"

namespace liana::cli {
namespace {

constexpr double kLook_s = 0.2;  // between looks for Ctrl-C

// One running system while a command deals with it.
struct Talk {
  std::string api;
  std::optional<api::ApiClient> client;
  std::string problem;  // empty: none so far
};

// Does `action` with a system, unless something went wrong with it before; what goes wrong is kept, so that others get
// their turn.
template <typename Action>
void attempt(Talk& talk, const Action& action) {
  if (!talk.problem.empty()) return;
  try {
    action();
  } catch (const std::exception& error) {
    talk.problem = error.what();
  }
}

// Greets every system before anything is waited for: one that hangs must not keep a stop from the others.
template <typename Action>
std::vector<Talk> begin_talks(const ClientOptions& options, const char* name, launcher::Observer observer,
                              const Action& action) {
  std::vector<Talk> talks;
  for (const std::string& api : launcher::systems_to_ask(options.api)) {
    Talk& talk = talks.emplace_back();
    talk.api = api;
    attempt(talk, [&] {
      talk.client.emplace(api::ApiClient::connect(api, kConnectTimeout_s));
      launcher::say_hello(*talk.client, name, observer);
      action(*talk.client);
    });
  }
  return talks;
}

// The answer whose `op` is given; what is missing without one is the problem's text.
Json answer_of(Talk& talk, const char* op, const char* missing) {
  Json answer;
  attempt(talk, [&] {
    auto message = launcher::wait_for(*talk.client, op, kAnswerTimeout_s);
    if (!message) throw std::runtime_error(missing);
    answer = std::move(*message);
  });
  return answer;
}

int exit_code_of(const std::vector<Talk>& talks) {
  for (const Talk& talk : talks) {
    if (!talk.problem.empty()) std::fprintf(stderr, "liana: %s: %s\n", talk.api.c_str(), talk.problem.c_str());
  }
  return std::all_of(talks.begin(), talks.end(), [](const Talk& talk) { return talk.problem.empty(); })
             ? launcher::kExitOk
             : launcher::kExitFailure;
}

// Every state as it comes; lianad waits for none of them.
int send_states(const StatusOptions& options) {
  UdpFeed feed(options.udp);
  const std::vector<std::string> systems = launcher::systems_to_ask(options.client.api);
  if (systems.size() > 1) throw launcher::BadInput("--udp: more than one system runs: name one with --api");
  api::ApiClient client = api::ApiClient::connect(systems.front(), kConnectTimeout_s);
  launcher::hello_as_observer(client, "liana status");
  const launcher::InterruptGuard interrupts;
  std::string end = "interrupted";
  while (interrupts.count() == 0) {
    std::optional<Json> message;
    try {
      message = client.receive(kLook_s);
    } catch (const std::runtime_error& error) {
      end = error.what();
      break;
    }
    if (message && message->value("op", "") == "state") feed.send(*message);
  }
  if (options.client.json) {
    std::puts(Json{{"sent", feed.sent()}, {"unheard", feed.unheard()}, {"end", end}}.dump().c_str());
  } else {
    std::printf("%llu states sent to %s, %llu of them to nobody; %s\n", static_cast<unsigned long long>(feed.sent()),
                options.udp.c_str(), static_cast<unsigned long long>(feed.unheard()), end.c_str());
  }
  return feed.sent() > 0 ? launcher::kExitOk : launcher::kExitFailure;
}

}  // namespace

int status_command(const StatusOptions& given) {
  const ClientOptions& options = given.client;
  if (!given.udp.empty()) return send_states(given);
  std::vector<Talk> talks = begin_talks(options, "liana status", launcher::Observer::kSeeing, [](api::ApiClient&) {});
  for (Talk& talk : talks) {
    Json state =
        answer_of(talk, "state", "lianad runs but sent no state within 5 s: see docs/how-to/nothing-answers.md");
    if (!talk.problem.empty()) continue;
    if (options.json) {
      state["api"] = talk.api;
      std::puts(state.dump().c_str());
    } else {
      std::printf("%s: %s", talk.api.c_str(), terminal::state_text(state).c_str());
    }
  }
  return exit_code_of(talks);
}

}  // namespace liana::cli
