// Where the links of the arm are, from a record of telemetry.
#pragma once

#include <string>
#include <vector>

#include "firmware_like/cable/arm/robot_params.hpp"
#include "firmware_like/math/pose.hpp"
#include "host/api/telemetry/layout.hpp"
#include "host/storage/archive/rows.hpp"

namespace liana::archive {

class ArmPoints {
 public:
  // Throws std::runtime_error when the life's tables cannot be used.
  ArmPoints(const Life& life, const telemetry::Layout& layout);

  // Base, then the end of every link, in the base frame. Of a cable arm from the measured angles, of a serial one from
  // its nodes. Empty while they are not known.
  std::vector<Vec3> of(const std::string& record) const;
  double radius_m() const { return radius_m_; }
  double slide_m_rad() const { return table_.segment[0].slide_m_rad; }  // of a base that feeds; else 0

 private:
  const telemetry::Place* place(const char* field) const;

  const telemetry::Layout& layout_;
  cable::RobotParams table_{};  // of a cable arm, else without segments
  double radius_m_ = 0.03;
};

}  // namespace liana::archive
