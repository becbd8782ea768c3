// The simulated person at two VR handles, who looks at the display: the drawing of the scene, and the arm as it is
// drawn there. The right hand leads the tip to the panel's edge, the left one a node, and with it the arm's shape.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "host/model/config/config.hpp"
#include "host/operator/simulated/arm_observation.hpp"
#include "host/operator/simulated/hand_grip.hpp"
#include "host/operator/simulated/handle_tracker.hpp"
#include "host/operator/simulated/hands_plan.hpp"
#include "host/operator/simulated/leg.hpp"
#include "host/operator/simulated/samples.hpp"
#include "host/operator/simulated/temper.hpp"
#include "host/operator/simulated/vr_gains.hpp"

namespace liana::simulated {

// The panel's edge as the drawing has it; nothing without a slit.
std::optional<Pose> panel_edge(const VrGains& gains, const config::SceneConfig& drawing);

// Deterministic: the same calls give the same hands, whatever the machine.
class VrOperatorModel {
 public:
  static constexpr double kSample_s = 1.0 / 90.0;

  VrOperatorModel(const VrGains& gains, const config::SceneConfig& drawing, std::uint64_t seed,
                  Temper temper = Temper::kGentle);

  // Asked to go to the panel's edge; looks first. In a scene without a slit there is none, and the person waits.
  void begin(const HandMapping& mapping, double now_s);
  // A picture of the arm arrives; it is acted on after the reaction time.
  void look(const ArmObservation& sight, double now_s);
  // Whether the arm follows the hands, as the display shows it.
  void feel(bool engaged, double now_s);
  // The hands one sample on; call every kSample_s.
  BothHands sample(double now_s);
  // The hands while another device is used; nothing unless a lively person holds the handles as well.
  std::optional<BothHands> idle(double now_s);

  // True when the tip is seen to be there and the triggers are released.
  bool arrived() const { return phase_ == Phase::kDone; }
  // How often the way was decided anew because the arm came too near something.
  int second_thoughts() const { return second_thoughts_; }

 private:
  enum class Phase : std::uint8_t { kIdle, kLooking, kReturning, kGripping, kLeading, kSettling, kLettingGo, kDone };
  struct Picture {
    double due_s = 0.0;
    ArmObservation sight{};
  };

  void perceive(double now_s);
  void enter(Phase phase, double now_s);
  void look_around(double now_s);
  void come_back(double now_s);
  void decide();
  void start_leg(const Pose& from);
  void lead(double now_s);
  void watch_goal(double now_s);
  bool worries();
  double eagerness(double now_s) const;
  bool holds() const;
  bool out_of_reach() const;
  void act(double now_s);
  bool keeps_grip(double now_s);
  BothHands tracked(bool held, double now_s);
  const HandsGoal& aim() const { return way_[next_]; }
  Vec3 node_commanded_m() const;

  VrGains gains_;
  config::SceneConfig drawing_;
  HandGrip right_;
  HandGrip left_;
  HandleTracker right_tracker_;
  HandleTracker left_tracker_;
  std::optional<LivelyHands> lively_;
  bool has_slipped_ = false;  // lost the grip: looks before it goes on
  Phase phase_ = Phase::kIdle;
  double phase_since_s_ = 0.0;
  Pose edge_{};
  std::vector<HandsGoal> way_;
  std::size_t next_ = 0;
  Leg leg_{};  // of the tip; the node goes along with it
  Vec3 node_from_m_{}, node_to_m_{};
  std::optional<Vec3> node_put_m_;  // where the left hand left the node's goal
  std::deque<Picture> pictures_;
  ArmObservation seen_{};
  double last_picture_s_ = 0.0;
  double followed_s_ = 0.0;
  double there_since_s_ = 0.0;
  double striving_since_s_ = 0.0;
  Vec3 decided_at_m_{};  // the tip, when the way was decided
  double room_m_ = 0.0;  // the least that was seen since then
  bool doubts_ = false;  // decides anew before gripping again
  int second_thoughts_ = 0;
};

}  // namespace liana::simulated
