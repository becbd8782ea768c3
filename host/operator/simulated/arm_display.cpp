#include "host/operator/simulated/arm_display.hpp"

#include <stdexcept>

#include "firmware_like/cable/arm/kinematics.hpp"
#include "firmware_like/math/trig.hpp"

namespace liana::simulated {
namespace {

std::size_t links_before(const cable::RobotParams& table, std::size_t node) {
  std::size_t links = 0;
  for (std::size_t m = 0; m < node; ++m) links += static_cast<std::size_t>(table.segment[m].modules);
  return links;
}

void check(std::size_t given, std::size_t node, const cable::RobotParams& table) {
  const auto angles = static_cast<std::size_t>(table.theta_count());
  if (given != angles)
    throw std::runtime_error("state message: measured_js_deg: " + std::to_string(given) + " angles: allowed " +
                             std::to_string(angles) + ", as many as the robot has; give both of one robot");
  if (node < 1 || node > static_cast<std::size_t>(table.segment_count))
    throw std::runtime_error("node " + std::to_string(node) + ": allowed 1 to " + std::to_string(table.segment_count) +
                             "; name the end of a segment");
}

}  // namespace

ArmObservation ArmDisplay::picture(const std::vector<double>& measured_deg, std::size_t node) const {
  check(measured_deg.size(), node, table_);
  cable::ThetaVector theta_rad{};
  for (std::size_t i = 0; i < measured_deg.size(); ++i) theta_rad[i] = measured_deg[i] * kDegree;
  const cable::LinkPoints links = cable::link_points(table_, theta_rad);
  const auto axis = links.axis();
  return {cable::tip_pose(table_, cable::arm_trig(table_, theta_rad)),
          {axis.begin(), axis.end()},
          links_before(table_, node),
          radius_m_};
}

}  // namespace liana::simulated
