// HTTP, WebSocket and TLS (libwebsockets): one loop for browsers and for lianad.
#pragma once

#include <memory>
#include <string>

#include "host/apps/gateway/gateway.hpp"
#include "host/base/net/internet_address.hpp"

namespace liana::gateway {

struct WebOptions {
  api::InternetAddress listen;
  std::string certificate, key;  // PEM files; empty: plain HTTP
  std::string page;              // file that / shows
  std::string runs;              // folder of recorded runs; empty: none are shown
  bool is_tls() const { return !certificate.empty(); }
};

struct WebServerInside;

class WebServer {
 public:
  // Listens. `gateway` must outlive this. Throws std::runtime_error.
  WebServer(const WebOptions& options, Gateway& gateway);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  // Where browsers find it: http://127.0.0.1:8765/
  std::string address() const;
  // Serves until SIGTERM or SIGINT.
  void run();
  // Serves what is there and returns at once: one turn of run().
  void serve_waiting();
  // Takes a connected stream socket as if it had come to the port; closes it. False: there is no place for it.
  bool take_connection(int fd);

 private:
  std::unique_ptr<WebServerInside> inside_;
};

}  // namespace liana::gateway
