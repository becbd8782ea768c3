// Clearance as an aim of the shape: the arm's middle is pushed away from given points while the tip stays.
#pragma once

#include "firmware_like/cable/arm/setpoint.hpp"
#include "firmware_like/cable/shape/shape_model.hpp"

namespace liana::cable {

// Largest weight of a target that is used; 0 when there is none.
double largest_weight(const KeepClearTargets& targets) noexcept;

// Sum over targets and segments of weight times what the segment's nearest point lacks of the distance [m].
double missing_clearance_m(const RobotParams& table, const ThetaVector& theta_rad, const ArmKinematics& arm,
                           const KeepClearTargets& targets) noexcept;

// True when a target asks for anything.
bool is_used(const KeepClear& target) noexcept;

// Adds the push of a used target on the nearest point of one segment (from 0), whose trigonometry is `trig`. Cost: one
// pass over its links.
void add_clearance(const RobotParams& table, const SegmentTrig& trig, const ArmKinematics& arm, const KeepClear& target,
                   std::int32_t segment, PullSum& sum) noexcept;

// The same of every target on every segment.
void add_clearance(const RobotParams& table, const ThetaVector& theta_rad, const ArmKinematics& arm,
                   const KeepClearTargets& targets, PullSum& sum) noexcept;

}  // namespace liana::cable
