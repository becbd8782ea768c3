// The torque traces of a payload's installation: what the joints' sensors read against what the arm asks of its drives.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/rounds.hpp"
#include "tests/serial/force_rig.hpp"

namespace liana::test {
namespace {

constexpr double kMean_s = 0.5;  // what a level is the mean over: a swing of the payload does not count for it

// Beside friction: what the drives' damping adds while told changes within kMean_s, and what swings on at rest.
constexpr double kLag_Nm = 8.0, kRest_Nm = 2.5;

using Torques = serial::JointVector;

double farthest(const Torques& a, const Torques& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::fabs(a[i] - b[i]));
  return most;
}

// Both traces as means over the newest kMean_s.
class Levels {
 public:
  void add(const serial::Outputs& now) {
    for (std::size_t i = 0; i < told_Nm.size(); ++i) {
      told_Nm[i] += kShare * (now.torque_told_Nm[i] - told_Nm[i]);
      read_Nm[i] += kShare * (now.torque_measured_Nm[i] - read_Nm[i]);
    }
  }
  Torques told_Nm{}, read_Nm{};

 private:
  static constexpr double kShare = 0.004 / kMean_s;  // a tick in kMean_s
};

// What is judged of one installation; torques as levels, differences those of the joint with the most.
struct Traces {
  double before_Nm = 0.0;   // read before the push
  double pressed_Nm = 0.0;  // the highest that was told
  double apart_Nm = 0.0;    // read against told, the most while it presses
  double back_Nm = 0.0;     // read after the capture against before the push
  bool captured = false;
};

Traces traces_of(ForceRig& rig) {
  Traces out;
  Levels levels;
  const auto run_s = [&](double seconds) {
    for (int i = 0; i < std::lround(seconds / rig.robot().table.tick_s); ++i) levels.add(rig.tick());
  };
  rig.enable();
  run_s(2.0);
  const Torques before = levels.read_Nm;
  out.before_Nm = farthest(before, {});
  rig.ask(rig.push(30.0));
  for (int i = 0; i < 5500 && !out.captured; ++i) {
    levels.add(rig.tick());
    out.captured = rig.out().push.end == serial::InsertResult::kCaptured;
    out.pressed_Nm = std::max(out.pressed_Nm, farthest(levels.told_Nm, {}));
    out.apart_Nm = std::max(out.apart_Nm, farthest(levels.read_Nm, levels.told_Nm));
  }
  run_s(5.0);
  out.back_Nm = farthest(levels.read_Nm, before);
  return out;
}

// What a joint's friction holds, no torque loop sees move: that much may be between told and read, and may stay.
// req:B31
TEST(TorqueTraces, ReadFollowsToldWhilePressingAndIsAfterTheCaptureWhatItWasBefore) {
  for (std::uint64_t seed = 201; seed <= 200 + rounds(std::uint64_t{12}); ++seed) {
    const ForceCase drawn = drawn_case(seed);
    ForceRig rig(drawn);
    const Traces found = traces_of(rig);
    std::printf(
        "seed %d: friction %.1f N m, before %.1f, told %.1f at most, read apart from it by %.1f, back to %.1f\n",
        static_cast<int>(seed), drawn.coulomb_Nm, found.before_Nm, found.pressed_Nm, found.apart_Nm, found.back_Nm);
    EXPECT_TRUE(found.captured) << seed;
    EXPECT_LT(found.before_Nm, 0.5) << seed;
    EXPECT_GT(found.pressed_Nm, 25.0) << seed;
    EXPECT_LT(found.apart_Nm, drawn.coulomb_Nm + kLag_Nm) << seed;
    EXPECT_LT(found.back_Nm, drawn.coulomb_Nm + kRest_Nm) << seed;
  }
}

}  // namespace
}  // namespace liana::test
