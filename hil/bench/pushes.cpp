#include "hil/bench/pushes.hpp"

#include <algorithm>
#include <stdexcept>

namespace liana::bench {

std::vector<Push> pushes_at(std::uint32_t slot, const FaultInjector& injector, std::size_t links) {
  std::vector<Push> pushes;
  for (std::size_t i = 0; i < injector.faults().size(); ++i) {
    const FaultConfig& fault = injector.faults()[i];
    const FaultInjector::Course& course = injector.courses()[i];
    if (fault.kind != FaultKind::kPush || !course.begun) continue;
    const FaultParameters& with = fault.parameters;
    const double grown = std::min(1.0, (slot - *course.begun + 1) / with.slots);
    const double fallen = course.ended ? std::min(1.0, (slot - *course.ended + 1) / with.slots) : 0.0;
    if (grown <= fallen) continue;
    const auto link = static_cast<std::size_t>(with.link);
    pushes.push_back({link == 0 ? links : link - 1, (grown - fallen) * Vec3{with.x_N, with.y_N, with.z_N}});
  }
  return pushes;
}

void check_pushes(const std::vector<FaultConfig>& faults, std::size_t links, const std::string& arm) {
  for (const FaultConfig& fault : faults) {
    if (fault.kind != FaultKind::kPush) continue;
    if (arm == "light")
      throw std::runtime_error("--faults: push: the light arm has no body; allowed with --arm full only");
    if (fault.parameters.link > static_cast<double>(links))
      throw std::runtime_error("--faults: push: link is " + std::to_string(static_cast<int>(fault.parameters.link)) +
                               "; allowed are 1 to " + std::to_string(links) + ", and 0 for the tip");
  }
}

}  // namespace liana::bench
