#include "host/apps/ground/gaps.hpp"

#include <algorithm>
#include <utility>

namespace liana::ground {

std::uint64_t time_of(const Telemetry& telemetry) {
  if (telemetry.primary.has_secondary) return telemetry.time_us;
  constexpr std::size_t kPlace = 1;  // behind the exponent
  if (telemetry.data.size() < kPlace + kTimeBytes) return 0;
  return read_time(std::string_view(telemetry.data).substr(kPlace));
}

void Gaps::begin(std::uint16_t apid, std::uint16_t count, std::uint64_t time_us) { newest_[apid] = {count, time_us}; }

// The times of packets never go back, so an earlier one was overtaken or comes again.
void Gaps::take(std::uint16_t apid, std::uint16_t count, std::uint64_t time_us, double now_s) {
  const auto newest = newest_.find(apid);
  if (newest == newest_.end()) return begin(apid, count, time_us);
  if (fill(apid, count, time_us) || time_us < newest->second.time_us) return;
  const Newest before = std::exchange(newest->second, {count, time_us});
  Gap gap{apid, {}, {before.time_us, time_us}, now_s + kGrace_s};
  for (unsigned each = before.count + 1u; each % kCountModulus != count; ++each)
    gap.missing.insert(static_cast<std::uint16_t>(each % kCountModulus));
  if (before.count == count || gap.missing.empty()) return;
  found_ += gap.missing.size();
  if (gaps_.size() < kMaxGaps) {
    gaps_.push_back(std::move(gap));
  } else {
    lost_ += gap.missing.size();
  }
}

bool Gaps::fill(std::uint16_t apid, std::uint16_t count, std::uint64_t time_us) {
  const auto gap = std::find_if(gaps_.begin(), gaps_.end(), [&](const Gap& each) {
    return each.apid == apid && time_us >= each.span.from_us && time_us <= each.span.to_us &&
           each.missing.contains(count);
  });
  if (gap == gaps_.end()) return false;
  gap->missing.erase(count);
  ++filled_;
  if (gap->missing.empty()) gaps_.erase(gap);
  return true;
}

std::optional<Gaps::Span> Gaps::ask(double now_s) {
  std::erase_if(gaps_, [&](const Gap& each) {
    if (each.tries < kMaxTries || now_s < each.next_s) return false;
    lost_ += each.missing.size();
    return true;
  });
  const auto due = std::find_if(gaps_.begin(), gaps_.end(), [&](const Gap& each) { return now_s >= each.next_s; });
  if (due == gaps_.end()) return std::nullopt;
  // One question for all gaps that overlap it: an outage cuts every APID.
  const Span span = due->span;
  for (Gap& each : gaps_) {
    if (each.span.from_us < span.from_us || each.span.to_us > span.to_us) continue;
    each.next_s = now_s + kAgain_s;
    ++each.tries;
  }
  return span;
}

}  // namespace liana::ground
