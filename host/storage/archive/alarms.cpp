#include "host/storage/archive/alarms.hpp"

#include <utility>

#include "host/base/text/printable.hpp"

namespace liana::archive {
namespace {

constexpr std::size_t kMaxText = 256;  // as lianad takes it

}  // namespace

void Alarms::add(const std::string& text, std::uint64_t count) {
  // It may name a file: what is no UTF-8, or becomes none where it is cut, would be no request.
  std::string shown = text::printable(text, text::Lines::kOne);
  shown.resize(text::whole_characters(shown, kMaxText).size());
  const std::lock_guard lock(mutex_);
  if (waiting_.size() < kMost) {
    waiting_.push_back({std::move(shown), count});
  } else {
    waiting_.back().count += count;
  }
}

std::optional<Json> Alarms::take() {
  const std::lock_guard lock(mutex_);
  if (waiting_.empty()) return std::nullopt;
  const Alarm alarm = waiting_.front();
  waiting_.pop_front();
  return Json{{"op", "archive_alarm"}, {"text", alarm.text}, {"count", alarm.count}};
}

}  // namespace liana::archive
