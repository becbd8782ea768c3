// The client end of the API socket (docs/reference/api.md): JSON packets out and in.
#pragma once

#include <optional>
#include <string>

#include "host/base/json/json_fwd.hpp"
#include "host/base/net/socket.hpp"

namespace liana::api {

class ApiClient {
 public:
  // Connects to lianad at `path`, trying for up to `timeout_s` (it may still be starting); throws std::runtime_error.
  static ApiClient connect(const std::string& path, double timeout_s = 5.0);

  // Sends one request; waits while the daemon is busy, at most 10 s. Throws std::runtime_error when the peer is gone.
  void send(const Json& request);

  // Next message, or nothing within `timeout_s`. Throws std::runtime_error when the peer is gone.
  std::optional<Json> receive(double timeout_s);

  // Next packet as bytes (subscribers of `tick` get binary packets); false when nothing came within `timeout_s`.
  bool receive_bytes(std::string& packet, double timeout_s);

  // For poll(); readable when receive(0) has something or the peer is gone.
  int fd() const { return fd_.get(); }

 private:
  explicit ApiClient(UniqueFd fd) : fd_(std::move(fd)) {}
  UniqueFd fd_;
  double limit_s_ = 0.0;  // of a wait for a packet
};

}  // namespace liana::api
