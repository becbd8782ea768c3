// A door and drivers at it, without a daemon: time is what the test says.
#pragma once

#include <unistd.h>

#include <string>

#include "host/api/device/device_server.hpp"
#include "host/api/device/driver.hpp"

namespace liana::device {

inline Capability hand_controller(const std::string& name) {
  Capability out;
  out.name = name;
  out.hand[0] = {LIANA_ALL_AXES, LIANA_X | LIANA_Y | LIANA_Z, 1, 0, {-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}, 12.0, 0.0};
  return out;
}

// `name` keeps the sockets of tests that run at once apart.
inline DeviceEndpoint place_of_test(const std::string& name) {
  return {"/tmp/liana_door_" + name + "_" + std::to_string(::getpid()), {}};
}

inline liana_welcome limits_of_test() {
  auto out = make<liana_welcome>(LIANA_WELCOME);
  out.interval_s = 0.02;
  out.tip_speed_m_s = 0.1;
  return out;
}

inline liana_state state_of_test() {
  auto out = make<liana_state>(LIANA_STATE);
  out.watchdog_s = 0.1;
  return out;
}

}  // namespace liana::device
