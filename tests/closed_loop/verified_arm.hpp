// The arm under control behind the real arbiter and both verification ends, as lianad puts them together: what a hand
// or a request asks for is verified for an interval, and only what passes reaches the core.
#pragma once

#include <string>
#include <vector>

#include "arm_under_control.hpp"
#include "host/control/arbiter/cable_arbiter.hpp"
#include "host/control/verification/issue_step.hpp"
#include "host/control/verification/simulation_verifier.hpp"
#include "host/control/verification/twin.hpp"

namespace liana::closed_loop {

class VerifiedArm {
 public:
  struct Refused {
    double time_s = 0.0;
    verification::Refusal code = verification::Refusal::kNone;
    std::string text;
  };

  // Boots. `with_scene`: the scene of the tests stands around it.
  explicit VerifiedArm(const PlantSetup& setup, bool with_scene = false);

  // One interval: what the arbiter asks for is verified, what was released in the last one is in force.
  void interval(const ArmUnderControl::Observer& observer = {});

  ArmUnderControl& arm() { return arm_; }
  arbiter::CableArbiter& arbiter() { return arbiter_; }
  double interval_s() const { return arm_.table().tick_s * arm_.table().interval_ticks; }
  double time_s() const { return static_cast<double>(arm_.inputs().tick) * arm_.table().tick_s; }
  const std::vector<Refused>& refused() const { return refused_; }

 private:
  void verify_next(const cable::Telecommand& in_force);

  arbiter::SpeedZone zone_;
  ArmUnderControl arm_;
  arbiter::CableArbiter arbiter_;
  verification::SimulationVerifier<cable::CableArm> end_;
  verification::IssueStep<cable::CableArm> release_;
  verification::Prediction<cable::CableArm> prediction_;
  cable::Telecommand next_{};  // in force from the next interval on
  verification::SimulationVerdict simulation_;
  std::vector<Refused> refused_;
};

}  // namespace liana::closed_loop
