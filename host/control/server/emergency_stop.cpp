#include "host/control/server/emergency_stop.hpp"

#include "host/base/json/json.hpp"
#include "host/base/text/printable.hpp"

namespace liana::server {

std::string printable(std::string_view text) {
  std::string out = text::printable(text, text::Lines::kOne, ' ');
  std::size_t bytes = 0;
  while (bytes < out.size()) {
    const std::size_t next = bytes + text::character_bytes(std::string_view(out).substr(bytes));
    if (next > kMaxReasonBytes) break;
    bytes = next;
  }
  out.resize(bytes);
  return out;
}

std::string stop_reason(const Json* reason) {
  if (reason == nullptr || reason->is_null()) return "";
  return printable(reason->is_string() ? reason->text() : reason->dump(-1, Json::BadUtf8::kReplace));
}

std::string text_of(const StopOrder& order) {
  return "emergency stop by " + order.by + (order.reason.empty() ? "" : ": " + order.reason);
}

}  // namespace liana::server
