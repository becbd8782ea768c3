// What friction does to the estimate of a force at the tip, and what taking it off buys: the real core against the
// bench's arm. `--count` arms are pushed, at rest, after a dither, and on the move; each time the force is made of the
// torques without friction, with the signs of friction as planned, and as felt from measured angles, which is the
// core's.
#include <cmath>
#include <cstdio>
#include <random>
#include <stdexcept>
#include <vector>

#include "firmware_like/math/trig.hpp"
#include "tests/closed_loop/arm_under_control.hpp"
#include "tests/closed_loop/fixture.hpp"
#include "tests/numbers/options.hpp"

namespace liana::numbers {
namespace {

using cable::ThetaVector;
using closed_loop::ArmUnderControl;

constexpr std::size_t kThetas = 10, kCables = 15, kTip = 40;
constexpr double kRise_s = 1.5, kTurn_deg = 1.5;
constexpr double kDither = 0.3;
constexpr const char* kPoses[] = {"prepare", "panel_edge", "jig"};
constexpr double kSizes_N[] = {1.0, 2.0, 5.0};

// What the core keeps of the balance.
struct Kept {
  cable::TorqueBalance balance{};
  cable::TensionRatio planned{};
  template <class T>
  void operator()(const char*, const T& member) {
    if constexpr (std::is_same_v<T, cable::TorqueBalance>) balance = member;
    if constexpr (std::is_same_v<T, cable::TensionRatio>) planned = member;
  }
};

enum class Friction { kNone, kPlanned, kFelt };

// The force that the core would tell, had it taken friction off in this way.
Vec3 force_N(const ArmUnderControl& arm, Friction friction, bool moving) {
  Kept kept;
  arm.controller().arm().visit_state(kept);
  const cable::RobotParams& table = arm.table();
  const cable::ThetaVector& theta_rad = arm.outputs().theta_command_rad;
  const cable::SegmentVector wrap_rad = cable::cable_wraps(table, cable::arm_trig(table, theta_rad));
  cable::TorqueBalance balance = kept.balance;
  for (std::size_t k = 0; friction != Friction::kFelt && k < kThetas; ++k) {
    for (std::size_t c = k / 2 * 3; c < kCables; ++c) {
      const cable::SegmentVector& sigma = kept.balance.slip.sigma[c];
      double slid_rad = 0.5 * sigma[k / 2] * wrap_rad[k / 2];
      for (std::size_t j = 0; j < k / 2; ++j) slid_rad += sigma[j] * wrap_rad[j];
      const double ratio = friction == Friction::kNone ? 1.0 : kept.planned[c][k / 2];
      balance.torque_Nm[k] +=
          kept.balance.pull_Nm[k][c] * (ratio * std::exp(arm.outputs().friction.mu * slid_rad) - 1.0);
    }
  }
  cable::ContactDetectorState contact;
  watch_contact(table, cable::forward_kinematics(table, theta_rad), balance, {moving, false}, contact);
  return contact.force_N;
}

struct Sum {
  double square = 0.0;
  int count = 0;
  void add(const Vec3& error_N) { square += dot(error_N, error_N), ++count; }
  double rms() const { return count > 0 ? std::sqrt(square / count) : 0.0; }
};

struct Sums {
  Sum still[3], moving[3], dithered[3], free_moving[3];
};

class Trial {
 public:
  Trial(int number, Sums& sums)
      : pose_(kPoses[number % 3]),
        arm_({"nominal", static_cast<std::uint64_t>(number) + 1, true, pose_}),
        engine_(static_cast<std::uint64_t>(number)),
        sums_(sums) {
    Vec3 towards{within(1.0), within(1.0), within(1.0)};
    push_N_ = scale(towards, kSizes_N[number / 3 % 3] / norm(towards));
  }

