#include "host/control/server/tick_watch.hpp"

#include <algorithm>

namespace liana::server {

std::optional<std::uint32_t> TickWatch::longest_us(const realtime::LatencyCounts& now) {
  const bool is_reset = !std::ranges::equal(now.count, seen_.count, std::ranges::greater_equal{});
  if (is_reset) seen_ = {};
  std::optional<std::uint32_t> longest_us;
  for (std::size_t i = 0; i < now.count.size(); ++i) {
    if (now.count[i] != seen_.count[i]) longest_us = static_cast<std::uint32_t>(i);
  }
  seen_ = now;
  return longest_us;
}

}  // namespace liana::server
