// Events (docs/formats.md) from what the service sees. Subjects are named as people name them: "drive 3", "bus can0".
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "firmware_like/safety/faults.hpp"
#include "firmware_like/safety/supervisor.hpp"
#include "host/arbiter/path_news.hpp"
#include "host/control/boot_problem.hpp"
#include "host/daemon/emergency_stop.hpp"
#include "host/event/event.hpp"
#include "host/verify/verdict.hpp"

namespace liana {

Event booted_event();
// One for each drive that did not boot, and one for all of them.
std::vector<Event> boot_failed_events(const std::vector<BootProblem>& problems);
Event homed_event();
Event not_homed_event(const std::string& why);
Event clear_event(const ClearReport& clear);
// `drive`: 0-based.
Event emergency_event(std::size_t drive, std::uint16_t code);
// A command that verification refused.
Event verdict_event(std::uint64_t command, const Verdict& verdict);
// A path that begins, has come to an end or is refused.
Event path_event(const PathNews& news);
// A request that is answered with this error.
Event refusal_event(const std::string& client, const std::string& op, const std::string& code, const std::string& why);
Event owner_event(OwnerEvent what, const std::string& client);
// An owner that streamed tip goals sent none for this long, its own time to live.
Event stands_still_event(const std::string& client, double ttl_s);
Event stop_event(const StopOrder& order);
Event step_event(int index, const std::string& name);

// Which faults of the core are new.
class FaultWatch {
 public:
  // Events of what `now` has and the list of the last call had not.
  std::vector<Event> changes(const FaultList& now);

 private:
  FaultList seen_;
};

}  // namespace liana
