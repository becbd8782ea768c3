// One wish per command interval: the arbiter chooses between the ways of moving, and makes the setpoint to verify next
// of what the one under way asks for. What every arm has is here, compiled once for each kind; cable_arbiter.hpp and
// serial_arbiter.hpp add what their arm can be asked for besides. Include with it the kind of the arm
// (cable_traits.hpp, serial_traits.hpp).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "host/control/arbiter/arm_traits.hpp"
#include "host/control/arbiter/joint_move.hpp"
#include "host/control/arbiter/path_move.hpp"
#include "host/control/arbiter/retract_request.hpp"
#include "host/control/arbiter/servo_move.hpp"
#include "host/control/arbiter/speed_rise.hpp"
#include "host/control/arbiter/speed_zone.hpp"
#include "host/control/arbiter/start_ramp.hpp"
#include "host/control/arbiter/tip_line.hpp"
#include "host/control/arbiter/tip_target.hpp"

namespace liana::arbiter {

template <class Arm>
class Arbiter {
 public:
  using Kind = ArmTraits<Arm>;
  using Table = typename Arm::Table;
  using Setpoint = typename Arm::Setpoint;
  using Now = liana::Outputs<Arm>;  // the newest tick of the arm

  // In `zone` the tip is asked to go no faster than the zone says. `check` looks at the straight pieces of a path, and
  // at the way of a joint move.
  explicit Arbiter(const Table& table, const SpeedZone& zone = {}, SearchResult taken = SearchResult::kInItsInterval,
                   PathCheck<Arm> check = {});
  Arbiter(const Arbiter&) = delete;  // ways of moving refer to its path and wishes
  Arbiter& operator=(const Arbiter&) = delete;
  virtual ~Arbiter() = default;

  // Requests of the owner; they throw RequestError (not_enabled, fault, busy, refused, out_of_range).
  void move_joints(const Now& now, const Joints<Arm>& goal_rad, double rate_rad_s, const motion::Swings& swings = {});
  void move_line(const Now& now, const Pose& goal, const motion::Swings& swings = {});
  void servo_tip(const Now& now, const Pose& goal);
  // From rest through all points without a stop, within kPathOff_m of the straight pieces between them; the first point
  // within kPathStart_deg of the command. Looked at as a whole first: until then the arm holds.
  void move_path(const Now& now, const PathRequest<Arm>& request);
  // The tip goes to where it should be beside a target that the camera sees, and ends by itself
  // (host/control/visual_servo); no faster than the arm's own limits.
  void servo_target(const Now& now, const visual_servo::ServoRequest& request);
  // An image of `target`, in the tip's frame at its exposure [s of arm time].
  void see_target(const std::string& target, double capture_s, const Pose& target_in_tip) {
    servo_.see(target, capture_s, target_in_tip);
  }
  // The servo under way, or how the last one went.
  const visual_servo::ServoStatus& servo_report() const { return servo_.report(); }
  // Back along the verified path, not beyond `until_tick`: stops, then goes back, whatever is under way. Also while
  // faults are latched that hold the arm.
  virtual void retract(const Now& now, std::uint64_t until_tick);
  // Stop along the path: nothing is asked for any more. `why` is told of a retract that it ends.
  virtual void hold(const std::string& why = "held");

  // Ends the interval: what to verify for the next one; nothing = the arm holds. `tick` counts the ticks done.
  virtual std::optional<Setpoint> next_setpoint(std::uint64_t tick, const Now& now);
  // The setpoint was refused: planned moves end. The way back stops and starts again, some times, and where
  // `may_pass_slower` moves to a goal do (another_try.hpp). Whether what was asked for goes on.
  virtual bool refused(const std::string& why = "", bool may_pass_slower = false);
  // Whether the last setpoint was a hand's; and whether one was refused for the same limit a moment ago.
  virtual bool leads_hand() const { return false; }
  virtual bool stands_refused() const { return false; }
  // What a hand asks for, with less of its speed than in the setpoint that was refused for `limit` (its name in the
  // table of refusals), for the same interval; nothing where no hand leads.
  virtual std::optional<Setpoint> slower(const Now&, const char*) { return std::nullopt; }

