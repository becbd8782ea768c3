// Where the gateway listens.
#pragma once

#include <cstdint>
#include <string>

namespace liana::gateway {

struct ListenAddress {
  std::string host;        // IPv4 or IPv6, without brackets
  std::uint16_t port = 0;  // 0: a free one
  bool is_loopback() const;
  // As in an address of the web: 127.0.0.1, [::1].
  std::string web_host() const;
};

// ADDR:PORT, with ADDR an IPv4 address, an IPv6 address in brackets, or localhost. Throws std::runtime_error.
ListenAddress parse_listen_address(const std::string& text);

}  // namespace liana::gateway
