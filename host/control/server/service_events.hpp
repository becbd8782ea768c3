// Events (docs/reference/formats.md) from what the service sees. Subjects are named as people name them:
// "drive 4 (node 4, segment 2)", "bus can0".
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "firmware_like/safety/faults.hpp"
#include "firmware_like/safety/supervisor.hpp"
#include "host/base/event/event.hpp"
#include "host/control/arbiter/path_events.hpp"
#include "host/control/arbiter/retract_events.hpp"
#include "host/control/realtime/boot_problem.hpp"
#include "host/control/server/arm_server.hpp"
#include "host/control/server/emergency_stop.hpp"
#include "host/control/server/owner.hpp"
#include "host/control/verification/verdict.hpp"
#include "host/model/config/config.hpp"
#include "host/model/config/drive_names.hpp"

namespace liana::server {

// Drive or bus of a fault; empty where it has neither.
std::string place_of(const Fault& fault, const config::BusesConfig& buses, const config::DriveNames& names);

event::Event booted_event();
event::Event unwatched_event(const std::string& what);
event::Event boot_goes_on_event();
// One for each drive that did not boot, and one for all of them.
std::vector<event::Event> boot_failed_events(const std::vector<realtime::BootProblem>& problems,
                                             const config::DriveNames& names);
event::Event homed_event();
event::Event not_homed_event(const std::string& why);
// What keeps an arm from being enabled: cables, or drives that are not yet in Operation enabled; empty: nothing.
std::string why_enabling_waits(const ArmServer& desk, const config::DriveNames& names);
// Drives that keep a clear, with the reason: "; drive 7 (node 7, segment 3): no feedback"; empty: none.
std::string drives_that_keep(const ArmServer& desk, const config::DriveNames& names);
event::Event clear_event(const ClearResult& clear, const std::string& keeps);
// `drive`: 0-based.
event::Event emergency_event(std::size_t drive, std::uint16_t code, const config::DriveNames& names);
// A command that verification refused.
event::Event verdict_event(std::uint64_t command, const verification::Verdict& verdict);
// A path that begins, has come to an end or is refused.
event::Event path_event(const arbiter::PathEvents& news);
// What has become of the way back.
event::Event way_event(const arbiter::RetractEvents& news);
// A request that is answered with this error.
// Of what a client asked for, in words that say what; and of the request `op`, with why.
event::Event refusal_event(const std::string& client, const std::string& code, const std::string& text);
event::Event refusal_event(const std::string& client, const std::string& op, const std::string& code,
                           const std::string& why);
event::Event owner_event(event::OwnerEvent what, const std::string& client);
// Motion was taken from an owner; `why` it could be.
event::Event taken_event(const Claimant& from, const Claimant& by, const std::string& why);
// An owner that streamed tip goals sent none for this long, its own time to live.
event::Event stands_still_event(const std::string& client, double ttl_s);
event::Event stop_event(const StopOrder& order);
// `waits`: what it waits for; empty: it begins, or goes on. `after`: the condition that ended the step before, or
// empty.
event::Event step_event(int index, const std::string& name, const std::string& waits = "",
                        const std::string& after = "");
event::Event last_step_event(const std::string& after);

// Which faults of the core are new.
class FaultMonitor {
 public:
  // Events of what `now` has and the list of the last call had not.
  std::vector<event::Event> changes(const FaultList& now, const config::BusesConfig& buses,
                                    const config::DriveNames& names);

 private:
  FaultList seen_;
};

}  // namespace liana::server
