// A puck that is pushed, as a hand that goes.
#include "host/spacemouse/puck.hpp"

#include <gtest/gtest.h>
#include <spnav.h>

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
  for (int i = 1; i <= 100; ++i) sample = puck.step(10000 * i, 0.01);
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
  for (int i = 1; i <= 2000; ++i) sample = puck.step(10000 * i, 0.01);
  EXPECT_EQ(sample.pose.position_m[1], -9.0);
}

}  // namespace
}  // namespace liana::spacemouse
