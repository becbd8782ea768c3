// Messages of browsers to the gateway, which has no lianad here.
#include <memory>

#include "host/apps/gateway/gateway.hpp"
#include "tests/fuzz/fuzz.hpp"

using namespace liana;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static gateway::Gateway house("/nonexistent/api", "/nonexistent/devices", nullptr, true, [] { return 0.0; });
  gateway::Session& session = house.open("fuzz", [] {});
  std::string_view rest = fuzz::text_of(data, size);
  if (fuzz::choice(rest) % 2 == 0) session.take_text(R"({"op":"hello","name":"f"})", 0.0);
  for (int messages = 0; messages < 8 && !rest.empty(); ++messages) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view message = rest.substr(0, end);
    if (message.starts_with("#")) {
      session.take_binary(message.substr(1), 0.0);
    } else {
      session.take_text(message, 0.0);
    }
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  while (session.next(0.0)) {
  }
  house.gone(session);
  return 0;
}
