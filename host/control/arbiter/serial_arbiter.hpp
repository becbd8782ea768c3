// What a serial arm can be asked for besides plain motion: a push by force control, and giving way
// (docs/explanation/force-control.md). Either is asked for again every interval until something else is.
#pragma once

#include <optional>
#include <string>

#include "host/control/arbiter/arbiter.hpp"
#include "host/control/arbiter/serial_traits.hpp"

namespace liana::arbiter {

class SerialArbiter : public Arbiter<serial::SerialArm> {
 public:
  using Base = Arbiter<serial::SerialArm>;

  using Base::Base;

  // Begins a push from rest; its number is given here. Throws RequestError: not_enabled, fault, busy. That the arm's
  // drives follow torques is looked at before (host/control/force_control).
  void push(const Now& now, const serial::Push& push);
  // From now on the joints give way to what pushes them; throws as push.
  void follow(const Now& now);
  // What the arm carries from now on, as a body in the tip's frame; without mass: nothing.
  void carry(const serial::LinkMass& payload_at_tip) { payload_at_tip_ = payload_at_tip; }
  const serial::LinkMass& carried() const { return payload_at_tip_; }

  // As those of plain motion; each ends what was asked for here.
  void move_joints(const Now& now, const serial::JointVector& goal_rad, double rate_rad_s,
                   const motion::Swings& swings = {});
  void move_line(const Now& now, const Pose& goal, const motion::Swings& swings = {});
  void servo_tip(const Now& now, const Pose& goal);
  void servo_target(const Now& now, const visual_servo::ServoRequest& request);
  void move_path(const Now& now, const PathRequest<serial::SerialArm>& request);
  void retract(const Now& now, std::uint64_t until_tick);
  void hold(const std::string& why = "held");
  std::optional<Setpoint> next_setpoint(std::uint64_t tick, const Now& now);
  bool refused(const std::string& why = "", bool may_pass_slower = false);
  // No hand leads a serial arm's tip.
  // Nothing is asked for more slowly.
  bool leads_hand() const { return false; }
  bool stands_refused() const { return false; }
  std::optional<Setpoint> slower(const Now&, const char*) { return std::nullopt; }

  // A push or giving way is asked for.
  bool is_forcing() const { return asked_.has_value(); }

 private:
  void require_rest(const Now& now) const;

  std::optional<Setpoint> asked_;
  serial::LinkMass payload_at_tip_{};
};

}  // namespace liana::arbiter
