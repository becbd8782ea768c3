#include "host/apps/cli/udp_feed.hpp"

#include <netdb.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <stdexcept>

#include "host/apps/cli/arguments.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/base/json/json.hpp"

namespace liana::cli {
namespace {

[[noreturn]] void refuse(const std::string& address, const std::string& why) {
  throw launcher::BadInput("--udp: '" + address + "': " + why + ": allowed HOST:PORT, like 127.0.0.1:9870: name one");
}

// Nobody hears it now; another state may be heard.
bool is_of_the_network(int reason) {
  return reason == ECONNREFUSED || reason == ENETUNREACH || reason == ENETDOWN || reason == EHOSTUNREACH ||
         reason == EHOSTDOWN || reason == ENOBUFS;
}

}  // namespace

UdpFeed::UdpFeed(const std::string& address) : address_(address) {
  const std::size_t colon = address.rfind(':');
  if (colon == std::string::npos || colon == 0) refuse(address, "has no host and port");
  std::string host = address.substr(0, colon);
  if (host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  const auto port = std::to_string(parse_whole("--udp: port", address.substr(colon + 1), 1, 65535));
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_DGRAM;
  addrinfo* list = nullptr;
  if (const int code = ::getaddrinfo(host.c_str(), port.c_str(), &wanted, &list); code != 0)
    refuse(address, ::gai_strerror(code));
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> found(list, ::freeaddrinfo);
  fd_ = api::UniqueFd(::socket(found->ai_family, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (fd_.get() < 0 || ::connect(fd_.get(), found->ai_addr, found->ai_addrlen) != 0)
    refuse(address, std::strerror(errno));
}

void UdpFeed::send(const Json& state) {
  Json told = state;
  told["timestamp"] = state.value("time_s", 0.0);
  const std::string text = told.dump(-1, Json::BadUtf8::kReplace);
  const bool is_unheard = ::send(fd_.get(), text.data(), text.size(), 0) < 0;
  if (is_unheard && !is_of_the_network(errno))
    throw std::runtime_error("--udp: " + address_ + ": a state of " + std::to_string(text.size()) +
                             " bytes cannot be sent: " + std::strerror(errno));
  ++sent_;
  if (is_unheard) ++unheard_;
}

}  // namespace liana::cli
