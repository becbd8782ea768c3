// The second verification end as a desk uses it: started with a candidate's prediction, asked for its verdict.
#pragma once

#include <limits>

#include "host/simulate/worker.hpp"
#include "host/verify/judge_simulated.hpp"
#include "host/verify/verify.hpp"

namespace liana::verify {

constexpr double kEnough_m = 0.1;  // farther from the scene nobody asks how far
constexpr double kWhenever = std::numeric_limits<double>::infinity();

// Every T_c what the drives are told: now, then at the end of each interval that the twin has looked into.
void read_sequence(const TwinImage<cable::CableArm>& image, const Candidate<cable::CableArm>& candidate,
                   const Prediction<cable::CableArm>& prediction, simulate::JointSequence& out);

template <class Arm>
class SimulationEnd;

// The cable arm: its dynamics, in a thread of its own.
template <>
class SimulationEnd<cable::CableArm> {
 public:
  using Arm = cable::CableArm;

  // `arm`: lengths, masses, stiffness and friction of the robot's table.
  SimulationEnd(const simulate::ArmModel& arm, const MotionRules& rules);

  // Once an interval: what the drives say about how the arm moves.
  void watch(const TwinImage<Arm>& image);
  // From now on: what is known of arm and scene beside the measured angles and the drawing. `prediction_m` takes the
  // place of the scene's own; angles and placement are those of a StartState.
  void believe(const cable::ThetaVector& theta_off_rad, const Pose& drawing_in_base, double prediction_m);
  // Begins with what the candidate makes the controller tell its drives, from where the arm is measured to be.
  void begin(const TwinImage<Arm>& image, const Candidate<Arm>& candidate, const Prediction<Arm>& prediction);
  // The verdict on what was begun; refused as kNoVerdict where it takes longer than `patience_s`.
  SimulationVerdict verdict(double patience_s);

 private:
  MotionRules rules_;
  simulate::Worker worker_;
  simulate::StartState start_;
  cable::ThetaVector theta_off_rad_{};  // believed angles less measured ones
  cable::ThetaVector told_rad_{};       // when last watched
  cable::ThetaVector ahead_rad_s_{};    // by how much the arm goes faster than it is told
  simulate::JointSequence sequence_;
  TooNear too_near_;
  std::uint64_t number_ = 0;  // of the candidate
  bool comes_to_rest_ = false;
  bool begun_ = false;
  std::uint64_t watched_tick_ = 0;
};

// Serial arms have no dynamics and no scene here yet: their motion is judged as their own kinematics has it.
template <>
class SimulationEnd<serial::SerialArm> {
 public:
  using Arm = serial::SerialArm;

  explicit SimulationEnd(const serial::RobotTable& table) : table_(table) {}

  void watch(const TwinImage<Arm>&) {}
  void begin(const TwinImage<Arm>&, const Candidate<Arm>& candidate, const Prediction<Arm>& prediction) {
    verdict_ = judge_motion<Arm>(table_, candidate, prediction);
    verdict_.margins = margins_unknown();
  }
  SimulationVerdict verdict(double) { return verdict_; }

 private:
  serial::RobotTable table_;
  SimulationVerdict verdict_;
};

}  // namespace liana::verify