  void run() {
    arm_.boot();
    arm_.move_joints(near_pose(), 16.0, [this](ArmUnderControl&) { pushed(0.0); });
    arm_.hold(3.0);
    time_s_ = 0.0;
    arm_.hold(4.5, [this](ArmUnderControl&) { pushed(time_s_ / kRise_s); });
    if (!tensions_valid()) return;
    read(sums_.still, push_N_, false);
    dither();
    if (!tensions_valid()) return;
    read(sums_.dithered, push_N_, false);
    time_s_ = 0.0;
    arm_.hold(4.0, [this](ArmUnderControl&) { pushed(1.0 - time_s_ / kRise_s); });
    time_s_ = 0.0;
    arm_.move_joints(near_pose(), 24.0, [this](ArmUnderControl&) { on_the_move(); });
  }

 private:
  double within(double half) { return half * (2.0 * (static_cast<double>(engine_() >> 11) * 0x1.0p-53) - 1.0); }
  // Nothing of the scene is touched, no fault has come.
  bool tensions_valid() {
    touches_ = touches_ || arm_.plant().take_load().contact_N > 0.0;
    return !touches_ && arm_.outputs().faults.count == 0;
  }

  ThetaVector near_pose() {
    ThetaVector goal = closed_loop::named_pose_rad(pose_);
    for (std::size_t i = 0; i < kThetas; ++i) goal[i] += within(kTurn_deg) * kDegree;
    return goal;
  }

  void pushed(double share) {
    time_s_ += arm_.table().tick_s;
    arm_.plant().push(kTip, scale(push_N_, std::fmin(1.0, std::fmax(0.0, share))));
  }

  void dither() {
    cable::Setpoint setpoint;
    setpoint.kind = CommandKind::kJoint;
    setpoint.joint_rad = arm_.outputs().theta_command_rad;
    const auto decaying = [&setpoint](double share) {
      setpoint.dither_share = kDither * (1.0 - share);
      return setpoint;
    };
    arm_.follow(4.0, decaying);
    arm_.hold(cable::kDitherSettle_s + 1.0);
  }

  void on_the_move() {
    constexpr double kBegin_s = 8.0, kRead_s = 12.5, kEnd_s = 14.0;
    const double before_s = time_s_;
    pushed(time_s_ < kEnd_s ? (time_s_ - kBegin_s) / kRise_s : 1.0 - (time_s_ - kEnd_s) / kRise_s);
    if (!tensions_valid()) return;
    if (before_s < kRead_s && time_s_ >= kRead_s) read(sums_.moving, push_N_, true);
    if (before_s < kBegin_s - 0.1 && time_s_ >= kBegin_s - 0.1) read(sums_.free_moving, {}, true);
  }

  void read(Sum (&sums)[3], const Vec3& true_N, bool moving) {
    for (const Friction friction : {Friction::kNone, Friction::kPlanned, Friction::kFelt})
      sums[static_cast<int>(friction)].add(subtract(force_N(arm_, friction, moving), true_N));
  }

  const char* pose_;
  ArmUnderControl arm_;
  std::mt19937_64 engine_;
  Sums& sums_;
  Vec3 push_N_{};
  double time_s_ = 0.0;
  bool touches_ = false;
};

void measure(int count) {
  Sums sums;
  int ended = 0;
  for (int i = 0; i < count; ++i) {
    try {
      Trial(i, sums).run();
    } catch (const std::runtime_error&) {
      ++ended;  // not enabled: its start pose leaves a cable slack
    }
  }
  const char* const names[] = {"none", "as planned", "as felt"};
  std::printf("{\"not_enabled\":%d,\"rows\":[", ended);
  for (int f = 0; f < 3; ++f)
    std::printf(R"(%s{"friction":"%s","still_N":%.3f,"moving_N":%.3f,"dithered_N":%.3f,"free_moving_N":%.3f,)"
                R"("still":%d,"moving":%d,"dithered":%d})",
                f > 0 ? ",\n " : "", names[f], sums.still[f].rms(), sums.moving[f].rms(), sums.dithered[f].rms(),
                sums.free_moving[f].rms(), sums.still[f].count, sums.moving[f].count, sums.dithered[f].count);
  std::printf("]}\n");
}

}  // namespace
}  // namespace liana::numbers

int main(int argc, char** argv) { liana::numbers::measure(liana::numbers::parse_options(argc, argv, 60).count); }
