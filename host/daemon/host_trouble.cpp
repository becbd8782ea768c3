#include "host/daemon/host_trouble.hpp"

namespace liana {
namespace {

const char* advice(BusState state) {
  switch (state) {
    case BusState::kActive:
      return "";
    case BusState::kErrorPassive:
      return ": frames are destroyed or nobody acknowledges them; check cable, termination and bit rate";
    case BusState::kBusOff:
      return ": the interface has given up after too many errors; mend the cable, then restart it (ip link set NAME "
             "type can restart)";
    case BusState::kDown:
      return ": set it up again (ip link set NAME up)";
  }
  return "";
}

std::string number(std::uint64_t value) { return std::to_string(value); }

}  // namespace

const char* bus_state_name(BusState state) {
  constexpr const char* kNames[] = {"active", "error_passive", "bus_off", "down"};
  return kNames[static_cast<std::size_t>(state)];
}

void HostTrouble::look_at(const std::string& name, const DriveBusStats& now, Seen& seen,
                          std::vector<std::string>& out) const {
  const std::string bus = "bus " + name;
  if (now.state != seen.stats.state) out.push_back(bus + " is " + bus_state_name(now.state) + advice(now.state));
  if (now.state == seen.stats.state && now.errors != seen.stats.errors)
    out.push_back(bus + " reported " + number(now.errors - seen.stats.errors) + " error frames and is " +
                  bus_state_name(now.state));
  if (now.dropped != seen.stats.dropped)
    out.push_back(bus + ": " + number(now.dropped - seen.stats.dropped) + " received frames lost");
  const bool refuses = now.refused > seen.stats.refused;
  if (refuses && !seen.refuses) {
    seen.refused_before = seen.stats.refused;
    out.push_back(bus + " refuses frames: its transmit queue is full");
  }
  if (!refuses && seen.refuses)
    out.push_back(bus + " takes frames again; " + number(now.refused - seen.refused_before) + " were refused");
  seen.refuses = refuses;
  seen.stats = now;
}

std::vector<std::string> HostTrouble::changes(const BusesConfig& buses, const CycleReport& report) {
  std::vector<std::string> out;
  for (std::size_t b = 0; b < buses.buses.size(); ++b) look_at(buses.buses[b].name, report.bus[b], seen_[b], out);
  const std::uint64_t lost = report.overruns.lost_ticks;
  if (lost != lost_ticks_) out.push_back(number(lost - lost_ticks_) + " control deadlines were lost");
  lost_ticks_ = lost;
  return out;
}

}  // namespace liana
