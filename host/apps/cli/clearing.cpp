#include "host/apps/cli/clearing.hpp"

#include <chrono>
#include <stdexcept>
#include <vector>

#include "host/apps/cli/commands.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/observer.hpp"
#include "host/base/event/event_json.hpp"

namespace liana::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kVerdictTimeout_s = 15.0;  // the drives get their reset first

bool is_refused(const Json& answer) { return answer.value("op", "") == "error"; }

// Lianad's ok or error; throws std::runtime_error when none comes within 5 s.
Json answer_to(api::ApiClient& client, Json request, int id) {
  request["id"] = id;
  client.send(request);
  const auto deadline = Clock::now() + std::chrono::duration<double>(kAnswerTimeout_s);
  for (auto now = Clock::now(); now < deadline; now = Clock::now()) {
    const auto message = client.receive(std::chrono::duration<double>(deadline - now).count());
    if (message && (message->value("op", "") == "ok" || is_refused(*message))) return *message;
  }
  throw std::runtime_error("lianad did not answer " + request.value("op", "") +
                           " within 5 s: see docs/how-to/nothing-answers.md");
}

}  // namespace

std::string only_system(const std::string& command, const std::string& given) {
  const std::vector<std::string> systems = launcher::systems_to_ask(given);
  if (systems.size() == 1) return systems.front();
  std::string names;
  for (const std::string& system : systems) names += (names.empty() ? "" : ", ") + system;
  throw launcher::BadInput(command + ": several systems run: " + names +
                           "; name the one you have looked at with --api");
}

Json next_state(api::ApiClient& client) {
  auto state = launcher::wait_for(client, "state", kAnswerTimeout_s);
  if (!state) throw std::runtime_error("lianad runs but sent no state within 5 s: see docs/how-to/nothing-answers.md");
  return *state;
}

void ask(api::ApiClient& client, Json request, int id) {
  const Json answer = answer_to(client, std::move(request), id);
  if (is_refused(answer)) throw std::runtime_error("lianad: " + answer.value("message", answer.dump()));
}

std::string take_motion(api::ApiClient& client, const Json& state, int id) {
  const std::string owner = state.value("owner", "");
  Json request{{"op", "acquire"}};
  if (!owner.empty()) request["from"] = owner;
  const Json answer = answer_to(client, std::move(request), id);
  if (is_refused(answer))
    throw std::runtime_error("lianad: " + answer.value("message", answer.dump()) +
                             (answer.value("code", "") == "not_owner"
                                  ? "; press c where motion is owned, or give it back there, then ask again"
                                  : ""));
  return owner;
}

event::Event clear_verdict(api::ApiClient& client) {
  const auto deadline = Clock::now() + std::chrono::duration<double>(kVerdictTimeout_s);
  while (Clock::now() < deadline) {
    const auto message = launcher::wait_for(client, "event", kAnswerTimeout_s);
    if (message && message->value("kind", "") == event::event_kind_name(event::EventKind::kClear))
      return event::event_from_json(*message);
  }
  throw std::runtime_error("lianad did not say within 15 s whether the faults are cleared; look with liana status");
}

}  // namespace liana::cli
