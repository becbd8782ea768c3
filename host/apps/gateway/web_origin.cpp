#include "host/apps/gateway/web_origin.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace liana::gateway {
namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

bool is_loopback_host(const std::string& host, std::uint16_t port) {
  const std::array<std::string, 3> names{"127.0.0.1", "localhost", "[::1]"};
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    const std::string with_port = name + ":" + std::to_string(port);
    return lower(host) == with_port || (port == 80 && lower(host) == name);
  });
}

bool is_own_origin(const std::string& origin, const std::string& scheme, const std::string& host) {
  return origin.empty() || lower(origin) == scheme + "://" + lower(host);
}

}  // namespace liana::gateway
