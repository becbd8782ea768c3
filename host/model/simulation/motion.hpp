// What goes into the simulation of a command, and what comes out of it.
#pragma once

#include <optional>
#include <vector>

#include "host/model/simulation/arm_model.hpp"

namespace liana::simulation {

// Where the arm is found when the sequence begins.
struct StartState {
  ThetaVector theta_rad{};   // measured
  ThetaVector rate_rad_s{};  // estimated (ArmObserver)
  ThetaVector ahead_rad{};   // where the drums want the arm, less where it is, friction left out: what swings it
  CableVector tension_N{};   // measured, at the motor; all zero: as the simulation itself would plan them
  Pose drawing_in_base{};    // where the scene stands: of the frame that its table is drawn in
  std::optional<TipLoad> tip_load{};  // tool and payload; nothing: the table's tool
};

// What the drives are told, one row of angles [rad] every `interval_s` (T_c): the first one when the sequence begins,
// the last one when the stop after the command is over. Two rows at least.
template <class Joints>
struct ToldRows {
  double interval_s = 0.0;
  std::vector<Joints> rows_rad;
};

// The same of a cable arm, with what its tensions are planned to do; both empty: as planned_with makes them.
struct JointSequence : ToldRows<ThetaVector> {
  std::vector<ThetaVector> loads_Nm;    // about each theta
  std::vector<CableVector> tensions_N;  // at the motor
};

// The arm at one moment.
struct Moment {
  double time_s = 0.0;  // from the beginning of the sequence
  ThetaVector theta_rad{};
  ThetaVector rate_rad_s{};
  std::array<Vec3, kMaxSegments> node_in_base_m{};    // ends of the segments; the last one is the tip
  std::array<double, kMaxSegments> node_speed_m_s{};  // mean since the moment before
  double tip_rate_rad_s = 0.0;                        // turn of the tip, mean since the moment before
  CableVector tension_N{};                            // at the motor, with what inertia adds
};

// The least distance on the way, and where.
struct Nearest {
  double distance_m = 0.0;
  std::int32_t link = -1;   // 0-based; -1: there is nothing to touch
  std::int32_t other = -1;  // obstacle (clearance::obstacle_name), or the other link
  double time_s = 0.0;
};

// One body of the scene beside the way of an arm.
struct BodyBeside {
  double at_start_m = 0.0;
  Nearest nearest;
};

// How near the arm comes to bodies and to itself.
struct Distances {
  Nearest scene;  // to the scene, body included
  double scene_at_start_m = 0.0, scene_at_end_m = 0.0;
  std::vector<BodyBeside> bodies;  // each of them, where the arm could touch one at the start
  Nearest self;                    // between links that no joint connects
  // Where self.distance_m is more than 0, that.
  double self_at_start_m = 0.0, self_at_end_m = 0.0;
};

// The whole way: T_d apart, the sequence and what the arm swings after it.
struct Motion {
  bool solved = false;  // false: the table's arm has no dynamics, and there are no moments
  std::vector<Moment> moments;
  std::vector<Vec3> told_tip_in_base_m;  // where the tip would be at every row of the sequence if all followed at once
  ThetaVector friction_band_rad{};       // friction at either end of its band moves every angle by at most this
  CableVector min_passed_share{};        // tension at the anchor over tension at the motor, friction at its upper end
  Distances distances;
};

}  // namespace liana::simulation
