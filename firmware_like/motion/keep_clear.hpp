// Clearance as an aim of the shape: the arm's middle is pushed away from given points while the tip stays.
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/motion/shape_model.hpp"

namespace liana {

constexpr std::int32_t kMaxKeepClear = 4;

// A point that the arm's axis should keep its distance from: a sphere's centre, with radius + arm radius + margin.
struct KeepClear {
  Vec3 centre_m{};          // in the base frame
  double distance_m = 0.0;  // 0 = unused
  double weight = 0.0;      // against node targets; lambda of what is missing, per segment
};
using KeepClearTargets = std::array<KeepClear, kMaxKeepClear>;

// Sum over targets and segments of weight times what the segment's nearest point lacks of the distance [m].
double missing_clearance_m(const RobotTable& table, const ThetaVector& theta_rad, const ArmKinematics& arm,
                           const KeepClearTargets& targets) noexcept;

// Adds the push of every target on the nearest point of every segment. Cost: one pass over all links per target.
void add_clearance(const RobotTable& table, const ThetaVector& theta_rad, const ArmKinematics& arm, const KeepClearTargets& targets,
                   const NullSpace& space, ShapeModel& model) noexcept;

}  // namespace liana
