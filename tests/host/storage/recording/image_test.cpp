// Images of a Controller: written and read by fields, checked, never as memory.
#include "host/storage/recording/image.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <new>
#include <random>

#include "host/storage/recording/serialise.hpp"
#include "tests/firmware_like/ideal_drives.hpp"
#include "tests/host/storage/recording/field_finder.hpp"
#include "tests/message.hpp"
#include "tests/rounds.hpp"

namespace liana::recording {
namespace {

std::string outputs_of(const cable::Outputs& outputs) {
  std::string bytes;
  append_serialised(bytes, outputs);
  return bytes;
}

// An arm on its way with everything in use: node targets, points to keep clear of, a held theta.
cable::Rig moving_rig(std::int32_t ticks) {
  cable::Rig rig;
  rig.enable();
  cable::Setpoint goal = rig.tip_by({0.0, 0.02, 0.03});
  goal.node[0] = {3, {0.9, 0.05, 0.1}, 1.0, 0.0};
  goal.clear[0] = {{0.6, 0.2, 0.0}, 0.3, 1.0};
  goal.held_mask = 1;
  goal.held_rad[0] = rig.out.theta_command_rad[0] + 0.01;
  rig.tick(Request::kNone, rig.release(goal));
  rig.run(ticks);
  return rig;
}

TEST(Image, AReplayFromTheMiddleGivesTheBitsOfOneFromTheStart) {
  for (const std::int32_t ticks : {1, 17, 160, 700}) {
    cable::Rig whole = moving_rig(ticks);
    cable::Rig middle = whole;
    std::memset(static_cast<void*>(&middle.controller), 0x55, sizeof middle.controller);
    middle.controller = controller_from<cable::CableArm>(state_of(whole.controller), whole.robot, "test");
    for (int i = 0; i < 400; ++i) {
      if (i == 200) whole.drives.silence(3), middle.drives.silence(3);
      ASSERT_EQ(outputs_of(whole.tick()), outputs_of(middle.tick())) << "tick " << i << " after " << ticks;
    }
    EXPECT_EQ(state_of(whole.controller), state_of(middle.controller));
  }
}

TEST(Image, TwoControllersInDifferentMemoryGiveTheSameBytes) {
  const auto run_in = [](int rubbish) {
    alignas(cable::Controller) std::array<unsigned char, sizeof(cable::Controller)> memory;
    memory.fill(static_cast<unsigned char>(rubbish));
    auto* controller = new (memory.data()) cable::Controller(cable::zhu2022::table());
    for (std::uint64_t tick = 0; tick < 30; ++tick) {
      cable::Inputs inputs;
      inputs.tick = tick;
      controller->tick(inputs);
    }
    return state_of(*controller);
  };
  EXPECT_EQ(run_in(0x00), run_in(0xA5));
}

// What is said about an image with one byte changed; empty when it is taken.
std::string refusal_of(const std::string& state, const cable::RobotParams& table) {
  try {
    controller_from<cable::CableArm>(state, table, "snapshots.mcap");
  } catch (const std::runtime_error& refused) {
    return refused.what();
  }
  return "";
}

TEST(Image, OneThatIsCutShortOrTooLongIsRefusedWithTheField) {
  const cable::Rig rig = moving_rig(50);
  const std::string good = state_of(rig.controller);
  EXPECT_EQ(refusal_of(good, rig.robot), "");
  for (std::size_t length = 0; length < good.size(); length += 97)
    ASSERT_NE(refusal_of(good.substr(0, length), rig.robot), "") << length;
  EXPECT_TRUE(
      names(refusal_of(good.substr(0, 4), rig.robot), {"snapshots.mcap", "controller.arm.payout_measured_m[0]"}));
  EXPECT_TRUE(names(refusal_of(good + "x", rig.robot), {"1 more"}));
}

TEST(Image, WhatWouldLeadTheCoreOutOfItsArraysIsRefusedAndNamed) {
  const cable::Rig rig = moving_rig(50);
  const auto expect_refused = [&](const std::string& field, auto value, Facts facts) {
    const std::string said = refusal_of(with_field(rig.controller, field, value), rig.robot);
    facts.push_back("controller." + field);
    EXPECT_TRUE(names(said, facts));
  };
  expect_refused("faults.count", std::int32_t{17}, {"0..16"});
  expect_refused("faults.count", std::int32_t{-1}, {"0..16"});
  expect_refused("faults.fault[2].number", std::uint16_t{77}, {"meaning"});
  expect_refused("supervisor.phase", std::uint8_t{11}, {"meaning"});
  expect_refused("active.setpoint.kind", std::uint8_t{8}, {"meaning"});
  expect_refused("active.setpoint.node[1].node", std::int32_t{6}, {"0..5"});
  expect_refused("arm.cable_watch.newest", std::uint8_t{2}, {"0..1"});
  expect_refused("arm.cable_watch.segment", std::int32_t{5}, {"0..4"});
  expect_refused("arm.cable_watch.cable", std::int32_t{31}, {});
  expect_refused("arm.cable_watch.suspect", std::int32_t{15}, {"-1..14"});
  expect_refused("arm.let_go.stage", std::uint8_t{4}, {"meaning"});
  expect_refused("arm.let_go.segment", std::int32_t{5}, {"-1..4"});
  expect_refused("arm.let_go.cable", std::int32_t{15}, {"0..14"});
  expect_refused("arm.motion.braking", std::uint8_t{2}, {"0..1"});
  expect_refused("arm.motion.interval_tick", std::int32_t{-2}, {"0.."});
  expect_refused("arm.motion.held_mask", std::uint32_t{1u << 10}, {"0..1023"});
  expect_refused("arm.motion.shape.wanted_held.low", std::uint32_t{1u << 16}, {"0..1023"});
  expect_refused("arm.motion.shape.next_pull", ~std::uint64_t{0}, {"0.."});
  expect_refused("arm.motion.limiter.theta_rad[4]", 1001.0, {"finite", "1000"});
  expect_refused("arm.ramp", std::numeric_limits<double>::quiet_NaN(), {"finite"});
}

TEST(Image, ATableThatWouldLeadTheCoreOutOfItsArraysIsRefused) {
  const auto said = [](auto change) -> std::string {
    cable::RobotParams table = cable::zhu2022::table();
    change(table);
    std::string bytes;
    append_serialised(bytes, table);
    std::size_t used = 0;
    try {
      checked_table<cable::RobotParams>(bytes, "snapshots.mcap", used);
    } catch (const std::runtime_error& refused) {
      return refused.what();
    }
    return "";
  };
  EXPECT_EQ(said([](cable::RobotParams&) {}), "");
  EXPECT_NE(said([](cable::RobotParams& t) { t.segment_count = 9; }).find("segment_count: 9"), std::string::npos);
  EXPECT_NE(said([](cable::RobotParams& t) { t.segment[2].cables = cable::kMaxSegmentCables + 1; }), "");
  EXPECT_NE(said([](cable::RobotParams& t) { t.segment[0].modules = 17; }), "");
  EXPECT_NE(said([](cable::RobotParams& t) { t.segment[1].slide_m_rad = 0.1; }).find("segment.slide_m_rad: 0.1"),
            std::string::npos);
  EXPECT_NE(said([](cable::RobotParams& t) { t.interval_ticks = 0; }), "");
  EXPECT_NE(said([](cable::RobotParams& t) { t.tick_s = -0.0; }), "");
}

// Thousands of images nobody wrote: the core lives through every one that is taken.
TEST(Image, AnImageWithFlippedBytesIsRefusedOrHarmless) {
  const cable::Rig rig = moving_rig(90);
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
    cable::Rig other = rig;
    other.controller = controller_from<cable::CableArm>(bad, rig.robot, "snapshots.mcap");
    other.run(4);
  }
  EXPECT_GT(taken, rounds(20));
  EXPECT_LT(taken, rounds(1000));
}

}  // namespace
}  // namespace liana::recording
