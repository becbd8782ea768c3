#include "host/base/event/event.hpp"
#include "host/base/text/printable.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>

namespace liana::event {
namespace {

constexpr std::array<const char*, kEventKinds> kKindNames{
    "boot",    "boot_problem", "homing",    "fault",  "emergency", "clear",   "host_warning", "client",
    "owner",   "step",         "operator",  "device", "tool",      "refusal", "verdict",      "path",
    "retract", "friction",     "load_cell", "stop",   "shutdown",  "left_out"};
static_assert(static_cast<std::size_t>(EventKind::kLeftOut) + 1 == kEventKinds);

constexpr std::array<std::string_view, 9> kCodes{"",     "bad_request",  "not_owner", "not_enabled", "fault",
                                                 "busy", "out_of_range", "refused",   "no_device"};

// The shortest text that reads back as the same number.
std::string number_text(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

std::string values_text(const std::vector<EventValue>& values) {
  std::string out;
  for (const EventValue& each : values) out += (out.empty() ? "" : " ") + each.name + "=" + number_text(each.value);
  return out;
}

}  // namespace

const char* event_kind_name(EventKind kind) { return kKindNames[static_cast<std::size_t>(kind)]; }

std::optional<EventKind> event_kind_from(std::string_view name) {
  const auto found = std::find(kKindNames.begin(), kKindNames.end(), name);
  if (found == kKindNames.end()) return std::nullopt;
  return static_cast<EventKind>(found - kKindNames.begin());
}

RefusalEvent refusal_event(std::string_view code) {
  const auto found = std::find(kCodes.begin() + 1, kCodes.end(), code);
  return found == kCodes.end() ? RefusalEvent::kOther : static_cast<RefusalEvent>(found - kCodes.begin());
}

const char* const kEventLineHeading = "sequence\t  time_s\t    tick\tkind        \tnumber\tsubject\ttext\tvalues";

std::string event_line(const Event& event, double period_s) {
  std::array<char, 128> head{};
  std::snprintf(head.data(), head.size(), "%8llu\t%8.3f\t%8llu\t%-12s\t%6lld\t",
                static_cast<unsigned long long>(event.sequence), static_cast<double>(event.tick) * period_s,
                static_cast<unsigned long long>(event.tick), event_kind_name(event.kind),
                static_cast<long long>(event.number));
  return head.data() + text::printable(event.subject, text::Lines::kOne, ' ') + "\t" +
         text::printable(event.text, text::Lines::kOne, ' ') + "\t" + values_text(event.values);
}

}  // namespace liana::event
