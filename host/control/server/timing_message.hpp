// The answer to a `timing` request (docs/reference/api.md).
#pragma once

#include "host/base/json/json_fwd.hpp"
#include "host/control/realtime/latency_histogram.hpp"
#include "host/control/realtime/link.hpp"

namespace liana::server {

// `overruns`: those of the same time as the counts. At most 64 KiB as text up to 9 999 999 ticks in every bucket.
Json timing_message(const realtime::LatencyCounts& wakeup, const realtime::LatencyCounts& tick,
                    const realtime::Overruns& overruns);

}  // namespace liana::server
