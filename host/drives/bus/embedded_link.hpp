// The controller's end of the liana-bus socket (docs/reference/bus-protocol.md).
#pragma once

#include <string>

#include "host/base/net/socket.hpp"
#include "host/drives/bus/bus_protocol.hpp"
#include "host/model/config/config.hpp"

namespace liana::bus {

class EmbeddedLink {
 public:
  // Connects to `path` and exchanges HELLO and WELCOME, as liana-bus answers at once. Throws std::runtime_error when
  // nobody listens there, the bus refuses, or it runs other buses than `config`.
  EmbeddedLink(const std::string& path, const config::BusesConfig& config);
  // The same over a socket that is connected already; `path` is how messages call it.
  EmbeddedLink(api::UniqueFd socket, const std::string& path, const config::BusesConfig& config);

  int descriptor() const noexcept { return socket_.get(); }
  const wire::Welcome& welcome() const noexcept { return welcome_; }
  // False when the bus has gone (or, with `block` false, when its socket is full).
  bool send(const wire::Yield& yield, bool block) noexcept;
  enum class Received { kWake, kNothing, kEnded };
  // Waits for a WAKE, or only looks when `block` is false.
  Received receive(wire::Wake& wake, bool block) noexcept;

 private:
  api::UniqueFd socket_;
  wire::Welcome welcome_;
};

}  // namespace liana::bus
