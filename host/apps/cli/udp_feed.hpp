// `liana status --udp`: the states of a running system as JSON datagrams, as PlotJuggler and others plot them.
#pragma once

#include <cstdint>
#include <string>

#include "host/base/json/json_fwd.hpp"
#include "host/base/net/socket.hpp"

namespace liana::cli {

// Sends datagrams to one address.
class UdpFeed {
 public:
  // `address`: HOST:PORT, of an IPv6 address [HOST]:PORT. Throws BadInput when it is no address, or names no host.
  explicit UdpFeed(const std::string& address);

  // The state with `timestamp`, its arm time in s. What nobody receives is counted, and no reason to end. Throws
  // std::runtime_error when the system cannot send it.
  void send(const Json& state);

  std::uint64_t sent() const { return sent_; }
  std::uint64_t unheard() const { return unheard_; }  // of these: the other end said that nobody is there

 private:
  api::UniqueFd fd_;
  std::string address_;
  std::uint64_t sent_ = 0, unheard_ = 0;
};

}  // namespace liana::cli
