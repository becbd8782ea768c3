// Addresses of IP networks, and sockets there.
#pragma once

#include <cstdint>
#include <string>

#include "host/base/net/socket.hpp"

namespace liana::api {

struct InternetAddress {
  std::string host;        // IPv4 or IPv6, without brackets
  std::uint16_t port = 0;  // 0: a free one, where something listens
  bool is_loopback() const;
  // As in an address of the web: 127.0.0.1, [::1].
  std::string web_host() const;
  std::string text() const { return web_host() + ":" + std::to_string(port); }
};

// ADDR:PORT, with ADDR an IPv4 address, an IPv6 address in brackets, or localhost. Throws std::runtime_error that names
// the option.
InternetAddress parse_internet_address(const std::string& option, const std::string& text);

enum class Transport : std::uint8_t { kTcp, kUdp };

// A socket that never waits: bound to the address, and listening where it is TCP. Throws std::runtime_error.
UniqueFd bind_at(Transport transport, const InternetAddress& address);
// A socket that never waits, connected to the address; of TCP perhaps not yet. Without a descriptor where it cannot be
// (errno).
UniqueFd connect_at(Transport transport, const InternetAddress& address);
// Where a socket is bound: its port, where a free one was wanted.
std::uint16_t port_of(int fd);

}  // namespace liana::api
