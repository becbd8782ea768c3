#include "host/drives/bus/drive_bus.hpp"

#include <algorithm>

#include "firmware_like/drive/pdo.hpp"

namespace liana::bus {

SendResult DriveBus::write_sync() noexcept {
  CanFrame sync;
  sync.id = kSyncCobId;
  SendResult worst = SendResult::kOk;
  for (int bus = 0; bus < bus_count(); ++bus) worst = std::max(worst, send(bus, sync));
  return worst;
}

double DriveBus::measured_load(int bus, std::int32_t bitrate) const noexcept {
  const std::uint64_t elapsed_us = now_us();
  if (elapsed_us == 0 || bitrate <= 0) return 0.0;
  return 1e6 * static_cast<double>(stats(bus).bits) / (static_cast<double>(bitrate) * static_cast<double>(elapsed_us));
}

}  // namespace liana::bus
