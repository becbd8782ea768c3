// What happened when in a payload's installation: steps of the mission, what lianad told, what the bench's truth shows.
#pragma once

#include "host/apps/report/payload_figures.hpp"
#include "host/base/json/json_fwd.hpp"

namespace liana::report {

// Contacts less than this apart are one event.
constexpr double kContactApart_s = 1.0;

// {"event","time_s"} in the order of time, from `begin_tick` on. `steps` as steps_with_ticks gives them; `faults`: of
// the bench's summary. Events: docs/reference/command-line.md, "A payload's installation".
Json timeline_of(const PayloadSources& sources, const Json& steps, const Json& faults, std::uint64_t begin_tick);

}  // namespace liana::report
