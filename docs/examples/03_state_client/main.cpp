// state_client SOCKET: prints what lianad says of its arm, once (docs/reference/api.md).
#include <cstdio>
#include <exception>

#include "host/api/server/client.hpp"
#include "host/base/json/json.hpp"

namespace {

constexpr double kPatience_s = 10.0;

int print_state(const char* socket) {
  liana::api::ApiClient client = liana::api::ApiClient::connect(socket);
  client.send({{"op", "hello"}, {"name", "state_client"}, {"role", "observer"}, {"subscribe", {"state"}}});
  while (const auto message = client.receive(kPatience_s)) {
    if (message->value("op", "") == "error") {
      std::fprintf(stderr, "state_client: %s\n", message->value("message", "").c_str());
      return 1;
    }
    if (message->value("op", "") != "state") continue;
    std::printf("%s at %.3f s, angles in degrees:", message->value("state", "").c_str(), message->value("time_s", 0.0));
    for (const liana::Json& angle : message->at("measured_js_deg")) std::printf(" %.3f", angle.get<double>());
    std::puts("");
    return 0;
  }
  std::fprintf(stderr, "state_client: no state within %.0f s\n", kPatience_s);
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "state_client: give the API socket of a lianad: state_client SOCKET\n");
    return 2;
  }
  try {
    return print_state(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "state_client: %s\n", error.what());
    return 1;
  }
}
