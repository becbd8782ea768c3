#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "host/api/client.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/errors.hpp"
#include "host/cli/observer.hpp"

namespace liana {
namespace {

using nlohmann::json;

constexpr double kAnswerTimeout_s = 5.0;

void print_state(const json& state) {
  std::printf("%s, t = %.2f s, owner %s\n", state.value("state", "?").c_str(), state.value("time_s", 0.0),
              state.value("owner", "nobody").c_str());
  for (const json& fault : state.value("faults", json::array())) {
    std::printf("fault %d %s (index %d)\n", fault.value("number", 0), fault.value("name", "").c_str(), fault.value("index", -1));
  }
  std::printf("theta (deg):");
  for (const json& angle : state.value("measured_js_deg", json::array())) std::printf(" %.3f", angle.get<double>());
  std::printf("\n");
}

}  // namespace

int status_command(const ClientOptions& options) {
  ApiClient client = ApiClient::connect(api_path(options.api), 1.0);
  hello_as_observer(client, true);
  const auto state = wait_for(client, "state", kAnswerTimeout_s);
  if (!state) throw std::runtime_error("lianad runs but sent no state within 5 s");
  if (options.json) {
    std::puts(state->dump().c_str());
  } else {
    print_state(*state);
  }
  return kExitOk;
}

int estop_command(const ClientOptions& options) {
  ApiClient client = ApiClient::connect(api_path(options.api), 1.0);
  hello_as_observer(client, false);
  client.send({{"op", "stop"}, {"id", 1}, {"reason", "liana estop"}});
  if (!wait_for(client, "ok", kAnswerTimeout_s)) throw std::runtime_error("lianad did not confirm the stop within 5 s; cut the power");
  std::puts(options.json ? R"({"stopped":true})" : "stop: brakes, then disabled");
  return kExitOk;
}

}  // namespace liana
