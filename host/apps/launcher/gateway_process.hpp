// liana-gateway as a child process: the console's address while it lives.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "host/apps/launcher/process.hpp"

namespace liana::launcher {

class HealthCheck;

// What liana-gateway is told (docs/reference/console-protocol.md).
struct GatewayOptions {
  std::string listen;                        // ADDR:PORT; empty: 127.0.0.1:8765, where that is taken a free port
  std::string token_file, certificate, key;  // empty: none
  std::string practice;                      // socket of the bench that takes faults; empty: none
};

// It is looked after: when it dies, or answers nothing for 15 s, it is started again at the same address, at once, and
// then ever less often as long as it does not stay. Its clients' connections to lianad end with it, so the arm holds
// meanwhile.
class GatewayProcess {
 public:
  // Starts it for the lianad that listens at `api`, or will; what it says goes to `log_file`. Waits until it listens.
  // Throws BadInput with what it does not accept, std::runtime_error when it does not come up within 10 s.
  GatewayProcess(std::string api, GatewayOptions options, std::string log_file);
  // Ends it.
  ~GatewayProcess();
  GatewayProcess(const GatewayProcess&) = delete;
  GatewayProcess& operator=(const GatewayProcess&) = delete;

  // Where browsers find it, e.g. http://127.0.0.1:8765/.
  const std::string& address() const { return address_; }

 private:
  void start(const std::string& listen);
  void wait_until_it_listens();
  void look_after();
  std::optional<std::string> look(HealthCheck& health);
  std::string place() const;
  std::string started_again();
  void pause(double seconds);

  std::string api_, log_file_, address_;
  GatewayOptions options_;
  std::unique_ptr<ChildProcess> child_;
  std::atomic<bool> over_ = false;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace liana::launcher
