// What friction between cables and holes really is, found while the arm moves.
//
// Nothing pushes the arm from outside, so that at each of its axes the torques of the cables balance: sum_c J_ck
// exp(-mu slid_cj) t_c = -load_k, where slid_cj is the bend that cable c slides over until the middle of the axis'
// segment, signed as planned (friction.hpp). One axis after another gives one equation for mu; a Kalman filter of that
// one number weighs them. Derivation, what was left out and measured errors: docs/explanation/arm-control.md.
#pragma once

#include <cstdint>

#include "firmware_like/cable/arm/cables.hpp"
#include "firmware_like/cable/arm/friction.hpp"

namespace liana::cable {

constexpr std::uint32_t kFrictionTicks = 8;  // one axis is looked at in so many ticks
constexpr double kMovingRate_rad_s = 0.002;  // of all commanded angles together; below it cables may rest in presliding

// Errors of the balance that are not friction's stay for seconds (swing, torque gains), so that each equation counts as
// little as this noise says: the stated uncertainty then covers what was found in whole missions.
constexpr double kBalanceNoise_Nm = 4.0;
constexpr double kSlidingRate_rad_s = 0.001;  // both angles of a segment together: cables slide by 0.2 mm in a second
constexpr double kResting = 4.0;  // weight of what is not known about cables that rest: it stays as it is for seconds
constexpr double kInnovationLimit = 3.0;      // standard deviations: a torque further off counts as one that far off
constexpr double kFrictionDrift_1_s = 2e-4;   // mu may have changed by so much after 1 s of motion, twice in 4 s
constexpr double kFrictionPriorShare = 0.4;   // uncertainty of what was declared, before the arm has moved
constexpr double kFrictionPrior = 0.03;       // added to it
constexpr double kFrictionModelShare = 0.03;  // of mu: error of the model itself, in the stated uncertainty

// Where it is not as declared: further off than this, twice the uncertainty taken off; as declared again at half of it.
// 20 % never are, twice or half always.
constexpr double kFrictionFlagShare = 0.3;
constexpr double kFrictionFlag = 0.004;

// The arm plans with what was found where that is not as declared and certain enough, and never changes faster: cables
// move by micrometres a second for it, tensions by less than 1 N a second. Within the flag's band the declared plan's
// margins were measured, and a plan that follows every per cent is no better (docs/explanation/arm-control.md).
constexpr double kFrictionPlanSd = 0.006;
constexpr double kFrictionPlanRate_1_s = 0.005;
constexpr double kFrictionPlanMost = 0.10;  // or what was declared: more than that spreads tensions beyond the ceiling

struct FrictionEstimatorState {
  double mu = 0.0;         // found; what was declared before the arm has moved
  double variance = 0.0;   // of it, without the model's own error
  std::uint32_t axis = 0;  // looked at next
  bool flagged = false;    // not as declared
};

// What one tick knows of the arm.
struct FrictionReadings {
  const CableGeometry& geometry;
  const TensionRatio& ratio;  // with `planned_mu`
  const SlipState& slip;
  const SegmentVector& wrap_rad;
  const CableVector& tension_N;   // measured, low-passed
  double planned_mu;              // what the arm plans with
  const ThetaVector& rate_rad_s;  // commanded
  double load_Nm;                 // what weight, springs and the arm's mass take about the axis that is looked at
  bool moving;                    // commanded faster than kMovingRate_rad_s
};

// Bit j: segment j turns fast enough that cables slide in it.
std::uint32_t turning_segments(const RobotParams& table, const ThetaVector& rate_rad_s) noexcept;

// Nothing found yet: as the table declares.
void reset_friction_watch(double declared_mu, FrictionEstimatorState& state) noexcept;

// Looks at the next axis; to be called every kFrictionTicks ticks while the arm is prepared and tensions are trusted.
// True when it was the last one: every axis has been looked at. Cost: seven operations per cable and segment passed.
bool watch_friction(const RobotParams& table, const CableLayout& layout, double declared_mu,
                    const FrictionReadings& now, FrictionEstimatorState& state) noexcept;

// Standard deviation of what was found, the model's own error in it.
double friction_sd(const FrictionEstimatorState& state) noexcept;

// The friction to plan with in this tick; `planned_mu` is that of the last one.
double plan_friction(double declared_mu, double planned_mu, double tick_s,
                     const FrictionEstimatorState& state) noexcept;

// True when it is not as declared and further from what the arm may plan with than the flag's band: no plan carries it.
bool is_friction_too_high(double declared_mu, const FrictionEstimatorState& state) noexcept;

}  // namespace liana::cable
