// What a serial arm can be asked for besides plain motion: a push by force control, and giving way
// (docs/explanation/force-control.md). Either is asked for again every interval until something else is.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "host/control/arbiter/arbiter.hpp"
#include "host/control/arbiter/serial_traits.hpp"

namespace liana::arbiter {

class SerialArbiter final : public Arbiter<serial::SerialArm> {
 public:
  using Base = Arbiter<serial::SerialArm>;

  using Base::Base;

  // Begins a push from rest; its number is given here. Throws RequestError: not_enabled, fault, busy. That the arm's
  // drives follow torques is looked at before (host/control/force_control).
  void push(const Now& now, const serial::Push& push);
  // From now on the joints give way to what pushes them; throws as push.
  void follow(const Now& now);
  // What the arm carries from now on, as a body in the tip's frame; without mass: nothing. `check` looks at the ways of
  // an arm that carries it.
  void carry(const serial::LinkMass& payload_at_tip, PathCheck<serial::SerialArm> check) {
    payload_at_tip_ = payload_at_tip;
    check_paths_by(std::move(check));
  }
  const serial::LinkMass& carried() const { return payload_at_tip_; }

  void hold(const std::string& why = "held") override;
  std::optional<Setpoint> next_setpoint(std::uint64_t tick, const Now& now) override;
  bool refused(const std::string& why = "", bool may_pass_slower = false) override;

  // A push or giving way is asked for.
  bool is_forcing() const { return asked_.has_value(); }

 private:
  void motion_begins() override { asked_.reset(); }
  void require_rest(const Now& now) const;

  std::optional<Setpoint> asked_;
  serial::LinkMass payload_at_tip_{};
};

}  // namespace liana::arbiter
