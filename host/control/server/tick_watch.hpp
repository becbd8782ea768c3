// The longest tick between two looks at the real-time thread's counts.
#pragma once

#include <cstdint>
#include <optional>

#include "host/control/realtime/latency_histogram.hpp"

namespace liana::server {

class TickWatch {
 public:
  // Of what was counted since the last look [us], rounded down; kLatencyBuckets for all that took so long or longer.
  // Nothing where no tick was counted. Counts that went back were reset meanwhile.
  std::optional<std::uint32_t> longest_us(const realtime::LatencyCounts& now);

 private:
  realtime::LatencyCounts seen_;
};

}  // namespace liana::server
