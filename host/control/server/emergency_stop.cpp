#include "host/control/server/emergency_stop.hpp"

#include "host/base/json/json.hpp"
#include "host/base/text/printable.hpp"

namespace liana::server {

std::string printable(std::string_view text) {
  return std::string(text::whole_characters(text::printable(text, text::Lines::kOne, ' '), kMaxReasonBytes));
}

std::string stop_reason(const Json* reason) {
  if (reason == nullptr || reason->is_null()) return "";
  return printable(reason->is_string() ? reason->text() : reason->dump(-1, Json::BadUtf8::kReplace));
}

std::string text_of(const StopOrder& order) {
  return "emergency stop by " + order.by + (order.reason.empty() ? "" : ": " + order.reason);
}

}  // namespace liana::server
