// What the arm weighs and its springs pull: the torque that cables have to give for it to stand still.
//
// With the potential V = - sum m g c + sum n / 2 K (theta - rest)^2 over all modules and the tool, cables that give
// dV / d theta hold the arm: sum_c J_ck rho_cj t_c = -dV / d theta_k. Modules are point masses on the line between
// their joints, so that a segment's moment has the closed form of its kinematics: with s the share of a module's length
// at which its mass lies, link k (kinematics.hpp) counts n - k + s times in it.
#pragma once

#include "firmware_like/cable/arm/kinematics.hpp"
#include "firmware_like/cable/arm/robot_params.hpp"
#include "firmware_like/cable/arm/tension.hpp"

namespace liana::cable {

// Both as one point mass, at their common centre.
TipLoad joined(const TipLoad& a, const TipLoad& b) noexcept;

// False where nothing loads the arm at rest: static_load_Nm is zero everywhere.
bool has_static_load(const RobotParams& table) noexcept;

// Torque [N m] about each theta that holds the arm at theta_rad; zero beyond the table's thetas. `trig` and `arm` are
// of the same angles. Cost: 30 operations a module and 60 a segment.
ThetaVector static_load_Nm(const RobotParams& table, const ThetaVector& theta_rad, const ArmTrig& trig,
                           const ArmKinematics& arm) noexcept;

// The plan for an arm that stands at theta_rad, nothing having slipped. Cost: kinematics, cables and a plan.
TensionPlan plan_at_rest(const RobotParams& table, const CableLayout& layout, const ThetaVector& theta_rad) noexcept;
// The same under this load [N m] in place of the table's.
TensionPlan plan_at_rest(const RobotParams& table, const CableLayout& layout, const ThetaVector& theta_rad,
                         const ThetaVector& load_Nm) noexcept;

}  // namespace liana::cable
