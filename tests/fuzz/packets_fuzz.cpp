// Packets of the embedded bus: what liana-bus takes from its sides, and what lianad takes from liana-bus.
#include <sys/socket.h>

#include <array>

#include "host/drives/bus/embedded_link.hpp"
#include "host/drives/bus_simulator/participant.hpp"
#include "tests/fuzz/fuzz.hpp"

using namespace liana;

namespace {

struct Ends {
  Ends() {
    std::array<int, 2> both{};
    if (::socketpair(AF_UNIX, SOCK_SEQPACKET, 0, both.data()) != 0) std::abort();
    ours = api::UniqueFd(both[0]);
    theirs = api::UniqueFd(both[1]);
  }
  api::UniqueFd ours, theirs;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Ends ends;
  static const int kOurs = ends.ours.get();
  static bus_simulator::Participant participant(std::move(ends.theirs), wire::Hello{});
  if (size == 0 || ::send(kOurs, data, size, MSG_DONTWAIT) < 0) return 0;
  if (participant.receive(false) == bus_simulator::Participant::Received::kYield) {
    for (std::size_t i = 0; i < participant.yield().frame_count; ++i)
      wire::to_can_frame(participant.yield().frame.at(i));
  }
  return 0;
}
