// The 3-D simulation end: what the arm does when its drives are told a sequence of angles and tensions (source C, step
// 3).
#pragma once

#include "host/model/clearance/clearance.hpp"
#include "host/model/simulation/distances.hpp"
#include "host/model/simulation/swinging_arm.hpp"

namespace liana::simulation {

constexpr int kStepsPerInterval = 2;  // T_d = T_c / 2
constexpr double kSwingOut_s = 0.1;   // how long the arm is followed after the sequence

class Simulation {
 public:
  // Distances to the scene beyond `enough_m` are not told apart.
  Simulation(const ArmModel& model, const config::SceneConfig& scene, double enough_m = clearance::kNoObstacle_m)
      : model_(model), scene_(scene), enough_m_(enough_m), arm_(model) {}

  // Follows the sequence in steps of T_d, straight between its rows, and the arm after it. The result is valid until
  // the next run. About 8,000 instructions a step, and the distances.
  const Motion& run(const StartState& start, const JointSequence& sequence);

 private:
  ToldNow told(const JointSequence& sequence, std::size_t row) const;
  void look_at_friction(const CableColumn& tension_N);
  void note();
  void add_to_way(const ThetaVector& theta_rad);
  void place_told(const JointSequence& sequence);
  void follow(const JointSequence& sequence);
  void measure_distances(const Pose& drawing_in_base);

  ArmModel model_;
  config::SceneConfig scene_;
  double enough_m_;
  double step_s_ = 0.0;
  SwingingArm arm_;
  Chain chain_;
  Way way_;
  Motion motion_;
};

}  // namespace liana::simulation
