// liana-gateway as a child process: the console's address while it lives.
#pragma once

#include <memory>
#include <string>

#include "host/system/process.hpp"

namespace liana::system {

// What liana-gateway is told (docs/console-protocol.md).
struct GatewayOptions {
  std::string listen;                        // ADDR:PORT; empty: 127.0.0.1:8765, where that is taken a free port
  std::string token_file, certificate, key;  // empty: none
};

class GatewayProcess {
 public:
  // Starts it for the lianad that listens at `api`, or will; what it says goes to `log_file`. Waits until it listens.
  // Throws BadInput with what it does not accept, std::runtime_error when it does not come up within 10 s.
  GatewayProcess(std::string api, GatewayOptions options, std::string log_file);

  // Where browsers find it, e.g. http://127.0.0.1:8765/.
  const std::string& address() const { return address_; }
  // Starts it again at the same address when it has ended; how it ended, or empty. Throws as the constructor.
  std::string revive();

 private:
  void start(const std::string& listen);

  std::string api_, log_file_, address_;
  GatewayOptions options_;
  std::unique_ptr<ChildProcess> child_;
};

}  // namespace liana::system
