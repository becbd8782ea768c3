#include "host/control/last_stop.hpp"

#include <exception>

namespace liana {

namespace {

bool is_off(const CycleReport& report) {
  return report.outputs.state == OperatingState::kDisabled || report.outputs.state == OperatingState::kFault;
}

}  // namespace

void run_guarded(const std::function<void()>& body, ThreadEnd& end) noexcept {
  try {
    body();
  } catch (const std::exception& error) {
    end.problem = error.what();
  } catch (...) {
    end.problem = "an exception without a text";
  }
  end.over = true;
}

void stop_without_service(Link& link, std::uint64_t limit_ticks, const std::function<bool()>& next) {
  constexpr std::uint64_t kUntilTaken = 2;  // ticks: one may have begun before the stop was pressed
  link.stop.press();
  link.report.refresh();
  const std::uint64_t first = link.report.value().next_tick;
  for (std::uint64_t done = 0; done < limit_ticks && next(); done = link.report.value().next_tick - first) {
    link.report.refresh();
    if (link.report.value().next_tick - first >= kUntilTaken && is_off(link.report.value())) return;
  }
}

}  // namespace liana
