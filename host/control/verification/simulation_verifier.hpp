// The second verification end as a desk uses it: started with a candidate's prediction, asked for its verdict.
#pragma once

#include <limits>

#include "host/control/verification/judge_serial.hpp"
#include "host/control/verification/judge_simulated.hpp"
#include "host/control/verification/told_sequence.hpp"
#include "host/control/verification/verify.hpp"
#include "host/model/simulation/arm_observer.hpp"
#include "host/model/simulation/worker.hpp"

namespace liana::verification {

constexpr double kWhenever = std::numeric_limits<double>::infinity();

template <class Arm>
class SimulationVerifier;

// Of the stop that follows when nothing more is released: whether it was simulated, and touches nothing. How it swings
// is no reason against it: there is no better one.
enum class StopSwings : std::uint8_t { kUnknown, kPasses, kTouches };

// The cable arm: its dynamics, in a thread of its own.
template <>
class SimulationVerifier<cable::CableArm> {
 public:
  using Arm = cable::CableArm;

  // `arm`: lengths, masses, stiffness and friction of the robot's table.
  SimulationVerifier(const simulation::ArmModel& arm, const MotionRules& rules);

  // Once an interval: what the drives say about how the arm moves. How near to a body it has come counts on while it is
  // disabled: a stop and enabling give it no further millimetres.
  void watch(const TwinSnapshot<Arm>& image);
  // Something else than commands has led the arm away from its path: how near it had come counts no more.
  void led_astray() { too_near_.forget(); }
  // From now on: what is known of arm and scene beside the measured angles and the drawing. `prediction_m` takes the
  // place of the scene's own; angles and placement are those of a StartState.
  void believe(const cable::ThetaVector& theta_off_rad, const Pose& drawing_in_base, double prediction_m);
  // From now on tool and payload weigh so much; other swings are estimated anew.
  void carry(const cable::TipLoad& tip_load) { observer_.carry(tip_load); }
  // Begins with what the candidate makes the controller tell its drives, from where the arm is measured to be;
  // `retracts`: on its way back.
  void begin(const TwinSnapshot<Arm>& image, const Candidate<Arm>& candidate, const Prediction<Arm>& prediction,
             bool retracts);
  // The verdict on what was begun; refused as kNoVerdict where it takes longer than `patience_s`.
  SimulationVerdict verdict(double patience_s);
  // Looks at `stop`, what becomes of the arm when a candidate of `first_tick` is refused, and judges by it until the
  // next image. Once an image.
  StopSwings look_at_stop(const TwinSnapshot<Arm>& image, std::uint64_t first_tick, const Prediction<Arm>& stop,
                          double patience_s);

 private:
  bool simulates(const TwinSnapshot<Arm>& image, std::uint64_t first_tick, const Prediction<Arm>& prediction);

  MotionRules rules_;
  simulation::Worker worker_;
  simulation::ArmObserver observer_;
  cable::ThetaVector theta_off_rad_{};  // believed angles less measured ones
  simulation::JointSequence sequence_;
  TooNear too_near_;
  std::uint64_t number_ = 0;  // of the candidate
  std::uint32_t trial_ = 0;
  bool comes_to_rest_ = false;
  bool begun_ = false;
  std::uint64_t watched_tick_ = 0;
  simulation::Motion stop_;  // unsolved: nothing is compared
  StopSwings stop_swings_ = StopSwings::kUnknown;
};

// A serial arm: what the drives are told as its own kinematics has it, and where links of rigid gears go with that. It
// takes no thread: about 500,000 instructions with a scene of a few bodies.
template <>
class SimulationVerifier<serial::SerialArm> {
 public:
  using Arm = serial::SerialArm;

  SimulationVerifier(const simulation::SerialModel& arm, const config::SceneConfig& scene)
      : table_(arm.table), simulation_(arm, scene, kEnough_m) {}

  // Once an interval: whether commands still are what moves the arm.
  void watch(const TwinSnapshot<Arm>& image) {
    if (image.last_outputs.state != OperatingState::kEnabled) too_near_.disabled();
  }
  void led_astray() { too_near_.forget(); }
  // Judges what the candidate makes the controller tell its drives, from where the arm is measured to be.
  void begin(const TwinSnapshot<Arm>& image, const Candidate<Arm>& candidate, const Prediction<Arm>& prediction,
             bool retracts);
  SimulationVerdict verdict(double) { return verdict_; }
  // Links of rigid gears do not swing.
  StopSwings look_at_stop(const TwinSnapshot<Arm>&, std::uint64_t, const Prediction<Arm>&, double) {
    return StopSwings::kUnknown;
  }

 private:
  serial::RobotParams table_;
  simulation::SerialSimulation simulation_;
  simulation::ToldRows<serial::JointVector> sequence_;
  TooNear too_near_;
  SimulationVerdict verdict_;
};

}  // namespace liana::verification
