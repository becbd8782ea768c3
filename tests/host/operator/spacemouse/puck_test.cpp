// A puck that is pushed, as a hand that goes.
#include "host/operator/spacemouse/puck.hpp"

#include <gtest/gtest.h>
#include <spnav.h>

#include <functional>

namespace liana::spacemouse {
namespace {

// The library's own idea of which way an object goes, in a frame with x right, y up, z to the person.
TEST(Puck, GoesAndTurnsTheWayTheLibraryMovesAnObject) {
  const PuckTable table{.dead = 0};
  for (int axis = 0; axis < 6; ++axis) {
    Deflection deflection{};
    deflection[static_cast<std::size_t>(axis)] = 100;
    spnav_event_motion motion{};
    motion.x = deflection[0], motion.y = deflection[1], motion.z = deflection[2];
    motion.rx = deflection[3], motion.ry = deflection[4], motion.rz = deflection[5];
    spnav_posrot moved;
    spnav_posrot_init(&moved);
    spnav_posrot_moveobj(&moved, &motion);
    const Vec3 ahead{-moved.pos[2], -moved.pos[0], moved.pos[1]};
    const Vec3 turned{-moved.rot[2], -moved.rot[0], moved.rot[1]};
    const device::Twist twist = twist_of(table, deflection);
    EXPECT_NEAR(dot(ahead, twist.linear_m_s), norm(ahead) * norm(twist.linear_m_s), 1e-9) << axis;
    EXPECT_NEAR(dot(turned, twist.angular_rad_s), norm(turned) * norm(twist.angular_rad_s), 1e-9) << axis;
    EXPECT_GT(norm(twist.linear_m_s) + norm(twist.angular_rad_s), 0.01);
  }
}

TEST(Puck, GoesAsFastAsItIsPushedBeyondItsRest) {
  const PuckTable table;
  EXPECT_EQ(norm(twist_of(table, {0, 0, 20, 0, 0, 0}).linear_m_s), 0.0);
  EXPECT_NEAR(twist_of(table, {0, 0, 185, 0, 0, 0}).linear_m_s[0], 0.025, 1e-12);
  EXPECT_NEAR(twist_of(table, {0, 0, 350, 0, 0, 0}).linear_m_s[0], 0.05, 1e-12);
  EXPECT_NEAR(twist_of(table, {0, 0, 9000, 0, 0, 0}).linear_m_s[0], 0.05, 1e-12) << "no puck goes so far";
}

TEST(Puck, IsItsOwnDeadmanWhileItIsMoved) {
  Puck puck(PuckTable{});
  EXPECT_FALSE(puck.step(0, 0.01).deadman);
  puck.push({0, 0, 350, 0, 0, 0});
  device::Sample sample;
  for (int i = 1; i <= 100; ++i) {
    puck.push({0, 0, 350, i % 3, 0, 0});
    sample = puck.step(10000 * i, 0.01);
  }
  EXPECT_TRUE(sample.deadman);
  EXPECT_NEAR(sample.pose.position_m[0], 0.05, 1e-9);
  puck.push({});
  for (int i = 1; i <= 15; ++i) EXPECT_TRUE(puck.step(1'000'000 + 10000 * i, 0.01).deadman) << i;
  sample = puck.step(1'200'000, 0.01);
  EXPECT_FALSE(sample.deadman);
  EXPECT_EQ(sample.pose.position_m, Vec3{}) << "begins anew";
}

TEST(Puck, FollowsItsButtonWhereOneIsTheDeadman) {
  Puck puck(PuckTable{.button = 1});
  puck.push({0, 0, 350, 0, 0, 0});
  EXPECT_FALSE(puck.step(0, 0.01).deadman);
  puck.press(1, true);
  puck.press(99, true);
  const device::Sample sample = puck.step(10000, 0.01);
  EXPECT_TRUE(sample.deadman);
  EXPECT_EQ(sample.buttons, 2u);
  EXPECT_NEAR(sample.pose.position_m[0], 0.0005, 1e-12);
  puck.press(1, false);
  EXPECT_FALSE(puck.step(20000, 0.01).deadman);
}

TEST(Puck, StaysInTheRoomOfADevice) {
  Puck puck(PuckTable{.speed_m_s = 1.0});
  puck.push({350, 0, 0, 0, 0, 0});
  device::Sample sample;
  for (int i = 1; i <= 2000; ++i) {
    puck.push({350, i % 2, 0, 0, 0, 0});
    sample = puck.step(10000 * i, 0.01);
  }
  EXPECT_EQ(sample.pose.position_m[1], -9.0);
}

// A puck, and what happens to it in the steps from now on; the first step whose sample does not lead any more, 0: none.
int steps_until_stale(Puck& puck, const std::function<void(Puck&, int)>& happens) {
  for (int i = 1; i <= 300; ++i) {
    happens(puck, i);
    const device::Sample sample = puck.step(3'000'000 + 10'000 * i, 0.01);
    EXPECT_EQ(sample.stale, !sample.deadman);
    if (!sample.deadman) {
      EXPECT_EQ(norm(sample.twist.linear_m_s), 0.0);
      return i;
    }
  }
  return 0;
}

void lead(Puck& puck) {
  for (int i = 1; i <= 100; ++i) {
    puck.push({0, 0, 250 + i % 7, 0, i % 3, 0});
    puck.step(10'000 * i, 0.01);
  }
}

// Asleep, out of reach, unplugged, repeated by spacenavd: with the puck or a button as its deadman.
// req:A12
TEST(Puck, ThatIsPushedAndSaysNothingNewHasLetGoWithinATenthOfASecond) {
  using Happens = std::function<void(Puck&, int)>;
  const Happens silent = [](Puck&, int) {}, unplugged = [](Puck&puck, int) { puck.lose(); };
  const Happens repeated = [](Puck& puck, int) { puck.push({0, 0, 252, 0, 1, 0}); };
  const Happens slow = [](Puck& puck, int i) {
    if (i % 25 == 0) puck.push({0, 0, 252, 0, 1, 0});
  };
  for (const int button : {-1, 1}) {
    for (const Happens& happens : {silent, repeated, slow, unplugged}) {
      Puck puck(PuckTable{.button = button});
      puck.press(1, true);
      lead(puck);
      const int steps = steps_until_stale(puck, happens);
      EXPECT_TRUE(steps >= 1 && steps <= 8) << steps;
    }
  }
}

TEST(Puck, ThatIsPushedToItsEndAtOnceMayRepeatItselfForASecond) {
  Puck puck(PuckTable{});
  const int steps = steps_until_stale(puck, [](Puck& each, int) { each.push({0, 350, 0, 0, 0, 0}); });
  EXPECT_NEAR(steps, 100, 2);
}

TEST(Puck, ThatComesBackLeadsAfterItWasLetGo) {
  Puck puck(PuckTable{});
  lead(puck);
  EXPECT_GT(steps_until_stale(puck, [](Puck&, int) {}), 0);
  for (int i = 1; i <= 50; ++i) {
    puck.push({0, 0, 250 + i, 0, 0, 0});
    EXPECT_FALSE(puck.step(9'000'000 + 10'000 * i, 0.01).deadman) << "still pushed";
  }
  puck.push({});
  EXPECT_FALSE(puck.step(9'900'000, 0.01).stale);
  puck.push({0, 0, 250, 0, 0, 0});
  EXPECT_TRUE(puck.step(9'910'000, 0.01).deadman);
}

TEST(Puck, AtRestMayBeSilentForEver) {
  Puck puck(PuckTable{.button = 0});
  puck.press(0, true);
  EXPECT_EQ(steps_until_stale(puck, [](Puck&, int) {}), 0);
}

}  // namespace
}  // namespace liana::spacemouse
