// How the arm swings now, estimated from what its drives are told and what its lengths and tensions show.
#pragma once

#include "host/model/simulation/swinging_arm.hpp"

namespace liana::simulation {

// Of the observer's correction by measured less predicted angles. With stiffness K and mass M every mode of the error
// has s^3 + p s^2 + (w^2 + r) s + h w^2: stable for h < p, whatever its frequency w.
constexpr double kObserverAngle_1_s = 2.0;  // p
constexpr double kObserverRate_1_s2 = 1.0;  // r
constexpr double kObserverHeld_1_s = 0.2;   // h: what friction holds shows after seconds

class ArmObserver {
 public:
  explicit ArmObserver(const ArmModel& model)
      : arm_(model),
        thetas_(eigen::theta_count(model.table)),
        step_s_(0.5 * model.table.tick_s * model.table.interval_ticks) {}

  // What was measured, and what the drives have been told, `since_s` after the last call: measured angles and tensions
  // are taken as they are, the rest is estimated. The first call, and one after a gap, begins anew, at rest.
  void watch(const ThetaVector& measured_rad, const CableVector& tension_N, const ToldNow& told, double since_s);
  void forget() { begun_ = false; }
  // From the next beginning on: tool and payload.
  void carry(const TipLoad& tip_load) {
    now_.tip_load = tip_load;
    forget();
  }

  const StartState& now() const { return now_; }

 private:
  SwingingArm arm_;
  Eigen::Index thetas_;
  double step_s_;  // T_d
  bool begun_ = false;
  ToldNow told_;
  StartState now_;
};

}  // namespace liana::simulation
