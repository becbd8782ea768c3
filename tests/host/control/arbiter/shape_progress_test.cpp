// When a shape counts as arrived.
#include "host/control/arbiter/shape_progress.hpp"

#include <gtest/gtest.h>

#include "firmware_like/cable/arm/kinematics.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::arbiter {

using namespace cable;
namespace {

class Progress : public testing::Test {
 protected:
  // Intervals with node 3 of the straight arm at `distance_m` from its target, falling by `per_interval_m`.
  void pass(std::int32_t intervals, double distance_m, double per_interval_m = 0.0) {
    for (std::int32_t i = 0; i < intervals; ++i) {
      NodeTargets target{};
      target[0] = {3, add(node_m_, {0.0, distance_m - i * per_interval_m, 0.0}), 2.0, 0.01};
      progress_.note(now_, target, {});
    }
  }

  RobotParams table_ = zhu2022::table();
  std::int32_t window_ = static_cast<std::int32_t>(kShapeSettled_s / (table_.tick_s * table_.interval_ticks)) + 1;
  ShapeProgress progress_{table_};
  Vec3 node_m_ = forward_kinematics(table_, ThetaVector{}).node_in_base[3].position_m;
  cable::Outputs now_{};
};

TEST_F(Progress, NothingAskedForIsSettled) {
  progress_.note(now_, {}, {});
  EXPECT_EQ(progress_.missing_m(), 0.0);
  EXPECT_TRUE(progress_.is_settled());
}

TEST_F(Progress, WithinTheThresholdNothingIsMissingAndTheShapeHasArrivedAtOnce) {
  pass(1, 0.009);
  EXPECT_EQ(progress_.missing_m(), 0.0);
  EXPECT_TRUE(progress_.is_settled());
}

TEST_F(Progress, AShapeThatComesNearerHasNotSettledAndOneThatStaysHas) {
  pass(2 * window_, 0.5, 1e-5);
  EXPECT_NEAR(progress_.missing_m(), 0.5 - (2 * window_ - 1) * 1e-5 - 0.01, 1e-12);
  EXPECT_FALSE(progress_.is_settled());
  pass(window_ - 2, 0.3);
  EXPECT_FALSE(progress_.is_settled());
  pass(2, 0.3);
  EXPECT_TRUE(progress_.is_settled());
  EXPECT_NEAR(progress_.missing_m(), 0.29, 1e-12);
}

TEST_F(Progress, NewTargetsStartAnew) {
  pass(2 * window_, 0.3);
  ASSERT_TRUE(progress_.is_settled());
  progress_.restart();
  pass(1, 0.3);
  EXPECT_FALSE(progress_.is_settled());
}

TEST_F(Progress, APointToKeepClearOfCountsWithWhatIsMissing) {
  KeepClearTargets clear{};
  clear[0] = {{1.0, 0.0, 0.0}, 0.2, 1.0};
  progress_.note(now_, {}, clear);  // the straight arm passes through the point
  EXPECT_GE(progress_.missing_m(), 0.2);
  EXPECT_FALSE(progress_.is_settled());
}

}  // namespace
}  // namespace liana::arbiter
