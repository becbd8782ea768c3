#include "verified_arm.hpp"

#include "fixture.hpp"
#include "host/control/verification/model_watch.hpp"
#include "host/control/verification/refusal_table.hpp"
#include "host/control/verification/verify.hpp"

namespace liana::closed_loop {

namespace {

using cable::CableArm;

arbiter::SpeedZone zone_of(const config::SceneConfig& scene) {
  return {scene.slit, robot_table().limits.tip_speed_slit_m_s};
}

const config::SceneConfig& scene_if(bool with_scene) {
  static const config::SceneConfig none;
  return with_scene ? scene() : none;
}

}  // namespace

VerifiedArm::VerifiedArm(const PlantSetup& setup, bool with_scene)
    : zone_(zone_of(scene_if(with_scene))),
      arm_(setup),
      arbiter_(arm_.table(), zone_),
      end_(simulation::arm_model(robot(setup.physics)),
           verification::MotionRules{
               arm_.table(), scene_if(with_scene), zone_, {}, robot(setup.physics).module_radius_m}) {
  arm_.boot();
}

void VerifiedArm::interval(const ArmUnderControl::Observer& observer) {
  const cable::Telecommand in_force = next_;
  verify_next(in_force);
  arm_.interval(in_force, observer);
}

void VerifiedArm::verify_next(const cable::Telecommand& in_force) {
  next_ = {};
  const auto interval = static_cast<std::uint64_t>(arm_.table().interval_ticks);
  verification::TwinSnapshot<CableArm> image(arm_.table());
  image.next_tick = arm_.inputs().tick + 1;
  image.fresh = false;
  image.controller = arm_.controller();
  image.last_inputs = arm_.inputs();
  image.last_outputs = arm_.outputs();
  const auto setpoint = arbiter_.next_setpoint(image.next_tick, arm_.outputs());
  end_.watch(image);
  if (!setpoint) return;
  const verification::Candidate<CableArm> candidate =
      release_.candidate(*setpoint, 1, image.next_tick + interval, interval);
  verification::Twin<CableArm>::run(image, {&in_force, 1}, candidate, verification::max_stop_ticks(arm_.table().tick_s),
                                    prediction_);
  end_.begin(image, candidate, prediction_, false);
  verification::ExecutionVerdict execution =
      verification::judge_execution<CableArm>(arm_.table(), candidate, prediction_, zone_);
  simulation_ = end_.verdict(verification::kWhenever);
  verification::judge_model(arm_.table(), arm_.outputs(), prediction_.ticks.back(), false, execution);
  if (const auto released = release_.release(candidate, execution, simulation_)) {
    next_ = *released;
    return;
  }
  const verification::Verdict& worst =
      execution.passed() ? static_cast<const verification::Verdict&>(simulation_) : execution;
  refused_.push_back({time_s(), worst.code, worst.text});
  arbiter_.refused(worst.text, verification::may_pass_slower(worst.code));
}

}  // namespace liana::closed_loop
