#include "hil/arm/linkage.hpp"

#include "hil/math/random.hpp"

namespace liana::bench {

namespace {

// The segment's angle is the mean of its joints, so what the draws have in common is taken off again.
void centre(Linkage& linkage, std::size_t first, double BendShare::*axis) {
  double sum = 0.0;
  for (std::size_t i = first; i < linkage.size(); ++i) sum += linkage[i].*axis - 1.0;
  for (std::size_t i = first; i < linkage.size(); ++i)
    linkage[i].*axis -= sum / static_cast<double>(linkage.size() - first);
}

}  // namespace

Linkage uneven_linkage(const RobotConfig& robot, double max_share, std::uint64_t seed) {
  Linkage linkage;
  if (max_share == 0.0) return linkage;
  Random random(seed, "linkage");
  for (const SegmentConfig& segment : robot.segments) {
    const std::size_t first = linkage.size();
    for (int i = 0; i < segment.modules; ++i) {
      const double pitch = 1.0 + random.uniform(-max_share, max_share);
      linkage.push_back({pitch, 1.0 + random.uniform(-max_share, max_share)});
    }
    centre(linkage, first, &BendShare::pitch);
    centre(linkage, first, &BendShare::yaw);
  }
  return linkage;
}

}  // namespace liana::bench
