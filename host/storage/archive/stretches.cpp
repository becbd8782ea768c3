#include "host/storage/archive/stretches.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "host/api/telemetry/record.hpp"
#include "host/base/json/json.hpp"

namespace liana::archive {
namespace {

constexpr double kStretch_s = 60.0;

}  // namespace

Stretches::Stretches(const Reader& reader, Span span) : reader_(reader), span_(span) {
  const auto recorded = reader.recorded();
  if (!recorded) throw std::runtime_error(reader.folder() + ": the archive holds no telemetry");
  if (recorded->first > span.last || recorded->last < span.first) {
    char has[80];
    const double period_s = reader.life().period_s;
    std::snprintf(has, sizeof has, "it has %.3f to %.3f s", static_cast<double>(recorded->first) * period_s,
                  static_cast<double>(recorded->last) * period_s);
    throw std::runtime_error(reader.folder() + ": the archive holds no telemetry of this time; " + has);
  }
  span_ = {std::max(span.first, recorded->first), std::min(span.last, recorded->last)};
}

std::uint64_t Stretches::visit(const std::function<void(const std::string&, const Json&)>& take) const {
  const std::uint64_t ticks = reader_.span_of(0.0, kStretch_s).last;
  const Json none = Json::object();
  std::uint64_t count = 0;
  for (std::uint64_t first = span_.first; first <= span_.last; first += ticks) {
    const Span stretch{first, std::min(first + ticks - 1, span_.last)};
    const std::vector<Facts> facts = reader_.facts(stretch);
    std::size_t next = 0;
    for (const std::string& record : reader_.telemetry(stretch)) {
      const auto tick = static_cast<std::uint64_t>(telemetry::header_of(record).tick);
      while (next < facts.size() && facts[next].tick <= tick) ++next;
      take(record, next == 0 ? none : facts[next - 1].state);
      ++count;
    }
  }
  return count;
}

}  // namespace liana::archive
