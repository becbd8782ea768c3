// The arm while its drives are told where to go: where its drums want it, how it swings about that, how tight its
// cables are.
#pragma once

#include "host/model/simulation/drum_lag.hpp"
#include "host/model/simulation/linear_arm.hpp"
#include "host/model/simulation/motion.hpp"

namespace liana::simulation {

constexpr double kNewPose_rad = 0.06;  // an angle that has moved further (3.4 deg): the equations are solved anew

inline ThetaVector vector(const eigen::ThetaColumn& theta) {
  ThetaVector out{};
  eigen::view(out, theta.size()) = theta;
  return out;
}

// What the drives' lengths are made of at one moment: angles, and tensions that give a load there.
struct ToldNow {
  eigen::ThetaColumn theta_rad, load_Nm;
  CableColumn tension_N;

  ToldNow to(const ToldNow& other, double share) const {
    return {theta_rad + share * (other.theta_rad - theta_rad), load_Nm + share * (other.load_Nm - load_Nm),
            tension_N + share * (other.tension_N - tension_N)};
  }
};

class SwingingArm {
 public:
  explicit SwingingArm(const ArmModel& model) : model_(model) {}

  // From `start`, in steps of `step_s`; the drives have followed from `before`, `since_s` ago, to `now`. False when the
  // table's arm has no dynamics.
  bool begin(const StartState& start, const ToldNow& before, const ToldNow& now, double since_s, double step_s);
  // One step while the drives are told a straight way on to `told`. False when the equations have no solution.
  bool step(const ToldNow& told);

  const Swing& swing() const { return swing_; }
  // Angle and rate are measured to be so much more; `held_rad` more of what the drums want is held by friction.
  void correct(const eigen::ThetaColumn& theta_rad, const eigen::ThetaColumn& rate_rad_s,
               const eigen::ThetaColumn& held_rad);
  // At the motor: as planned, and stretched by what the arm is off where it was planned for; what was measured beside
  // that at the start (friction, zeros, gains) stays.
  CableColumn tension_N() const { return modelled_N() + beside_N_; }
  const LinearArm& equations() const { return arm_; }
  int times_solved() const { return times_solved_; }

 private:
  bool solve(const ThetaVector& about_rad);
  CableColumn modelled_N() const;

  ArmModel model_;
  double step_s_ = 0.0;
  LinearArm arm_;
  ThetaVector about_rad_{};
  int times_solved_ = 0;
  Swing swing_;
  DrumLag<eigen::ThetaColumn> theta_, load_;
  DrumLag<CableColumn> planned_;
  CableColumn beside_N_;
};

// The rows with loads and tensions as a controller plans them for the arm's mass.
JointSequence planned_with(const ArmModel& model, const ToldRows<ThetaVector>& rows);

}  // namespace liana::simulation
