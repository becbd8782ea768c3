#include "tests/benchmarks/ticks.hpp"

#include <stdexcept>
#include <string>

#include "tests/firmware_like/ideal_drives.hpp"

namespace liana::bench {

using namespace cable;
namespace {

constexpr std::int32_t kPhaseTicks = 100;
constexpr std::int32_t kEnablingTicks = 1000;  // more than the drives and the pretension take

void require(bool holds, const std::string& phase) {
  if (!holds) throw std::runtime_error("bench: the ticks of phase " + phase + " are not what its name says");
}

// One rig whose ticks are counted under the name of a phase.
class Phase {
 public:
  Phase(Meter& meter, std::string name, const Rig& start) : rig(start), meter_(meter), name_(std::move(name)) {}

  void tick(const cable::Telecommand& telecommand = {}) {
    cable::Inputs inputs = rig.drives.inputs(rig.now++);
    inputs.telecommand = telecommand;
    meter_.once("tick", name_, [&] {
      rig.out = rig.controller.tick(inputs);
      return rig.out.tip_speed_m_s;
    });
    rig.drives.act(rig.out);
    limits_seen |= rig.out.limits;
  }
  void ticks(std::int32_t count = kPhaseTicks) {
    for (std::int32_t i = 0; i < count; ++i) tick();
  }
  // Carries out a setpoint, every tick counted.
  void follow(const cable::Setpoint& setpoint) {
    tick(rig.release(setpoint));
    ticks(kPhaseTicks - 1);
  }
  void expect(bool holds) const { require(holds, name_); }

  Rig rig;
  std::uint32_t limits_seen = 0;

 private:
  Meter& meter_;
  std::string name_;
};

Rig enabled_at(const cable::ThetaVector& theta) {
  Rig rig(theta);
  rig.run(60);
  rig.tick(Request::kEnable);
  rig.run(kEnablingTicks);
  require(rig.out.state == OperatingState::kEnabled, "enabled");
  return rig;
}

// The operator's hand moves on with every command interval.
void moving_tip(Meter& meter, const Rig& enabled) {
  Phase phase(meter, "moving_tip", enabled);
  cable::Setpoint setpoint = phase.rig.tip_by({0.0, 0.0, 0.0});
  for (std::int32_t i = 0; i < kPhaseTicks; ++i) {
    Vec3& position = setpoint.tip_in_base.position_m;
    position = add(position, {0.0001, 0.00006, -0.00004});
    phase.tick(i % phase.rig.robot.interval_ticks == 0 ? phase.rig.release(setpoint) : cable::Telecommand{});
  }
  phase.expect(phase.rig.out.tip_speed_m_s > 0.01);
}

// Tip and shape: the end of segment 3 is drawn aside, the middle keeps clear of two points, the last segment is held.
void moving_shape(Meter& meter, const Rig& enabled) {
  Phase phase(meter, "moving_shape", enabled);
  cable::Setpoint setpoint = phase.rig.tip_by({0.02, 0.0, 0.01});
  setpoint.node[0] = {3, add(phase.rig.out.node_command_m[2], {0.0, 0.03, 0.03}), 1.0, 0.001};
  for (const std::size_t i : {0u, 1u})
    setpoint.clear[i] = {add(phase.rig.out.node_command_m[i + 1], {0.0, 0.0, 0.1}), 0.3, 1.0};
  setpoint.held_mask = 0x300;
  setpoint.held_rad = phase.rig.out.theta_command_rad;
  phase.follow(setpoint);
  phase.expect(phase.rig.out.held_mask == 0x300);
}

void holding(Meter& meter, const Rig& enabled) {
  Phase phase(meter, "holding", enabled);
  phase.follow(phase.rig.tip_by({0.0, 0.0, 0.0}));
  phase.expect(phase.rig.out.tip_speed_m_s < 1e-3);
}

void joint_motion(Meter& meter, const Rig& enabled) {
  Phase phase(meter, "joint_motion", enabled);
  phase.follow(phase.rig.joints(cable::ThetaVector{}));
  phase.expect(phase.rig.out.tip_speed_m_s > 0.01);
}

// From the straight pose to the side and outwards, where no theta moves the tip along the arm.
void straight_arm(Meter& meter) {
  Phase phase(meter, "straight_arm", enabled_at(cable::ThetaVector{}));
  phase.follow(phase.rig.tip_by({0.05, 0.05, 0.0}));
  phase.expect(phase.rig.out.lost_share < 0.9 && phase.rig.out.tip_speed_m_s > 1e-3);
}

// Rolled up as far as two segments allow, and asked for more.
void at_limits(Meter& meter) {
  cable::ThetaVector rolled = zhu2022::radians(zhu2022::kPrepare_deg);
  for (const std::size_t k : {6u, 8u}) rolled[k] = zhu2022::table().segment[k / 2].theta_limit_rad;
  Phase phase(meter, "at_limits", enabled_at(rolled));
  cable::Setpoint setpoint = phase.rig.tip_by({0.0, 0.0, 0.0});
  setpoint.tip_in_base.quaternion = multiply(setpoint.tip_in_base.quaternion, quaternion_of({0.0, 0.0, 1.0}));
  phase.follow(setpoint);
  phase.expect((phase.limits_seen & kLimitTheta) != 0);
}

// A telecommand that ends while the arm moves.
void braking(Meter& meter, const Rig& enabled) {
  Phase phase(meter, "braking", enabled);
  phase.rig.tick(Request::kNone, phase.rig.release(phase.rig.tip_by({-0.1, -0.1, 0.0}), kPhaseTicks));
  phase.rig.run(kPhaseTicks - 1);
  phase.ticks();
  phase.expect((phase.limits_seen & kLimitExpired) != 0);
}

void fault(Meter& meter, const Rig& enabled) {
  Phase phase(meter, "fault", enabled);
  for (std::int32_t i = 0; i < kPhaseTicks; ++i) {
    phase.rig.drives.silence(4);
    phase.tick();
  }
  phase.expect(phase.rig.out.faults.count > 0);
}

// Counts the phases before motion; returns the enabled rig.
Rig enabling(Meter& meter) {
  Phase disabled(meter, "disabled", Rig{});
  disabled.ticks();
  Phase phase(meter, "enabling", disabled.rig);
  phase.rig.tick(Request::kEnable);
  phase.ticks();
  phase.expect(phase.rig.out.state == OperatingState::kEnabling);
  phase.rig.run(kEnablingTicks);
  phase.expect(phase.rig.out.state == OperatingState::kEnabled);
  return phase.rig;
}

}  // namespace

void measure_ticks(Meter& meter) {
  const Rig enabled = enabling(meter);
  for (const auto& measure : {moving_tip, moving_shape, holding, joint_motion, braking, fault}) measure(meter, enabled);
  straight_arm(meter);
  at_limits(meter);
}

}  // namespace liana::bench
