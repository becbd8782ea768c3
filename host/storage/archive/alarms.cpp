#include "host/storage/archive/alarms.hpp"

namespace liana::archive {
namespace {

constexpr std::size_t kMaxText = 256;  // as lianad takes it

}  // namespace

void Alarms::add(const std::string& text, std::uint64_t count) {
  const std::lock_guard lock(mutex_);
  if (waiting_.size() < kMost) {
    waiting_.push_back({text.substr(0, kMaxText), count});
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
