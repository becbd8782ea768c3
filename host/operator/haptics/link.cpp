#include "host/operator/haptics/link.hpp"

#include <sstream>
#include <stdexcept>

#include "host/operator/haptics/range.hpp"

namespace liana::haptics {
namespace {

constexpr double kMaxDelay_s = 2.0;  // the gains of people are good for

}  // namespace

void check(const LinkTable& table) {
  check_range("link", "delay_s", table.delay_s, 0.0, 5.0);
  check_range("link", "jitter", table.jitter, 0.0, 1.0);
  check_range("link", "loss", table.loss, 0.0, 1.0);
}

Delays delays_of(const std::string& text) {
  Delays delays;
  std::istringstream stream(text);
  char comma = 0, rest = 0;
  const bool numbers = stream >> delays.forward_s >> comma >> delays.back_s && comma == ',' && !(stream >> rest);
  const auto in_range = [](double delay_s) { return delay_s >= 0.0 && delay_s <= kMaxDelay_s; };
  if (numbers && in_range(delays.forward_s) && in_range(delays.back_s)) return delays;
  throw std::invalid_argument("'" + text + "': allowed FORWARD_S,RETURN_S, two numbers from 0 to 2, e.g. 0.5,0.5");
}

}  // namespace liana::haptics
