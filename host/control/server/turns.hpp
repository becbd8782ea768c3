// How the service and the real-time side of lianad take turns, until the arm is stopped and the drives are off.
#pragma once

#include <functional>

#include "host/control/server/service.hpp"

namespace liana::server {

// The real-time side, whatever the arm.
struct Ticks {
  std::function<bool()> run_tick;  // false when the other side of the bus has left
  // After the service has failed (host/control/realtime/last_stop.hpp).
  std::function<void(const std::function<bool()>& next)> stop_without_service;
};

// A signal asks for the end.
using Signalled = std::function<bool()>;

// Fast and paced time: one thread, so that runs repeat bit for bit. False when the bus has ended. When the service
// fails the arm is stopped, then this throws std::runtime_error.
bool run_lockstep(Service& service, const Ticks& ticks, const Signalled& signalled);

// Real time: two threads, each of which ends the motion when the other one fails; then as run_lockstep.
bool run_real(Service& service, const Ticks& ticks, const Signalled& signalled);

}  // namespace liana::server
