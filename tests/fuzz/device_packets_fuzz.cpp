// What a driver may send to lianad: packets of any bytes at a device that has said hello, or has not.
#include <sys/socket.h>

#include <array>

#include "host/api/device/device.hpp"
#include "tests/fuzz/fuzz.hpp"

using namespace liana;

namespace {

constexpr std::int64_t kStep_us = 1000;

// The first byte is how long it is, in eighths: packets of the protocol fit.
std::string_view next_packet(std::string_view& bytes) {
  const std::size_t wanted = 8 * static_cast<std::size_t>(fuzz::choice(bytes));
  const std::string_view packet = bytes.substr(0, wanted);
  bytes.remove_prefix(packet.size());
  return packet;
}

// As the door does.
void hear(device::Device& device, std::int64_t now_us) {
  while (const auto hello = device.hear(now_us)) {
    try {
      device::check(*hello);
      device.welcome(*hello, device::make<liana_welcome>(LIANA_WELCOME));
    } catch (const std::runtime_error& refusal) {
      device.refuse(refusal.what());
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::array<int, 2> both{};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET, 0, both.data()) != 0) std::abort();
  const api::UniqueFd driver(both[0]);
  device::Device device(api::UniqueFd(both[1]), 1, 0);
  std::string_view rest = fuzz::text_of(data, size);
  std::int64_t now_us = 0;
  if (fuzz::choice(rest) % 2 == 0) {
    const device::Capability capability{.name = "fuzz", .hands = 2};
    api::send_packet(driver.get(), device::bytes_of(device::hello_of(capability, 0)));
  }
  while (!rest.empty() && device.end().empty()) {
    const std::string_view packet = next_packet(rest);
    if (!packet.empty()) api::send_packet(driver.get(), packet);
    hear(device, now_us += kStep_us);
    if (device.is_known()) device.tell(device::make<liana_state>(LIANA_STATE), now_us);
  }
  for (const device::Sample& sample : device.take_samples()) {
    if (!is_valid(sample.pose) || sample.hand >= LIANA_MAX_HANDS) std::abort();
  }
  return 0;
}
