// Cable tensions of a pose as the core plans them (firmware_like/cable/arm/static_load.hpp, nothing has slipped yet),
// with derivatives.
//
// The core's plan is a sweep over segments by smooth formulas. It is asked, not copied: derivatives are central
// differences of it. The planner so constrains what the controller will do, whatever the formulas are. Steps are a
// hundred times what round-off needs, and a hundredth of what the formulas' roundings (2 N) see: the tests hold 1e-4 of
// the largest entry, first and second derivatives.
#pragma once

#include <array>

#include "firmware_like/cable/arm/static_load.hpp"
#include "host/planning/planner/problem/arm_derivatives.hpp"

namespace liana::planner {

using namespace cable;  // this room serves the cable arm only

class PlannedTension {
 public:
  // The table must outlive this.
  explicit PlannedTension(const RobotParams& table) : table_(table), layout_(cable_layout(table)) {}

  // At the motors [N]. Cost: one tension plan, about 3 us.
  CableVector at(const ThetaVector& theta_rad) const;
  // Derivatives [N/rad] per cable and theta; 20 tension plans.
  std::array<ThetaVector, kMaxCables> by_theta(const ThetaVector& theta_rad) const;
  // Adds the second derivatives of weight . tension; 111 tension plans.
  void add_hessian(const ThetaVector& theta_rad, const CableVector& weight, ThetaHessian& hessian) const;

  // Most by which a cable is below the floor at the motor or over the ceiling of free motion [N]; 0 or less: none is.
  double excess_N(const ThetaVector& theta_rad) const;

 private:
  const RobotParams& table_;
  CableLayout layout_;
};

}  // namespace liana::planner
