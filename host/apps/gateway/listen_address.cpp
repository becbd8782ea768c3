#include "host/apps/gateway/listen_address.hpp"

#include <arpa/inet.h>

#include <array>
#include <charconv>
#include <stdexcept>

namespace liana::gateway {
namespace {

bool is_address(int family, const std::string& host) {
  std::array<unsigned char, sizeof(in6_addr)> binary{};
  return inet_pton(family, host.c_str(), binary.data()) == 1;
}

}  // namespace

bool ListenAddress::is_loopback() const { return host == "::1" || host.starts_with("127."); }

std::string ListenAddress::web_host() const { return host.find(':') == std::string::npos ? host : "[" + host + "]"; }

ListenAddress parse_listen_address(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  const std::string digits = colon == std::string::npos ? "" : text.substr(colon + 1);
  ListenAddress address{text.substr(0, colon == std::string::npos ? 0 : colon), 0};
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), address.port);
  if (address.host == "localhost") address.host = "127.0.0.1";
  const bool in_brackets = address.host.starts_with('[') && address.host.ends_with(']');
  if (in_brackets) address.host = address.host.substr(1, address.host.size() - 2);
  const bool known = is_address(in_brackets ? AF_INET6 : AF_INET, address.host);
  if (known && !digits.empty() && error == std::errc() && end == digits.data() + digits.size()) return address;
  throw std::runtime_error("--listen " + text +
                           ": allowed ADDR:PORT with an IPv4 address, an IPv6 address in brackets or localhost, and a "
                           "port from 0 (a free one) to 65535, e.g. 127.0.0.1:8765");
}

}  // namespace liana::gateway
