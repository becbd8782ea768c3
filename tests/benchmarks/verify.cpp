// What verifying one command costs: the twin through the command and the whole stop after it with its judge, operation
// "verify", and the simulation end with its own, in the scene of the slit, operation "simulate". Every motion is under
// way and its commands pass; labels as meter.hpp says.
#include <cstdio>
#include <exception>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/control/verification/judge_simulated.hpp"
#include "host/control/verification/simulation_verifier.hpp"
#include "host/model/simulation/simulation.hpp"
#include "tests/benchmarks/meter.hpp"
#include "tests/firmware_like/ideal_drives.hpp"
#include "tests/firmware_like/panel_slit.hpp"

namespace liana::bench {

using namespace cable;
namespace {

constexpr std::int32_t kEnablingTicks = 1000;  // more than the drives and the pretension take
constexpr std::int32_t kIntervals = 150;       // of a motion: 3 s
constexpr std::int32_t kEvery = 10;            // of which so many are verified
constexpr zhu2022::Degrees kInSlit_deg{-2.79, -6.63, -1.75, -6.31, 5.03, 11.60, 1.87, 9.68, 0.00, -4.64};

// What is asked for in an interval of a motion, from 0.
using Motion = std::function<Setpoint(const Rig& rig, std::int32_t interval)>;

class Verifier {
 public:
  explicit Verifier(Meter& meter) : meter_(meter), image_(robot_) { prediction_.ticks.reserve(max_ticks_ * 2); }

  // Carries out a motion from `start_deg` and counts the verification of some of its commands.
  void play(const std::string& name, const zhu2022::Degrees& start_deg, const Motion& motion) {
    Rig rig(zhu2022::radians(start_deg));
    rig.robot = robot_;
    rig.controller = cable::Controller(robot_);
    rig.run(60);
    rig.tick(Request::kEnable);
    rig.run(kEnablingTicks);
    std::vector<cable::Telecommand> released(1);
    for (std::int32_t i = 0; i < kIntervals; ++i) {
      const Setpoint setpoint = motion(rig, i);
      // What is verified is carried out in the next interval.
      const std::uint64_t first = rig.now + interval_;
      const auto candidate = release_.candidate(setpoint, 1, first, interval_);
      if (i % kEvery == kEvery - 1) verify(name, rig, released, candidate);
      for (std::uint64_t tick = 0; tick < interval_; ++tick) step(rig, tick == 0 ? released[0] : cable::Telecommand{});
      released[0] = Release::make(candidate.sequence(), first, first + interval_, 1, setpoint);
    }
  }

 private:
  void step(Rig& rig, const cable::Telecommand& telecommand) {
    image_.last_inputs = rig.drives.inputs(rig.now);
    rig.tick(Request::kNone, telecommand);
  }

  void verify(const std::string& name, const Rig& rig, std::span<const cable::Telecommand> released,
              const verification::Candidate<CableArm>& candidate) {
    image_.next_tick = rig.now;
    image_.controller = rig.controller;
    image_.last_outputs = rig.out;
    bool passed = false;
    meter_.once("verify", name, [&] {
      verification::Twin<CableArm>::run(image_, released, candidate, max_ticks_, prediction_);
      const verification::ExecutionVerdict execution =
          verification::judge_execution<CableArm>(robot_, candidate, prediction_);
      passed = execution.passed();
      text_ = execution.text;
      return execution.share;
    });
    simulate(name, rig, candidate);
    if (!passed) throw std::runtime_error("bench: a command of " + name + " is refused: " + text_);
  }

  void simulate(const std::string& name, const Rig& rig, const verification::Candidate<CableArm>& candidate) {
    start_.theta_rad = rig.out.theta_measured_rad;
    start_.rate_rad_s = rig.out.theta_rate_rad_s;
    start_.tension_N = rig.out.tension_measured_N;
    // Whether it passes is no matter here: the published pose in the slit touches it, and costs as much as others.
    meter_.once("simulate", name, [&] {
      verification::read_sequence(image_, candidate.first_tick(), prediction_, sequence_);
      return verification::judge_simulated(rules_, sequence_, prediction_.comes_to_rest,
                                           simulation_.run(start_, sequence_), too_near_)
          .share;
    });
  }

  // The plates of the slit, and the sphere before it.
  static config::SceneConfig slit() {
    config::SceneConfig scene;
    const Pose frame = panel_slit().frame_in_base;
    std::array<Vec3, 3> axes{};
    for (std::size_t i = 0; i < 3; ++i) {
      Vec3 axis{};
      axis[i] = 1.0;
      axes[i] = rotate(frame.quaternion, axis);
    }
    for (const double side : {1.0, -1.0}) {
      const Vec3 middle = add(scale(axes[0], 0.975), scale(axes[1], side * 0.06));
      scene.boxes.push_back({"plate", add(frame.position_m, middle), {0.975, 0.01, 2.0}, axes});
    }
    scene.spheres.push_back({"obstacle", {-0.15, 0.28, 1.10}, 0.25});
    return scene;
  }

