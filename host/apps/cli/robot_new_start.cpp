#include "host/apps/cli/robot_new_start.hpp"

#include <algorithm>
#include <numbers>

namespace liana::cli {
namespace {

constexpr double kShareOfLimit = 0.5;
constexpr double kSegmentBend_deg = 60.0, kArmBend_deg = 300.0;  // in the plane between the axes
// Turn of a segment over the tip's way in arm lengths, where a segment bends by kSegmentBend_deg: at most 6.6 for 3
// segments of 2 to 16 joints, 3.3 for more. It grows as the bend gets smaller.
constexpr double kTurnOverWay = 10.0;

}  // namespace

double start_bend_deg(const StartOf& arm) {
  const double segment_deg = std::min(kSegmentBend_deg, kArmBend_deg / arm.segments);
  return std::min(kShareOfLimit * arm.theta_limit_deg, segment_deg / (std::numbers::sqrt2 * arm.modules));
}

double tip_way_m_deg(const StartOf& arm, double arm_m) {
  const double bend_deg = std::numbers::sqrt2 * arm.modules * start_bend_deg(arm);
  const double turn_rad = arm.modules * std::numbers::pi / 180.0;  // of a segment, where its joints turn by a degree
  return turn_rad * arm_m / kTurnOverWay * bend_deg / kSegmentBend_deg;
}

}  // namespace liana::cli
