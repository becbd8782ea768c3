// What lianad is told by liana-bus: its answer to HELLO, and the packets after it.
#include <sys/socket.h>

#include <array>

#include "host/drives/bus/embedded_link.hpp"
#include "tests/fuzz/fuzz.hpp"

using namespace liana;

namespace {

config::BusesConfig one_bus() {
  config::BusesConfig buses;
  buses.rate_hz = 250.0;
  buses.buses.resize(1);
  buses.buses[0].name = "can0";
  return buses;
}

// What is sent to `socket` as one packet: up to a length that comes first.
void send_packet(int socket, std::string_view& rest) {
  const std::size_t size = std::min<std::size_t>(fuzz::choice(rest) * 4u, rest.size());
  if (size > 0 && ::send(socket, rest.data(), size, MSG_DONTWAIT) < 0) std::abort();
  rest.remove_prefix(size);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const config::BusesConfig kBuses = one_bus();
  std::array<int, 2> both{};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET, 0, both.data()) != 0) std::abort();
  const api::UniqueFd bus(both[0]);
  api::UniqueFd ours(both[1]);
  std::string_view rest = fuzz::text_of(data, size);
  for (int packets = 0; packets < 8 && !rest.empty(); ++packets) send_packet(bus.get(), rest);
  ::shutdown(bus.get(), SHUT_WR);  // who waits for more than there is sees the end
  return fuzz::refusing([&] {
    static wire::Wake wake;
    bus::EmbeddedLink link(std::move(ours), "fuzz", kBuses);
    while (link.receive(wake, true) == bus::EmbeddedLink::Received::kWake) {
      for (std::size_t i = 0; i < wake.frame_count; ++i) wire::to_can_frame(wake.frame[i]);
    }
  });
}
