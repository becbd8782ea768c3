#include "host/base/net/internet_address.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <stdexcept>

namespace liana::api {
namespace {

constexpr int kBacklog = 16;

bool is_address(int family, const std::string& host) {
  std::array<unsigned char, sizeof(in6_addr)> binary{};
  return inet_pton(family, host.c_str(), binary.data()) == 1;
}

struct Place {
  sockaddr_storage storage{};
  socklen_t size = 0;
  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage); }
};

Place place_of(const InternetAddress& address) {
  Place out;
  auto& four = reinterpret_cast<sockaddr_in&>(out.storage);
  auto& six = reinterpret_cast<sockaddr_in6&>(out.storage);
  if (inet_pton(AF_INET, address.host.c_str(), &four.sin_addr) == 1) {
    four.sin_family = AF_INET;
    four.sin_port = htons(address.port);
    out.size = sizeof four;
  } else {
    inet_pton(AF_INET6, address.host.c_str(), &six.sin6_addr);
    six.sin6_family = AF_INET6;
    six.sin6_port = htons(address.port);
    out.size = sizeof six;
  }
  return out;
}

// Who only listens to a connection hears nothing of another end that lost its power. What is accepted inherits it.
void find_dead_ends(int fd) {
  constexpr int kYes = 1, kQuiet_s = 30, kAgain_s = 10, kTries = 6;
  ::setsockopt(fd, SOL_SOCKET, SO_KEEPALIVE, &kYes, sizeof kYes);
  ::setsockopt(fd, IPPROTO_TCP, TCP_KEEPIDLE, &kQuiet_s, sizeof kQuiet_s);
  ::setsockopt(fd, IPPROTO_TCP, TCP_KEEPINTVL, &kAgain_s, sizeof kAgain_s);
  ::setsockopt(fd, IPPROTO_TCP, TCP_KEEPCNT, &kTries, sizeof kTries);
}

UniqueFd socket_for(Transport transport, const Place& place) {
  const int type = transport == Transport::kTcp ? SOCK_STREAM : SOCK_DGRAM;
  UniqueFd fd(::socket(place.storage.ss_family, type | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (fd.get() >= 0 && transport == Transport::kTcp) find_dead_ends(fd.get());
  return fd;
}

}  // namespace

bool InternetAddress::is_loopback() const { return host == "::1" || host.starts_with("127."); }

std::string InternetAddress::web_host() const { return host.find(':') == std::string::npos ? host : "[" + host + "]"; }

InternetAddress parse_internet_address(const std::string& option, const std::string& text) {
  const std::size_t colon = text.rfind(':');
  const std::string digits = colon == std::string::npos ? "" : text.substr(colon + 1);
  InternetAddress address{text.substr(0, colon == std::string::npos ? 0 : colon), 0};
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), address.port);
  if (address.host == "localhost") address.host = "127.0.0.1";
  const bool in_brackets = address.host.starts_with('[') && address.host.ends_with(']');
  if (in_brackets) address.host = address.host.substr(1, address.host.size() - 2);
  const bool known = is_address(in_brackets ? AF_INET6 : AF_INET, address.host);
  if (known && !digits.empty() && error == std::errc() && end == digits.data() + digits.size()) return address;
  throw std::runtime_error(option + " " + text +
                           ": allowed ADDR:PORT with an IPv4 address, an IPv6 address in brackets or localhost, and a "
                           "port from 0 (a free one) to 65535, e.g. 127.0.0.1:8765");
}

UniqueFd bind_at(Transport transport, const InternetAddress& address) {
  const Place place = place_of(address);
  UniqueFd fd = socket_for(transport, place);
  constexpr int kYes = 1;
  if (fd.get() >= 0 && transport == Transport::kTcp)
    ::setsockopt(fd.get(), SOL_SOCKET, SO_REUSEADDR, &kYes, sizeof kYes);
  const bool is_bound = fd.get() >= 0 && ::bind(fd.get(), place.get(), place.size) == 0;
  if (is_bound && (transport == Transport::kUdp || ::listen(fd.get(), kBacklog) == 0)) return fd;
  throw std::runtime_error("cannot listen at " + address.text() + ": " + std::strerror(errno) +
                           ": give another address, or end the program that has it");
}

UniqueFd connect_at(Transport transport, const InternetAddress& address) {
  const Place place = place_of(address);
  UniqueFd fd = socket_for(transport, place);
  if (fd.get() < 0) return fd;
  if (::connect(fd.get(), place.get(), place.size) != 0 && errno != EINPROGRESS) return UniqueFd();
  return fd;
}

std::uint16_t port_of(int fd) {
  sockaddr_storage storage{};
  socklen_t size = sizeof storage;
  if (::getsockname(fd, reinterpret_cast<sockaddr*>(&storage), &size) != 0) return 0;
  if (storage.ss_family == AF_INET) return ntohs(reinterpret_cast<const sockaddr_in&>(storage).sin_port);
  return ntohs(reinterpret_cast<const sockaddr_in6&>(storage).sin6_port);
}

}  // namespace liana::api
