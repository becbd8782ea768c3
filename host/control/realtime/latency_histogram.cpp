#include "host/control/realtime/latency_histogram.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace liana::realtime {

std::uint64_t LatencyCounts::total() const { return std::accumulate(count.begin(), count.end(), std::uint64_t{0}); }

std::uint32_t LatencyCounts::percentile_us(double share) const {
  const double rank = std::ceil(share * static_cast<double>(total()));
  std::uint64_t seen = 0;
  for (std::size_t i = 0; i < kLatencyBuckets; ++i) {
    seen += count[i];
    if (seen > 0 && static_cast<double>(seen) >= rank) return static_cast<std::uint32_t>(i);
  }
  return worst_us;
}

LatencyCounts LatencyHistogram::counts() const {
  LatencyCounts counts;
  for (std::size_t i = 0; i < count_.size(); ++i) {
    counts.count[i] = count_[i].load(std::memory_order_relaxed) - before_[i];
    if (counts.count[i] > 0) counts.worst_us = static_cast<std::uint32_t>(i);
  }
  if (counts.count[kLatencyBuckets] > 0)
    counts.worst_us = std::max(counts.worst_us, worst_us_.load(std::memory_order_relaxed));
  return counts;
}

// Within the buckets the highest one that is not empty tells the worst; only the worst beyond them has to be forgotten
// here. A time that the writer is recording right now may be lost from that worst (not from the counts): it belongs to
// before the reset.
void LatencyHistogram::reset() {
  for (std::size_t i = 0; i < count_.size(); ++i) before_[i] = count_[i].load(std::memory_order_relaxed);
  worst_us_.store(0, std::memory_order_relaxed);
}

}  // namespace liana::realtime
