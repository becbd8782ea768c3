// Images of a serial arm's Controller: written and read by fields, checked, never as memory.
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <limits>
#include <new>
#include <random>
#include <stdexcept>

#include "host/storage/recording/serialise.hpp"
#include "tests/firmware_like/serial_rig.hpp"
#include "tests/firmware_like/zhu2022.hpp"
#include "tests/host/storage/recording/field_finder.hpp"
#include "tests/message.hpp"
#include "tests/rounds.hpp"

namespace liana::recording {
namespace {

using serial::SerialArm;

std::string outputs_of(const serial::Outputs& outputs) {
  std::string bytes;
  append_serialised(bytes, outputs);
  return bytes;
}

// An arm on a straight line, `ticks` after it was told to go.
serial::micro::Rig moving_serial_rig(std::int32_t ticks) {
  serial::micro::Rig rig;
  rig.enable();
  rig.tick(Request::kNone, rig.release(rig.tip_by({0.03, 0.02, -0.01})));
  rig.run(ticks);
  return rig;
}

// What is said about an image; empty when it is taken.
std::string refusal_of(const std::string& state, const serial::RobotParams& table) {
  try {
    controller_from<SerialArm>(state, table, "snapshots.mcap");
  } catch (const std::runtime_error& refused) {
    return refused.what();
  }
  return "";
}

TEST(SerialImage, AReplayFromTheMiddleGivesTheBitsOfOneFromTheStart) {
  for (const std::int32_t ticks : {1, 17, 160, 700}) {
    serial::micro::Rig whole = moving_serial_rig(ticks);
    serial::micro::Rig middle = whole;
    std::memset(static_cast<void*>(&middle.controller), 0x55, sizeof middle.controller);
    middle.controller = controller_from<SerialArm>(state_of(whole.controller), whole.robot, "test");
    for (int i = 0; i < 400; ++i) {
      if (i == 200) whole.drive[3].statusword = middle.drive[3].statusword = 0x0218;  // a fault
      ASSERT_EQ(outputs_of(whole.tick()), outputs_of(middle.tick())) << "tick " << i << " after " << ticks;
    }
    EXPECT_NE(whole.out.faults.count, 0);
    EXPECT_EQ(state_of(whole.controller), state_of(middle.controller));
  }
}

TEST(SerialImage, TwoControllersInDifferentMemoryGiveTheSameBytes) {
  const auto run_in = [](int rubbish) {
    alignas(serial::Controller) std::array<unsigned char, sizeof(serial::Controller)> memory;
    memory.fill(static_cast<unsigned char>(rubbish));
    auto* controller = new (memory.data()) serial::Controller(serial::micro::table());
    for (std::uint64_t tick = 0; tick < 30; ++tick) {
      serial::Inputs inputs;
      inputs.tick = tick;
      controller->tick(inputs);
    }
    return state_of(*controller);
  };
  EXPECT_EQ(run_in(0x00), run_in(0xA5));
}

TEST(SerialImage, OneThatIsCutShortOrTooLongIsRefusedWithTheField) {
  const serial::micro::Rig rig = moving_serial_rig(50);
  const std::string good = state_of(rig.controller);
  EXPECT_EQ(refusal_of(good, rig.robot), "");
  for (std::size_t length = 0; length < good.size(); ++length)
    ASSERT_NE(refusal_of(good.substr(0, length), rig.robot), "") << length;
  EXPECT_TRUE(names(refusal_of(good.substr(0, 4), rig.robot),
                    {"snapshots.mcap", "controller.arm.joints.reading[0].joint_rad"}));
  EXPECT_TRUE(names(refusal_of(good + "x", rig.robot), {"1 more"}));
}

TEST(SerialImage, WhatWouldLeadTheCoreOutOfItsArraysIsRefusedAndNamed) {
  const serial::micro::Rig rig = moving_serial_rig(50);
  const auto expect_refused = [&](const std::string& field, auto value, Facts facts) {
    const std::string said = refusal_of(with_field(rig.controller, field, value), rig.robot);
    facts.push_back("controller." + field);
    EXPECT_TRUE(names(said, facts));
  };
  expect_refused("faults.count", std::int32_t{17}, {"0..16"});
  expect_refused("faults.fault[2].number", std::uint16_t{77}, {"meaning"});
  expect_refused("faults.fault[2].index", std::int16_t{32}, {"-1..31"});
  expect_refused("supervisor.phase", std::uint8_t{11}, {"meaning"});
  expect_refused("active.setpoint.kind", std::uint8_t{8}, {"meaning"});
  expect_refused("arm.joints.reading[6].heard", std::uint8_t{2}, {"0..1"});
  expect_refused("arm.joints.reading[6].jumped", std::uint8_t{255}, {"0..1"});
  expect_refused("arm.joints.reading[0].joint_rad", 1001.0, {"finite", "1000"});
  expect_refused("arm.motion.braking", std::uint8_t{2}, {"0..1"});
  expect_refused("arm.motion.interval_tick", std::int32_t{-2}, {"0..5"});
  expect_refused("arm.motion.interval_tick", std::int32_t{6}, {"0..5"});
  expect_refused("arm.motion.ik.outcome", std::uint8_t{9}, {"meaning"});
  expect_refused("arm.motion.ik.limit_mask", std::uint32_t{1u << 7}, {"0..127"});
  expect_refused("arm.motion.limiter.joint_rad[4]", -1001.0, {"finite", "1000"});
  expect_refused("arm.motion.arm.tip_jacobian.linear[0][1]", std::numeric_limits<double>::infinity(), {"finite"});
}

TEST(SerialImage, ATableThatWouldLeadTheCoreOutOfItsArraysIsRefused) {
  const auto said = [](auto change) -> std::string {
    serial::RobotParams table = serial::micro::table();
    change(table);
    std::string bytes;
    append_serialised(bytes, table);
    std::size_t used = 0;
    try {
      checked_table<serial::RobotParams>(bytes, "snapshots.mcap", used);
    } catch (const std::runtime_error& refused) {
      return refused.what();
    }
    return "";
  };
  EXPECT_EQ(said([](serial::RobotParams&) {}), "");
  EXPECT_NE(said([](serial::RobotParams& t) { t.joint_count = 9; }).find("joint_count: 9"), std::string::npos);
  EXPECT_NE(said([](serial::RobotParams& t) { t.joint_count = 5; }).find("allowed is 6..8"), std::string::npos);
  EXPECT_NE(said([](serial::RobotParams& t) { t.interval_ticks = 0; }), "");
  EXPECT_NE(said([](serial::RobotParams& t) { t.tick_s = -0.0; }), "");
  EXPECT_NE(said([](serial::RobotParams& t) { t.joint[2].dh.alpha_rad = 2000.0; }), "");
}

TEST(SerialImage, AnImageOfACableArmIsRefused) {
  const serial::micro::Rig rig = moving_serial_rig(1);
  EXPECT_NE(refusal_of(state_of(cable::Controller(cable::zhu2022::table())), rig.robot), "");
}

// Thousands of images nobody wrote: the core lives through every one that is taken.
TEST(SerialImage, AnImageWithFlippedBytesIsRefusedOrHarmless) {
  const serial::micro::Rig rig = moving_serial_rig(90);
  const std::string good = state_of(rig.controller);
  std::mt19937 draw(7);
  int taken = 0;
  for (int i = 0; i < rounds(1000); ++i) {
    std::string bad = good;
    for (int flips = 1 + i % 3; flips > 0; --flips) {
      char& byte = bad[draw() % bad.size()];
      byte = static_cast<char>(byte ^ (1 << draw() % 8));
    }
    if (!refusal_of(bad, rig.robot).empty()) continue;
    ++taken;
    serial::micro::Rig other = rig;
    other.controller = controller_from<SerialArm>(bad, rig.robot, "snapshots.mcap");
    other.run(4);
  }
  EXPECT_GT(taken, rounds(20));
  EXPECT_LT(taken, rounds(1000));
}

}  // namespace
}  // namespace liana::recording
