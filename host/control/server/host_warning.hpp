// What interfaces and clock report beside the faults: no trouble of the host comes or goes without an event.
#pragma once

#include <string>
#include <vector>

#include "host/base/event/event.hpp"
#include "host/control/realtime/link.hpp"

namespace liana::server {

// "active", "error_passive", "bus_off" or "down", as the API names the state of a bus.
const char* bus_state_name(bus::BusState state);

// Compares each report with the one before.
class HostWarning {
 public:
  // What has changed since the last call: state of an interface, error frames, frames it refuses, frames lost in the
  // receive buffer, lost control deadlines.
  std::vector<event::Event> changes(const config::BusesConfig& buses, const realtime::TickStatus& report);

 private:
  struct Seen {
    bus::DriveBusStats stats;
    std::uint64_t refused_before = 0;  // when it began to refuse
    bool refuses = false;
  };
  void look_at(const std::string& name, const bus::DriveBusStats& now, Seen& seen,
               std::vector<event::Event>& out) const;

  std::array<Seen, bus::kMaxDriveBuses> seen_{};
  std::uint64_t lost_ticks_ = 0;
};

}  // namespace liana::server