  // A planned move is under way.
  virtual bool is_busy() const;
  // What is asked for besides the tip, or the tip goal itself, has not come to be yet.
  bool is_asking() const { return std::holds_alternative<TipTarget<Arm>>(way_); }
  bool is_going_back() const { return std::holds_alternative<RetractMove<Arm>>(way_); }
  // The retract under way, or how the last one went.
  RetractState retract_state() const;
  bool has_retracted() const { return retract_state().phase == RetractPhase::kDone; }
  // The verified way back, for a copy that survives lianad.
  PathHistory<Joints<Arm>>& path_history() { return retract_request_.path(); }
  const PathHistory<Joints<Arm>>& path_history() const { return retract_request_.path(); }
  std::vector<RetractEvents> take_way_news() { return retract_request_.take_events(); }
  // The path under way; none.
  std::optional<PathProgress> path() const;
  // What has become of paths since the last call.
  std::vector<PathEvents> take_path_news() { return std::exchange(path_news_, {}); }

 protected:
  // One of the motions above begins: what else was asked for ends.
  virtual void motion_begins() {}
  // Throws RequestError not_enabled or fault; the second also busy.
  void require_ready(const Now& now) const;
  virtual void require_free(const Now& now) const;
  // The two halves of next_setpoint (false: the arm is not enabled, and all is
  // forgotten), and a tip goal for one interval that no request has set.
  bool begin_interval(std::uint64_t tick, const Now& now);
  std::optional<Setpoint> ask(const Now& now);
  Setpoint steer(const Now& now, const Pose& goal);
  // The tip is asked to stay where the command stands now, if nothing else is asked for.
  void stay_if_idle(const Now& now);
  // What is wished besides a tip goal. Who changes it says so: the goal then counts as reached some intervals later.
  typename Kind::Wishes& wishes() { return wishes_; }
  const typename Kind::Wishes& wishes() const { return wishes_; }
  void ask_anew();
  // Of `limit_m_s`, what a tip that is led along `way_m` may have now.
  virtual double speed_left_m_s(const Vec3& way_m, double limit_m_s);
  // Of the tip's speed, what the arm leaves hands and streams in this interval, 0..1.
  virtual double pace_left(const Now&) { return 1.0; }
  double pace() const { return pace_; }
  void limit_tip_speed(double speed_m_s) { tip_speed_m_s_ = speed_m_s; }
  // In place of the one that the arbiter was made with.
  void check_paths_by(PathCheck<Arm> check) { path_check_ = std::move(check); }
  const Table& table() const { return table_; }
  const SpeedZone& zone() const { return zone_; }

 private:
  // Nothing is asked for.
  struct Idle {
    static constexpr bool kIsPlanned = false;
    Goal<Arm> next(const Now&) { return {}; }
    bool is_over() const { return false; }
    bool refused() { return false; }
  };

  void tell(event::PathEvent what, const PathMove<Arm>& move, const std::string& rest);
  void tell_of_outlook(const PathMove<Arm>& move);
  void stop_asking(const std::string& why = "held");
  void end_motion();
  void require_enabled(const Now& now) const;
  void require_way_back(const Now& now, std::uint64_t until_tick) const;
  std::optional<Setpoint> setpoint_for(const Now& now, const Goal<Arm>& goal);
  Setpoint tip_setpoint(const Now& now, const Pose& goal);
  Setpoint joint_setpoint(const Joints<Arm>& joint_rad, CommandKind kind) const;

  Table table_;
  SpeedZone zone_;
  double tip_speed_m_s_;
  visual_servo::TargetServo servo_{interval_s(table_)};
  double pace_ = 1.0;
  Vec3 command_at_m_{};  // the tip, an interval ago
  StartRamp start_ramp_;
  GoalRamp goal_ramp_{Kind::goal_ramp(table_)};
  SpeedRise speed_rise_;
  typename Kind::Wishes wishes_{};
  RetractRequest<Arm> retract_request_{table_};
  Joints<Arm> command_rad_{};  // where the command stood last
  SearchResult taken_;
  PathCheck<Arm> path_check_;
  typename PathMove<Arm>::Work path_work_;
  typename JointMove<Arm>::Work move_work_;
  std::vector<PathEvents> path_news_;
  std::variant<Idle, TipTarget<Arm>, LineMove<Arm>, JointMove<Arm>, PathMove<Arm>, ServoMove<Arm>, RetractMove<Arm>>
      way_;
};

}  // namespace liana::arbiter
