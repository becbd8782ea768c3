#include "host/apps/launcher/observer.hpp"

#include <chrono>
#include <filesystem>
#include <stdexcept>

#include "host/api/server/client.hpp"
#include "host/api/server/registry.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/process.hpp"
#include "host/base/json/json.hpp"

namespace liana::launcher {

std::vector<std::string> systems_to_ask(const std::string& given) {
  if (!given.empty()) {
    std::error_code error;
    const auto kind = std::filesystem::status(given, error).type();
    if (kind == std::filesystem::file_type::not_found || error)
      throw BadInput("--api: '" + given + "': no such socket; is lianad running there?");
    if (kind != std::filesystem::file_type::socket)
      throw BadInput("--api: '" + given + "': is no socket; give the API socket of a lianad");
    return {given};
  }
  std::vector<std::string> systems = api::running_systems();
  if (systems.empty()) {
    throw BadInput("no system of this user is running (looked in " + api::registry_folder() +
                   "); start one with liana run, or name its socket with --api");
  }
  return systems;
}

std::optional<Json> wait_for(api::ApiClient& client, const std::string& op, double timeout_s) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(timeout_s);
  while (std::chrono::steady_clock::now() < deadline) {
    const auto left = std::chrono::duration<double>(deadline - std::chrono::steady_clock::now()).count();
    const unsigned ends = child_ends();
    auto message = client.receive(left);
    if (!message && child_ends() != ends) continue;  // a program of our own has ended, and nothing else
    if (!message) return std::nullopt;
    if (message->value("op", "") == op) return message;
    if (message->value("op", "") == "error")
      throw std::runtime_error("lianad: " + message->value("message", message->dump()));
  }
  return std::nullopt;
}

Json hello(const std::string& name, Observer observer) {
  Json subscriptions = Json::array();
  if (observer != Observer::kBlind) subscriptions.push_back("state");
  if (observer == Observer::kClient) subscriptions.push_back("event");
  const bool may_own = observer == Observer::kClient || observer == Observer::kOwning;
  const char* role = may_own ? "client" : "observer";
  return {{"op", "hello"}, {"name", name}, {"role", role}, {"lockstep", false}, {"subscribe", subscriptions}};
}

void say_hello(api::ApiClient& client, const std::string& name, Observer observer) {
  client.send(hello(name, observer));
}

Json hello_as_observer(api::ApiClient& client, const std::string& name) {
  say_hello(client, name, Observer::kSeeing);
  const auto welcome = wait_for(client, "welcome", 5.0);
  if (!welcome)
    throw std::runtime_error("lianad does not answer on its API socket: see docs/how-to/nothing-answers.md");
  return *welcome;
}

}  // namespace liana::launcher
