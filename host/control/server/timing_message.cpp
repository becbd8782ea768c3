#include "host/control/server/timing_message.hpp"

#include "host/base/json/json.hpp"

namespace liana::server {

namespace {

Json times_json(const realtime::LatencyCounts& counts) {
  Json buckets = Json::array();
  for (std::size_t i = 0; i < counts.count.size(); ++i) {
    if (counts.count[i] > 0) buckets.push_back({i, counts.count[i]});
  }
  return {{"median", counts.percentile_us(0.5)},
          {"p99", counts.percentile_us(0.99)},
          {"worst", counts.worst_us},
          {"buckets", buckets}};
}

}  // namespace

Json timing_message(const realtime::LatencyCounts& wakeup, const realtime::LatencyCounts& tick,
                    const realtime::Overruns& overruns) {
  return {{"ticks", tick.total()},
          {"wakeup_us", times_json(wakeup)},
          {"tick_us", times_json(tick)},
          {"overruns", overruns.total()},
          {"overrun_causes",
           {{"late_wake", overruns.late_wake},
            {"long_tick", overruns.long_tick},
            {"bus_wait", overruns.bus_wait},
            {"lost_ticks", overruns.lost_ticks}}}};
}

}  // namespace liana::server
