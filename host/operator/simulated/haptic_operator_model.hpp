// The simulated person at the hand controller, who sees the tip camera and nothing else of the arm.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "host/api/device/sample.hpp"
#include "host/operator/simulated/aim.hpp"
#include "host/operator/simulated/hand_grip.hpp"
#include "host/operator/simulated/leg.hpp"
#include "host/operator/simulated/temper.hpp"
#include "host/operator/simulated/tremor.hpp"

namespace liana::simulated {

// What the person has been asked to do.
enum class HandTask : std::uint8_t {
  kEnterSlit,  // align before the mouth, then go in to the depth where the next segment must go planar
  kReachRod,   // to the rod, then fine alignment
};

// Deterministic: the same calls give the same hand, whatever the machine.
class HapticOperatorModel {
 public:
  HapticOperatorModel(const HandGains& gains, const SlitModel& drawing, std::uint64_t seed,
                      Temper temper = Temper::kGentle);

  // A task begins; the person looks first.
  void begin(HandTask task, const HandMapping& mapping, double now_s);
  // A picture arrives; it is acted on after the reaction time.
  void look(const TipObservation& sighting, double now_s);
  // Whether the arm follows the hand, as the console shows it.
  void feel(bool engaged, double now_s);
  // The hand one millisecond on; call once per millisecond of `now_s`.
  device::Sample sample(double now_s);
  // The hand while another device is used; nothing unless a lively person holds this one as well.
  std::optional<device::Sample> idle(double now_s);

  // True when the task is done and the button released.
  bool arrived() const { return phase_ == Phase::kDone; }
  // Error judged by eye (low-passed) against the current leg's goal.
  const PoseStep& judged_error() const { return judged_; }

 private:
  enum class Phase : std::uint8_t { kIdle, kLooking, kReturning, kGripping, kSteering, kSettling, kLettingGo, kDone };
  // A leg's end and how good is good enough there.
  struct Goal {
    Pose tip_in_slit{};
    double tolerance_m = 0.0;
    double tolerance_rad = 0.0;
    double dwell_s = 0.0;
    double relent_most = 1.0;
    double at_last = 1.0;  // after long striving; up to relent_most, never
  };
  struct Picture {
    double due_s = 0.0;
    TipObservation sighting{};
  };

  void plan(const Pose& seen_tip);
  void start_leg(const Pose& from);
  LegPace pace() const;
  void perceive(double now_s);
  void go_on(double now_s);
  void rest_eyes(const Pose& seen_tip, double now_s);
  void take_in(const Pose& seen_tip, double now_s);
  void judge(const Pose& seen_tip, double since_last_s);
  PoseStep lag_directions(double now_s) const;
  double eagerness(double now_s) const;
  bool button() const;
  void act(double now_s);
  void look_around(double now_s);
  void steer(double now_s);
  void watch_goal(double now_s);
  void enter(Phase phase, double now_s);
  bool is_behind() const;
  bool is_aligning() const;
  device::Sample lively(device::Sample meant, double now_s);

  HandGains gains_;
  SlitModel drawing_;
  Tremor tremor_;
  std::optional<LivelyHands> lively_;
  bool has_slipped_ = false;  // lost the grip: looks before it goes on
  HandTask task_ = HandTask::kEnterSlit;
  double allowed_speed_m_s_ = 0.0;  // 0: not said
  Phase phase_ = Phase::kIdle;
  double phase_since_s_ = 0.0;
  double settling_since_s_ = 0.0;  // the hand stands
  std::vector<Goal> goals_;
  std::size_t goal_index_ = 0;
  Leg leg_{};
  Aim aim_;
  HandGrip grip_;
  std::deque<Picture> pictures_;
  Pose rest_tip_{};
  int looks_ = 0;
  double last_picture_s_ = 0.0;
  double last_moving_s_ = -1e9;
  double good_since_s_ = 0.0;
  double striving_since_s_ = 0.0;  // the leg has been walked
  double followed_s_ = 0.0;
  PoseStep judged_{};
};

}  // namespace liana::simulated
