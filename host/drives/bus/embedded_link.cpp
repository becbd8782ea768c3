#include "host/drives/bus/embedded_link.hpp"

#include <sys/socket.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "host/base/net/address.hpp"

namespace liana::bus {
namespace {

api::UniqueFd connect_to(const std::string& path) {
  const sockaddr_un address = api::unix_address(path);
  api::UniqueFd fd(socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0));
  if (fd.get() < 0 || connect(fd.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    throw std::runtime_error("bus socket " + path + ": " + std::strerror(errno) + "; start liana-bus with --socket " +
                             path + " first");
  }
  return fd;
}

wire::Welcome greet(int descriptor, const std::string& path) {
  wire::Hello hello;
  std::strncpy(hello.name.data(), program_invocation_short_name, hello.name.size() - 1);
  std::array<char, 4096> packet{};
  ssize_t size = -1;
  if (send(descriptor, &hello, sizeof hello, MSG_NOSIGNAL) == static_cast<ssize_t>(sizeof hello)) {
    do {
      size = recv(descriptor, packet.data(), packet.size(), 0);
    } while (size < 0 && errno == EINTR);
  }
  if (size > 0 && packet[0] == static_cast<char>(wire::Type::kError)) {
    throw std::runtime_error("bus socket " + path +
                             ": refused: " + std::string(packet.data() + 1, static_cast<std::size_t>(size - 1)));
  }
  wire::Welcome welcome;
  const auto bytes = static_cast<std::size_t>(size < 0 ? 0 : size);
  if (bytes >= 8 && bytes <= sizeof welcome) std::memcpy(&welcome, packet.data(), bytes);
  if (bytes < 8 || welcome.type != wire::Type::kWelcome || welcome.bus_count > wire::kMaxBuses ||
      bytes != welcome.size()) {
    throw std::runtime_error("bus socket " + path +
                             ": closed or answered with something else than WELCOME; is it liana-bus of this version?");
  }
  return welcome;
}

std::string describe(const wire::Welcome& welcome) {
  std::string text = std::to_string(welcome.period_us) + " us";
  for (std::size_t b = 0; b < welcome.bus_count; ++b) {
    const std::string name(welcome.bus[b].name.data(), strnlen(welcome.bus[b].name.data(), welcome.bus[b].name.size()));
    text += ", " + name + " at " + std::to_string(welcome.bus[b].bitrate);
  }
  return text;
}

wire::Welcome expected_welcome(const config::BusesConfig& config) {
  wire::Welcome expected;
  expected.period_us = static_cast<std::uint32_t>(config.period_us());
  expected.bus_count = static_cast<std::uint8_t>(config.buses.size());
  for (std::size_t b = 0; b < config.buses.size(); ++b) {
    expected.bus[b].bitrate = static_cast<std::uint32_t>(config.buses[b].bitrate);
    std::strncpy(expected.bus[b].name.data(), config.buses[b].name.c_str(), expected.bus[b].name.size() - 1);
  }
  return expected;
}

}  // namespace

EmbeddedLink::EmbeddedLink(const std::string& path, const config::BusesConfig& config)
    : EmbeddedLink(connect_to(path), path, config) {}

EmbeddedLink::EmbeddedLink(api::UniqueFd socket, const std::string& path, const config::BusesConfig& config)
    : socket_(std::move(socket)), welcome_(greet(socket_.get(), path)) {
  const std::string runs = describe(welcome_);
  const std::string expected = describe(expected_welcome(config));
  if (runs != expected) {
    throw std::runtime_error("bus socket " + path + ": liana-bus runs " + runs + "; table " + config.name + " says " +
                             expected + "; give both the same table");
  }
}

bool EmbeddedLink::send(const wire::Yield& yield, bool block) noexcept {
  const int flags = MSG_NOSIGNAL | (block ? 0 : MSG_DONTWAIT);
  while (::send(socket_.get(), &yield, yield.size(), flags) < 0) {
    if (errno != EINTR) return false;
  }
  return true;
}

EmbeddedLink::Received EmbeddedLink::receive(wire::Wake& wake, bool block) noexcept {
  for (;;) {
    const ssize_t size = recv(socket_.get(), &wake, sizeof wake, block ? 0 : MSG_DONTWAIT);
    if (size < 0 && errno == EINTR) continue;
    if (size < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return Received::kNothing;
    const bool whole = size >= static_cast<ssize_t>(wire::kHeaderBytes) && wake.type == wire::Type::kWake &&
                       wake.frame_count <= wire::kMaxPacketFrames && static_cast<std::size_t>(size) == wake.size();
    return whole ? Received::kWake : Received::kEnded;
  }
}

}  // namespace liana::bus
