#include "host/haptic/link.hpp"

#include "host/haptic/range.hpp"

namespace liana::haptic {

void check(const LinkTable& table) {
  check_range("link", "delay_s", table.delay_s, 0.0, 5.0);
  check_range("link", "jitter", table.jitter, 0.0, 1.0);
  check_range("link", "loss", table.loss, 0.0, 1.0);
}

}  // namespace liana::haptic
