#include "free_ways.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "firmware_like/math/trig.hpp"
#include "fixture.hpp"

namespace liana::closed_loop {
namespace {

using cable::ThetaVector;
using Look = const ArmUnderControl::Observer&;

constexpr std::size_t kThetas = 10, kSegments = 5;
constexpr double kMost_rad = 19.0 * kDegree;

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}
  double within(double least, double most) {
    return least + (most - least) * (static_cast<double>(engine_() >> 11) * 0x1.0p-53);
  }
  Vec3 box(double half) { return {within(-half, half), within(-half, half), within(-half, half)}; }

 private:
  std::mt19937_64 engine_;
};

cable::Setpoint joints(const ThetaVector& theta_rad, CommandKind kind) {
  cable::Setpoint setpoint;
  setpoint.kind = kind;
  setpoint.joint_rad = theta_rad;
  return setpoint;
}

// Minimum jerk to `goal_rad`, of which `part` is gone.
void glide(ArmUnderControl& arm, const ThetaVector& goal_rad, double seconds, Look look, double part = 1.0,
           CommandKind kind = CommandKind::kJoint) {
  const ThetaVector from = arm.outputs().theta_command_rad;
  arm.follow(
      part * seconds,
      [&](double share) {
        ThetaVector at = from;
        for (std::size_t i = 0; i < kThetas; ++i)
          at[i] += minimum_jerk(part * share) * (std::clamp(goal_rad[i], -kMost_rad, kMost_rad) - from[i]);
        return joints(at, kind);
      },
      look);
}

void wait(ArmUnderControl& arm, double seconds, Look look) {
  for (double t = 0.0; t < seconds; t += arm.table().tick_s) {
    arm.step();
    if (look) look(arm);
  }
}

// As `liana calibrate --friction` does it, a little faster.
void one_segment_after_the_other(ArmUnderControl& arm, std::uint64_t, Look look) {
  const ThetaVector start = arm.outputs().theta_command_rad;
  for (std::size_t j = 0; j < kSegments; ++j) {
    for (const auto& [pitch, yaw] : {std::pair{3.0, 3.0}, {-3.0, -3.0}, {3.0, -3.0}, {0.0, 0.0}}) {
      ThetaVector goal = start;
      goal[2 * j] += pitch * kDegree;
      goal[2 * j + 1] += yaw * kDegree;
      glide(arm, goal, 7.0, look);
    }
  }
}

void one_angle(ArmUnderControl& arm, std::uint64_t seed, Look look) {
  Draw draw(seed);
  const ThetaVector start = arm.outputs().theta_command_rad;
  for (int i = 0; i < 8; ++i) {
    ThetaVector goal = start;
    const auto k = static_cast<std::size_t>(draw.within(0.0, 9.99));
    goal[k] += draw.within(-4.0, 4.0) * kDegree;
    glide(arm, goal, 9.0 + 4.0 * static_cast<double>(k < 4), look);
  }
}

void all_angles_and_some_stops(ArmUnderControl& arm, std::uint64_t seed, Look look) {
  Draw draw(seed);
  const ThetaVector start = arm.outputs().theta_command_rad;
  for (int i = 0; i < 5; ++i) {
    ThetaVector goal = start;
    for (double& angle : goal) angle += draw.within(-2.0, 2.0) * kDegree;
    glide(arm, goal, 16.0, look, i % 2 == 0 ? 1.0 : draw.within(0.3, 0.7));
    wait(arm, 2.0, look);  // nothing is asked any more: it brakes
  }
}

void swings_about_the_root(ArmUnderControl& arm, std::uint64_t, Look look) {
  const ThetaVector start = arm.outputs().theta_command_rad;
  for (int i = 0; i < 8; ++i) {
    ThetaVector goal = start;
    const double turn_rad = (i % 2 == 0 ? 1.5 : -1.5) * kDegree;
    goal[0] += turn_rad;
    goal[1] += i % 3 == 0 ? turn_rad : -turn_rad;
    glide(arm, goal, 7.0, look);
  }
  wait(arm, 4.0, look);
}

void tip_by_hand(ArmUnderControl& arm, std::uint64_t seed, Look look) {
  Draw draw(seed);
  const Pose at = arm.outputs().tip_command;
  for (int i = 0; i < 8; ++i) {
    cable::Setpoint setpoint;
    setpoint.kind = CommandKind::kTip;
    setpoint.tip_speed_m_s = i % 2 == 0 ? 0.05 : 0.03;
    setpoint.tip_in_base.position_m = add(at.position_m, draw.box(0.08));
    setpoint.tip_in_base.quaternion = normalize(multiply(quaternion_of(draw.box(0.03)), at.quaternion));
    arm.follow(
        draw.within(4.0, 8.0), [&](double) { return setpoint; }, look);
  }
}

void out_and_back_again(ArmUnderControl& arm, std::uint64_t seed, Look look) {
  Draw draw(seed);
  const ThetaVector start = arm.outputs().theta_command_rad;
  ThetaVector goal = start;
  for (double& angle : goal) angle += draw.within(-2.0, 2.0) * kDegree;
  glide(arm, goal, 24.0, look);
  glide(arm, start, 40.0, look, 1.0, CommandKind::kRetract);
}

}  // namespace

const std::vector<FreeWay>& free_ways() {
  static const std::vector<FreeWay> ways{{"segment after segment", one_segment_after_the_other},
                                         {"one angle", one_angle},
                                         {"all angles, with stops", all_angles_and_some_stops},
                                         {"swings about the root", swings_about_the_root},
                                         {"the tip by hand", tip_by_hand},
                                         {"out, and the way back", out_and_back_again}};
  return ways;
}

}  // namespace liana::closed_loop
