#include "host/control/server/host_warning.hpp"

namespace liana::server {
namespace {

const char* advice(bus::BusState state) {
  switch (state) {
    case bus::BusState::kActive:
      return "";
    case bus::BusState::kErrorPassive:
      return ": frames are destroyed or nobody acknowledges them; check cable, termination and bit rate";
    case bus::BusState::kBusOff:
      return ": the interface has given up after too many errors; mend the cable, then restart it (ip link set NAME "
             "type can restart)";
    case bus::BusState::kDown:
      return ": set it up again (ip link set NAME up)";
  }
  return "";
}

std::string number(std::uint64_t value) { return std::to_string(value); }

event::Event trouble(event::HostTroubleEvent what, const std::string& subject, const event::EventValue& value,
                     const std::string& text) {
  return {.kind = event::EventKind::kHostWarning,
          .number = event::number_of(what),
          .subject = subject,
          .values = {value},
          .text = text};
}

}  // namespace

const char* bus_state_name(bus::BusState state) {
  constexpr const char* kNames[] = {"active", "error_passive", "bus_off", "down"};
  return kNames[static_cast<std::size_t>(state)];
}

void HostWarning::look_at(const std::string& name, const bus::DriveBusStats& now, Seen& seen,
                          std::vector<event::Event>& out) const {
  const std::string bus = "bus " + name;
  const auto say = [&](event::HostTroubleEvent what, std::uint64_t count, const std::string& text) {
    out.push_back(trouble(what, bus, {"count", static_cast<double>(count)}, bus + text));
  };
  const std::string state = bus_state_name(now.state);
  if (now.state != seen.stats.state) {
    out.push_back(trouble(event::HostTroubleEvent::kBusState, bus, {"state", static_cast<double>(now.state)},
                          bus + " is " + state + advice(now.state)));
  }
  const std::uint64_t errors = now.errors - seen.stats.errors, dropped = now.dropped - seen.stats.dropped;
  if (now.state == seen.stats.state && errors != 0)
    say(event::HostTroubleEvent::kErrorFrames, errors, " reported " + number(errors) + " error frames and is " + state);
  if (dropped != 0)
    say(event::HostTroubleEvent::kFramesLost, dropped, ": " + number(dropped) + " received frames lost");
  const std::uint64_t refused = now.refused - seen.stats.refused;
  if (refused > 0 && !seen.refuses) {
    seen.refused_before = seen.stats.refused;
    say(event::HostTroubleEvent::kFramesRefused, refused, " refuses frames: its transmit queue is full");
  }
  const std::uint64_t in_all = now.refused - seen.refused_before;
  if (refused == 0 && seen.refuses)
    say(event::HostTroubleEvent::kFramesTaken, in_all, " takes frames again; " + number(in_all) + " were refused");
  seen.refuses = refused > 0;
  seen.stats = now;
}

std::vector<event::Event> HostWarning::changes(const config::BusesConfig& buses, const realtime::TickStatus& report) {
  std::vector<event::Event> out;
  for (std::size_t b = 0; b < buses.buses.size(); ++b) look_at(buses.buses[b].name, report.bus[b], seen_[b], out);
  const std::uint64_t lost = report.overruns.lost_ticks - lost_ticks_;
  if (lost != 0) {
    out.push_back(trouble(event::HostTroubleEvent::kTicksLost, "control thread", {"count", static_cast<double>(lost)},
                          number(lost) + " control deadlines were lost"));
  }
  lost_ticks_ = report.overruns.lost_ticks;
  return out;
}

}  // namespace liana::server
