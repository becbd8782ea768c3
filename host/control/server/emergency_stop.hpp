// The emergency stop that is in force: who asked for it, why, and since when. While it is pressed nobody enables the
// arm.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace liana {
class Json;
}  // namespace liana

namespace liana::server {

constexpr std::size_t kMaxReasonBytes = 200;  // of a stop's reason; longer ones are cut

// `text` as one line that can be shown anywhere: at most kMaxReasonBytes bytes of UTF-8, control characters as spaces,
// what is no UTF-8 as question marks.
std::string printable(std::string_view text);

// The reason of a stop, whatever was sent as one: a text as it is, null and nothing as the empty text, any other value
// as JSON; always printable.
std::string stop_reason(const Json* reason);

struct StopOrder {
  std::string by;      // name of the client, or `lianad`
  std::string reason;  // printable; may be empty
  std::uint64_t tick = 0;
};

// "emergency stop by NAME: REASON".
std::string text_of(const StopOrder& order);

class EmergencyStop {
 public:
  // The first one stays until it is released: its reason is the one that counts.
  void press(const StopOrder& order) {
    if (!order_) order_ = order;
  }
  // Asked for explicitly (acquire by a client, clear).
  void release() { order_.reset(); }
  // The stop in force, or nothing.
  const std::optional<StopOrder>& order() const { return order_; }

 private:
  std::optional<StopOrder> order_;
};

}  // namespace liana::server
