#include "host/control/realtime/last_stop.hpp"

#include <exception>

#include "firmware_like/cable_controller.hpp"
#include "firmware_like/serial_controller.hpp"

namespace liana::realtime {

namespace {

bool is_off(const CycleOutputs& outputs) {
  return outputs.state == OperatingState::kDisabled || outputs.state == OperatingState::kFault;
}

}  // namespace

void run_guarded(const std::function<void()>& body, ThreadResult& end) noexcept {
  try {
    body();
  } catch (const std::exception& error) {
    end.problem = error.what();
  } catch (...) {
    end.problem = "an exception without a text";
  }
  end.over = true;
}

template <class Arm>
void stop_without_service(ArmMailbox<Arm>& link, std::uint64_t limit_ticks, const std::function<bool()>& next) {
  constexpr std::uint64_t kUntilTaken = 2;  // ticks: one may have begun before the stop was pressed
  link.stop.press();
  link.report.refresh();
  const std::uint64_t first = link.report.value().next_tick;
  for (std::uint64_t done = 0; done < limit_ticks && next(); done = link.report.value().next_tick - first) {
    link.report.refresh();
    if (link.report.value().next_tick - first >= kUntilTaken && is_off(link.report.value().outputs)) return;
  }
}

template void stop_without_service(ArmMailbox<cable::CableArm>&, std::uint64_t, const std::function<bool()>&);
template void stop_without_service(ArmMailbox<serial::SerialArm>&, std::uint64_t, const std::function<bool()>&);

}  // namespace liana::realtime
