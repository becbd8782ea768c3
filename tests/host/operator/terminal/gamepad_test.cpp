#include "host/operator/terminal/gamepad.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/joystick.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <random>
#include <stdexcept>
#include <string>
#include "tests/message.hpp"

namespace liana::terminal {
namespace {

constexpr std::uint8_t kShoulder = 5, kStop = 1, kY = 3;
constexpr std::int16_t kFull = 32767;

void press(Sticks& sticks, std::uint8_t button) { sticks.take(JS_EVENT_BUTTON, button, 1); }
void let_go(Sticks& sticks, std::uint8_t button) { sticks.take(JS_EVENT_BUTTON, button, 0); }
void lean(Sticks& sticks, std::uint8_t axis, double share) {
  sticks.take(JS_EVENT_AXIS, axis, static_cast<std::int16_t>(share * kFull));
}

}  // namespace

// req:A27
TEST(Gamepad, MovesOnlyWhileTheShoulderButtonIsHeldThatWasPressedSinceItWasOpened) {
  Sticks sticks;
  sticks.take(JS_EVENT_BUTTON | JS_EVENT_INIT, kShoulder, 1);
  EXPECT_FALSE(sticks.is_held()) << "it was held when the gamepad was opened";
  press(sticks, kShoulder);
  EXPECT_TRUE(sticks.is_held());
  press(sticks, kY);
  EXPECT_TRUE(sticks.is_held()) << "other axes are no end of a motion";
  const auto keys = sticks.take(JS_EVENT_BUTTON, kStop, 1);
  ASSERT_EQ(keys.size(), 1U);
  EXPECT_EQ(keys[0].deed, Deed::kStop);
  EXPECT_FALSE(sticks.is_held()) << "a stick that still leans does not undo a stop";
  let_go(sticks, kStop);
  EXPECT_FALSE(sticks.is_held());
  press(sticks, kShoulder);
  EXPECT_TRUE(sticks.is_held());
  let_go(sticks, kShoulder);
  EXPECT_FALSE(sticks.is_held());
}

TEST(Gamepad, SticksLeanFromTheirDeadZoneToOneAndPointWhereThePersonPushesThem) {
  Sticks sticks;
  lean(sticks, 1, 0.14);
  EXPECT_EQ(sticks.direction().way, (Vec3{0.0, 0.0, 0.0}));
  lean(sticks, 1, -1.0);
  lean(sticks, 0, -0.575);
  lean(sticks, 4, -1.0);
  lean(sticks, 3, 1.0);
  const Direction direction = sticks.direction();
  EXPECT_NEAR(direction.way[0], 1.0, 1e-9) << "away from the person";
  EXPECT_NEAR(direction.way[1], 0.5, 1e-4) << "left";
  EXPECT_NEAR(direction.way[2], 1.0, 1e-9) << "up";
  EXPECT_NEAR(direction.turn[2], -1.0, 1e-9) << "to the right";
  sticks.take(JS_EVENT_AXIS, 1, -32768);
  EXPECT_EQ(sticks.direction().way[0], 1.0);
}

TEST(Gamepad, WhateverComesMovesNothingByMoreThanOne) {
  std::mt19937 random(3);
  Sticks sticks;
  for (int i = 0; i < 10000; ++i) {
    const std::uint64_t bits = random();
    sticks.take(static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8),
                static_cast<std::int16_t>(bits >> 16));
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_LE(std::abs(sticks.direction().way[k]), 1.0);
      ASSERT_LE(std::abs(sticks.direction().turn[k]), 1.0);
    }
  }
}

TEST(Gamepad, OneThatSaysNothingOrIsUnpluggedHoldsNothing) {
  const std::string file = testing::TempDir() + "liana-pad-" + std::to_string(getpid());
  ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
  const int other_end = open(file.c_str(), O_RDWR | O_CLOEXEC);
  Gamepad gamepad(file);
  EXPECT_TRUE(gamepad.read(0.0).empty());
  EXPECT_FALSE(gamepad.is_gone());
  const js_event events[]{
      {0, 1, JS_EVENT_BUTTON, kShoulder}, {0, 1, JS_EVENT_BUTTON, kY}, {0, kFull, JS_EVENT_AXIS, 1}};
  ASSERT_EQ(write(other_end, events, sizeof events), static_cast<ssize_t>(sizeof events));
  EXPECT_EQ(gamepad.read(0.0).size(), 1U);
  EXPECT_TRUE(gamepad.is_held());
  EXPECT_TRUE(gamepad.read(Gamepad::kSilent_s - 0.1).empty());
  EXPECT_TRUE(gamepad.is_held() && !gamepad.take_silence());
  EXPECT_TRUE(gamepad.read(Gamepad::kSilent_s + 0.1).empty());
  EXPECT_FALSE(gamepad.is_held()) << "out of reach, it would say nothing either";
  EXPECT_TRUE(gamepad.take_silence() && !gamepad.take_silence());
  ASSERT_EQ(write(other_end, events, sizeof events), static_cast<ssize_t>(sizeof events));
  EXPECT_EQ(gamepad.read(Gamepad::kSilent_s + 0.2).size(), 1U);
  EXPECT_TRUE(gamepad.is_held());
  close(other_end);
  EXPECT_TRUE(gamepad.read(0.0).empty());
  EXPECT_TRUE(gamepad.is_gone());
  EXPECT_FALSE(gamepad.is_held());
  std::filesystem::remove(file);
}

TEST(Gamepad, AFileThatIsNoneIsRefusedWithWhatToGive) {
  for (const char* file : {"/nonexistent/js0", "/"}) {
    try {
      Gamepad gamepad(file);
      FAIL() << file;
    } catch (const std::runtime_error& error) {
      EXPECT_TRUE(names(error.what(), {"joystick", "/dev/input/js0"}));
    }
  }
}

}  // namespace liana::terminal
