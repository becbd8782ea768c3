#include <cstdio>
#include <stdexcept>

#include "host/api/server/client.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/observer.hpp"
#include "host/base/json/json.hpp"

namespace liana::cli {
namespace {

// What is confirmed is what the step asks for: where none does, nobody may believe that something was.
void check_waits(api::ApiClient& client) {
  const auto state = launcher::wait_for(client, "state", kAnswerTimeout_s);
  if (!state)
    throw std::runtime_error(
        "lianad did not say within 5 s what the mission waits for: see docs/how-to/nothing-answers.md");
  const Json& step = state->member_or_null("step");
  const std::string waits = step.is_object() && step.member_or_null("waits").is_string() ? step.at("waits").text() : "";
  if (waits.starts_with("confirm: ")) return;
  throw std::runtime_error("mission confirm: nothing waits to be confirmed" +
                           (waits.empty() ? "" : " (it waits: " + waits + ")") + "; liana status says what goes on");
}

}  // namespace

int mission_command(const MissionOptions& options) {
  const std::vector<std::string> systems = launcher::systems_to_ask(options.api);
  if (systems.size() != 1) throw launcher::BadInput("mission: several systems run: name one with --api");
  api::ApiClient client = api::ApiClient::connect(systems.front(), kConnectTimeout_s);
  launcher::say_hello(client, "liana mission", launcher::Observer::kClient);
  if (options.command == "confirm") check_waits(client);
  client.send({{"op", "mission_control"}, {"command", options.command}, {"id", 1}});
  const auto answer = launcher::wait_for(client, "ok", kAnswerTimeout_s);
  if (!answer) throw std::runtime_error("lianad did not answer within 5 s: see docs/how-to/nothing-answers.md");
  if (options.json) {
    std::puts(
        Json{{"api", systems.front()}, {"command", options.command}, {"tick", answer->at("tick")}}.dump().c_str());
  } else {
    std::printf("%s: the mission is told to %s; liana status says what it waits for\n", systems.front().c_str(),
                options.command.c_str());
  }
  return launcher::kExitOk;
}

}  // namespace liana::cli
