#include "hil/serial/true_arm.hpp"

#include "hil/config/start_angles.hpp"
#include "hil/math/random.hpp"

namespace liana::bench {

namespace {

constexpr double kRadPerDeg = 3.14159265358979323846 / 180.0;
constexpr double kZeroSpread_rad = 0.05 * kRadPerDeg;
constexpr double kLengthSpread_m = 0.5e-3;
constexpr double kGainSpread = 0.01;
constexpr double kStartSpread_rad = 0.5 * kRadPerDeg;

}  // namespace

TrueArm true_arm(const SerialRobotConfig& robot, const std::string& start_pose, bool spread, bool fixture,
                 std::uint64_t seed) {
  const std::size_t joints = robot.joints.size();
  TrueArm arm{robot, std::vector<double>(joints, 0.0), std::vector<double>(joints, 1.0),
              start_angles_rad(robot.named_poses_rad, joints, start_pose)};
  if (!spread) return arm;
  Random lengths(seed, "link lengths"), zeros(seed, "joint zeros"), gains(seed, "torque gains"),
      start(seed, "start pose");
  for (std::size_t i = 0; i < joints; ++i) {
    if (arm.robot.joints[i].a_m != 0.0) arm.robot.joints[i].a_m += lengths.uniform(-kLengthSpread_m, kLengthSpread_m);
    arm.robot.joints[i].d_m += lengths.uniform(-kLengthSpread_m, kLengthSpread_m);
    arm.zero_offset_rad[i] = zeros.uniform(-kZeroSpread_rad, kZeroSpread_rad);
    arm.torque_gain[i] = gains.uniform(1.0 - kGainSpread, 1.0 + kGainSpread);
    if (!fixture) arm.start_rad[i] += start.uniform(-kStartSpread_rad, kStartSpread_rad);
  }
  return arm;
}

}  // namespace liana::bench
