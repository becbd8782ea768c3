// The VR handles of one client as a device at lianad (docs/reference/device-protocol.md): the page says what they do as
// JSON.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "host/api/device/driver.hpp"
#include "host/apps/gateway/poller.hpp"
#include "host/base/json/json.hpp"

namespace liana::gateway {

class Handles {
 public:
  // `devices`: lianad's socket for them; `client`: name of the client, of which the device's name is made. `refused` is
  // told why lianad let the device go. `poller` must outlive this.
  Handles(Poller& poller, std::string devices, const std::string& client,
          std::function<void(const std::string& why)> refused);
  ~Handles() { leave(); }
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;

  // Makes the device known to lianad unless it is. Throws RequestError (away).
  void connect();
  // The handles are put away.
  void leave();
  // Samples of a message `device` (docs/reference/console-protocol.md); throws RequestError (bad_request, out_of_range,
  // away).
  void take(const Json& message);

 private:
  void ready();

  Poller& poller_;
  std::string devices_, name_;
  std::function<void(const std::string& why)> refused_;
  std::optional<device::Driver> driver_;
};

}  // namespace liana::gateway
