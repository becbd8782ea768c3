// Who is let in over HTTP, and what is shown to whom: what comes before a WebSocket.
#pragma once

#include <libwebsockets.h>

#include <cstdint>
#include <optional>
#include <string>

#include "host/apps/gateway/gateway.hpp"
#include "host/apps/gateway/strangers.hpp"
#include "host/apps/gateway/web_server.hpp"

namespace liana::gateway {

class HttpHandler {
 public:
  static constexpr const char* kProtocol = "liana-console-1";

  // Both must outlive this.
  HttpHandler(const WebOptions& options, Gateway& gateway) : options_(options), gateway_(gateway) {}

  std::uint16_t port = 0;  // at which the gateway listens
  Strangers strangers;     // connections, from their begin to their hello

  // Each returns what the callback of libwebsockets has to return: 0 goes on, others close the connection.
  // Before a connection becomes something else than HTTP/1.1: whether it may become a WebSocket.
  int admit(lws* wsi);
  // Before a request is served, and before its body is read: there must be none.
  int look_at(lws* wsi);
  // Answers a request.
  int serve(lws* wsi, const std::string& path);

 private:
  std::optional<std::string> problem(lws* wsi, const char** what) const;
  int refuse(lws* wsi, const char* what, unsigned int status, const std::string& why);

  const WebOptions& options_;
  Gateway& gateway_;
};

// The address at the other end.
std::string peer_of(lws* wsi);

}  // namespace liana::gateway
