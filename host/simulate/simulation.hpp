// The 3-D simulation end: what the arm does when its drives are told a sequence of angles (source C, step 3).
#pragma once

#include "host/clearance/clearance.hpp"
#include "host/simulate/distances.hpp"
#include "host/simulate/drum_lag.hpp"
#include "host/simulate/linear_arm.hpp"
#include "host/simulate/motion.hpp"

namespace liana::simulate {

constexpr int kStepsPerInterval = 2;   // T_d = T_c / 2
constexpr double kSwingOut_s = 0.1;    // how long the arm is followed after the sequence
constexpr double kNewPose_rad = 0.06;  // an angle that has moved further (3.4 deg): the equations are solved anew

class Simulation {
 public:
  // Distances to the scene beyond `enough_m` are not told apart.
  Simulation(const ArmModel& model, const config::SceneConfig& scene, double enough_m = clearance::kNoObstacle_m)
      : model_(model), scene_(scene), enough_m_(enough_m) {}

  // Follows the sequence in steps of T_d, straight between its rows, and the arm after it. The result is valid until
  // the next run. About 7,000 instructions a step, and the distances.
  const Motion& run(const StartState& start, const JointSequence& sequence);

 private:
  bool solve(const ThetaVector& about_rad);
  void plan_tensions(const StartState* start);
  void step(DrumLag& lag, const algebra::ThetaColumn& told_rad, Swing& swing);
  void note(const Swing& swing);
  void add_to_way(const ThetaVector& theta_rad);
  void place_told(const JointSequence& sequence);
  void measure_distances(const Pose& drawing_in_base);

  ArmModel model_;
  config::SceneConfig scene_;
  double enough_m_;
  double step_s_ = 0.0;
  LinearArm arm_;
  ThetaVector about_rad_{};
  CableColumn tension_N_;           // at rest about this pose
  CableColumn tension_measured_N_;  // less planned, at the start
  Chain chain_;
  Way way_;
  Motion motion_;
};

}  // namespace liana::simulate