  // The tip's acceleration and jerk as the shipped table has them.
  static RobotParams shipped() {
    RobotParams robot = zhu2022::table();
    robot.limits.tip_accel_m_s2 = 0.14;
    robot.limits.tip_jerk_m_s3 = 1.0;
    return robot;
  }

  Meter& meter_;
  RobotParams robot_ = shipped();
  std::uint64_t interval_ = static_cast<std::uint64_t>(robot_.interval_ticks);
  std::size_t max_ticks_ = verification::max_stop_ticks(robot_.tick_s);
  verification::TwinSnapshot<CableArm> image_;
  verification::IssueStep<CableArm> release_;
  verification::Prediction<CableArm> prediction_;
  config::SceneConfig scene_ = slit();
  verification::MotionRules rules_{robot_, scene_, {}, {}};
  simulation::Simulation simulation_{{robot_, 0.03, 0.4, 0.2}, scene_, verification::kEnough_m};
  simulation::StartState start_;
  verification::TooNear too_near_;
  simulation::JointSequence sequence_;
  std::string text_;
};

// The tip goes on by `way_m` each interval, at most as fast as `speed_m_s`.
Setpoint tip_along(const Rig& rig, const Vec3& way_m, double speed_m_s) {
  Setpoint setpoint = rig.tip_by({});
  setpoint.tip_in_base = rig.out.tip_goal;
  const double lead = rig.robot.limits.tip_speed_m_s / rig.robot.limits.tip_accel_m_s2 / 0.02;  // the filter's lag
  setpoint.tip_in_base.position_m = add(setpoint.tip_in_base.position_m, scale(way_m, 1.0 + lead));
  setpoint.tip_speed_m_s = speed_m_s;
  return setpoint;
}

Setpoint held_at_zero(Setpoint setpoint, std::uint32_t mask) {
  setpoint.held_mask = mask;
  return setpoint;
}

// A hand in free space, at full speed.
Setpoint free_tip(const Rig& rig, std::int32_t) { return tip_along(rig, {-0.0012, -0.0012, 0.0011}, 0.10); }

// VR: the tip and the arm's middle.
Setpoint tip_and_node(const Rig& rig, std::int32_t) {
  Setpoint setpoint = tip_along(rig, {-0.0009, -0.0009, 0.0}, 0.10);
  setpoint.node[0] = {3, add(rig.out.node_command_m[2], {0.0, 0.1, 0.1}), 1.0, 0.001};
  return setpoint;
}

// A hand in the slit: the last segment lies in its plane.
Setpoint in_slit(const Rig& rig, std::int32_t) { return held_at_zero(tip_along(rig, {0.0006, 0, 0}, 0.03), 0x100); }

// The tip stands, a pitch goes into the plane and the others make up for it.
Setpoint going_planar(const Rig& rig, std::int32_t) { return held_at_zero(tip_along(rig, {}, 0.10), 0x100); }

// A prepared motion in joint space.
Setpoint joints(const Rig& rig, std::int32_t interval) {
  const ThetaVector from = zhu2022::radians(zhu2022::kPrepare_deg), to = zhu2022::radians(zhu2022::kPanelEdge_deg);
  const double share = (interval + 1.0) / 3000.0;  // of a minute
  Setpoint setpoint = rig.joints(from);
  for (std::size_t k = 0; k < zhu2022::kThetas; ++k) setpoint.joint_rad[k] += share * (to[k] - from[k]);
  return setpoint;
}

// What is asked for stands, and only the shape goes on.
Setpoint standing(const Rig& rig, std::int32_t) { return tip_along(rig, {}, 0.10); }

}  // namespace
}  // namespace liana::bench

int main() try {
  using namespace liana::bench;
  using namespace liana::cable;
  Meter meter;
  Verifier verifier(meter);
  verifier.play("free_tip", zhu2022::kPrepare_deg, free_tip);
  verifier.play("tip_and_node", zhu2022::kPrepare_deg, tip_and_node);
  verifier.play("in_slit", kInSlit_deg, in_slit);
  verifier.play("going_planar", zhu2022::kPrepare_deg, going_planar);
  verifier.play("joints", zhu2022::kPrepare_deg, joints);
  verifier.play("standing", zhu2022::kPrepare_deg, standing);
  meter.print();
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
