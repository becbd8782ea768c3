// The two devices at which the recorded and the simulated person sit, connected to lianad as any others are.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/api/device/driver.hpp"

namespace liana::simulated {

// As a pair of handles is tracked: positions to 1 um.
device::Capability recorded_handles();
// A hand controller without force, its room that of an Omega.6.
device::Capability simulated_controller();

class OwnDevices {
 public:
  // Connects both; throws std::runtime_error.
  OwnDevices(const std::string& path, double timeout_s);

  // Samples of handles, or of the hand controller, as their encoders resolve them. Throws std::runtime_error when
  // lianad does not take them.
  void send(device::Kind kind, const std::vector<device::Sample>& samples);
  // Takes what lianad tells, at `now_us`; throws std::runtime_error when it has refused one of them.
  void receive(std::int64_t now_us);
  // Tells lianad that both leave.
  void leave();
  // What lianad told the hand controller last; nothing before the first, or when that is too old to be felt.
  const liana_state* controller_state(std::int64_t now_us) const { return controller_.state(now_us); }

 private:
  device::Driver handles_, controller_;
};

}  // namespace liana::simulated
