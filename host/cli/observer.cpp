#include "host/cli/observer.hpp"

#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "host/api/client.hpp"
#include "host/cli/errors.hpp"

namespace liana {

using nlohmann::json;

std::string current_api_link() {
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  const std::string directory = runtime != nullptr && *runtime != '\0' ? runtime : "/tmp";
  return directory + "/liana-" + std::to_string(getuid()) + ".api";
}

std::string api_path(const std::string& given) {
  if (!given.empty()) {
    if (!std::filesystem::exists(given)) throw BadInput("--api: '" + given + "': no such socket; is lianad running there?");
    return given;
  }
  std::error_code error;
  const std::filesystem::path target = std::filesystem::read_symlink(current_api_link(), error);
  if (error || !std::filesystem::exists(target))
    throw BadInput("no system is running; start one with liana run, or name its socket with --api");
  return target.string();
}

std::optional<json> wait_for(ApiClient& client, const std::string& op, double timeout_s) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(timeout_s);
  while (std::chrono::steady_clock::now() < deadline) {
    const auto left = std::chrono::duration<double>(deadline - std::chrono::steady_clock::now()).count();
    auto message = client.receive(left);
    if (!message) return std::nullopt;
    if (message->value("op", "") == op) return message;
    if (message->value("op", "") == "error") throw std::runtime_error("lianad: " + message->value("message", message->dump()));
  }
  return std::nullopt;
}

json hello_as_observer(ApiClient& client, bool subscribe_state) {
  const json subscriptions = subscribe_state ? json::array({"state"}) : json::array();
  client.send({{"op", "hello"}, {"name", "liana"}, {"role", "observer"}, {"lockstep", false}, {"subscribe", subscriptions}});
  const auto welcome = wait_for(client, "welcome", 5.0);
  if (!welcome) throw std::runtime_error("lianad does not answer on its API socket");
  return *welcome;
}

}  // namespace liana
