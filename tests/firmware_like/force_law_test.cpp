// The outer laws of force control against numbers worked out by hand, and the sensors' freshness. req:B4 req:B17
#include "firmware_like/serial/force_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "firmware_like/serial/adapter_monitor.hpp"
#include "firmware_like/serial/sensor_pdo.hpp"
#include "firmware_like/serial/wrist.hpp"

namespace liana::serial {
namespace {

// M_d 500 kg and 100 kg.m2, K_D 4000, 3000 and 1500, K_P 3000 and 900.
InsertGains gains() {
  InsertGains gains{};
  gains[kPushMass] = 500.0;
  gains[kPushInertia] = 100.0;
  gains[kAxialDamping] = 4000.0;
  gains[kLateralDamping] = 3000.0;
  gains[kTurnDamping] = 1500.0;
  gains[kForceGain] = 1.0;
  gains[kStiffness] = 3000.0;
  gains[kTurnStiffness] = 900.0;
  return gains;
}

LawInputs free_push() {
  LawInputs in;
  in.tick_s = 0.004;
  in.axis = {0.0, 0.0, 1.0};
  in.set.force_N = {0.0, 0.0, 30.0};
  in.axial_damping = 4000.0;
  return in;
}

struct Row {
  const char* why;
  InsertLaw law;
  Wrench given;
  Vec3 away_m;
  Vec3 drives_N;
  Vec3 turns_Nm;
};

TEST(ForceLaw, DrivesTheTipAsWorkedOutByHand) {
  const Row rows[] = {
      {"no force yet: all of it", InsertLaw::kForce, {}, {}, {0, 0, 30}, {0, 0, 0}},
      {"the set force is met", InsertLaw::kForce, {{0, 0, 30}, {}}, {}, {0, 0, 0}, {0, 0, 0}},
      {"across the axis 1 N is nothing", InsertLaw::kForce, {{0.6, 0.8, 30}, {}}, {}, {0, 0, 0}, {0, 0, 0}},
      {"and of more the rest counts", InsertLaw::kForce, {{3, 4, 30}, {}}, {}, {-2.4, -3.2, 0}, {0, 0, 0}},
      {"turning has 0.5 N m", InsertLaw::kForce, {{0, 0, 30}, {0, 1.5, 0}}, {}, {0, 0, 0}, {0, -1.0, 0}},
      {"impedance: stiffness less what is given",
       InsertLaw::kImpedance,
       {{0, 0, 6}, {}},
       {0, 0, 0.01},
       {0, 0, 24},
       {0, 0, 0}},
      {"impedance has no dead band", InsertLaw::kImpedance, {{0.5, 0, 0}, {}}, {}, {-0.5, 0, 0}, {0, 0, 0}},
  };
  for (const Row& row : rows) {
    LawInputs in = free_push();
    in.given = row.given;
    in.away_m = row.away_m;
    const Wrench drive = drive_of(row.law, gains(), in);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(drive.force_N[k], row.drives_N[k], 1e-12) << row.why;
      EXPECT_NEAR(drive.torque_Nm[k], row.turns_Nm[k], 1e-12) << row.why;
    }
  }
}

// v = F / K_D at the end; 63 % of it after M_d / K_D = 0.125 s, less what a step of 4 ms takes.
TEST(ForceLaw, InFreeMotionTheTipComesToSetForceOverDamping) {
  Twist v;
  double after_time_constant = 0.0;
  for (int i = 1; i <= 1000; ++i) {
    v = law_step(InsertLaw::kForce, gains(), free_push(), v);
    if (i == 31) after_time_constant = v.linear_m_s[2];
  }
  EXPECT_NEAR(v.linear_m_s[2], 30.0 / 4000.0, 1e-9);
  EXPECT_NEAR(after_time_constant, 0.63 * 30.0 / 4000.0, 0.02 * 30.0 / 4000.0);
  EXPECT_EQ(v.linear_m_s[0], 0.0);
  EXPECT_EQ(v.angular_rad_s[1], 0.0);
}

TEST(ForceLaw, WhateverTheGainsItNeverSwingsBackOnItsOwn) {
  for (const double mass : {1e-6, 1.0, 5000.0}) {
    for (const double damping : {1e-6, 100.0, 1e6}) {
      InsertGains wild = gains();
      wild[kPushMass] = mass;
      LawInputs in = free_push();
      in.set = {};
      in.axial_damping = damping;
      Twist v{{0, 0, 0.1}, {}};
      for (int i = 0; i < 100; ++i) {
        const double before = v.linear_m_s[2];
        v = law_step(InsertLaw::kForce, wild, in, v);
        ASSERT_GE(v.linear_m_s[2], 0.0);
        ASSERT_LE(v.linear_m_s[2], before);
      }
    }
  }
}

constexpr std::uint16_t kStill = 5;

WristReading sample(std::uint8_t sequence, double force_N = 1.0) {
  return {{{0.0, 0.0, force_N}, {}}, sequence, WristStatus::kGood, 0};
}

TEST(Wrist, ASampleThatWasThereBeforeMakesNothingFresh) {
  WristState state;
  EXPECT_EQ(health(state), WristHealth::kSilent);
  read_wrist(sample(255), kStill, state);
  EXPECT_EQ(health(state), WristHealth::kGood);
  read_wrist(sample(0), kStill, state);  // the count goes round
  EXPECT_EQ(health(state), WristHealth::kGood);
  for (int i = 0; i < 2; ++i) {
    read_wrist(sample(0, 5.0), kStill, state);  // a frozen sensor goes on sending
    EXPECT_EQ(health(state), WristHealth::kGood) << i;
  }
  EXPECT_EQ(state.felt.force_N[2], 1.0);
  read_wrist(sample(0, 5.0), kStill, state);
  EXPECT_EQ(health(state), WristHealth::kSilent) << "three ticks without a new sample";
  read_wrist(sample(1), kStill, state);
  EXPECT_EQ(health(state), WristHealth::kGood);
}

// One number that differs is enough, and 0 is for a sensor that may rest on a number.
TEST(Wrist, NewSamplesWithTheVerySameNumbersAreAStuckSensorUntilOneDiffers) {
  for (const std::uint16_t still : {std::uint16_t{0}, kStill}) {
    WristState state;
    for (std::uint8_t i = 0; i < 50; ++i) {
      const bool differs = i == 3 || i == 40;
      read_wrist(sample(i, differs ? 1.02 : 1.0), still, state);
      const bool is_stuck = still > 0 && ((i >= 4 + kStill && i < 40) || i >= 41 + kStill);
      EXPECT_EQ(health(state), is_stuck ? WristHealth::kStuck : WristHealth::kGood) << int{i};
    }
  }
}

TEST(Wrist, NamesWhatIsWrongAndKeepsTheLastGoodSample) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  WristReading saturated = sample(2, 655.0), failed = sample(2), broken = sample(2, nan);
  saturated.status = WristStatus::kSaturated;
  failed.status = WristStatus::kFailed;
  for (const auto& [reading, said] :
       {std::pair{saturated, WristHealth::kSaturated}, std::pair{failed, WristHealth::kFailed},
        std::pair{broken, WristHealth::kNoNumber}}) {
    WristState state;
    read_wrist(sample(1, 3.0), kStill, state);
    read_wrist(reading, kStill, state);
    EXPECT_EQ(health(state), said);
    EXPECT_EQ(state.felt.force_N[2], 3.0);
  }
}

TEST(AdapterWatch, AMessageCountsOnceAndTwelveTicksWithoutANewOneAreSilence) {
  AdapterState state;
  AdapterReading said;
  said.sequence = 7;
  said.captured = 1;
  said.age_ticks = 0;
  read_adapter(said, state);
  EXPECT_TRUE(says_captured(state));
  read_adapter(said, state);  // sent twice
  EXPECT_FALSE(says_captured(state));
  EXPECT_EQ(state.repeated, 1u);
  for (int i = 0; i < 10; ++i) read_adapter({7, 1, {}, {}, {}, static_cast<std::uint16_t>(i + 1)}, state);
  EXPECT_TRUE(is_heard(state));
  read_adapter({7, 1, {}, {}, {}, 11}, state);
  EXPECT_FALSE(is_heard(state));
  read_adapter({8, 0, {}, {}, {}, 0}, state);
  EXPECT_TRUE(is_heard(state));
  EXPECT_FALSE(says_captured(state));
}

TEST(SensorPdo, ReadsTheBytesOfTheWireAsTheyAreWritten) {
  const std::array<std::uint8_t, 8> force{0x64, 0x00, 0x9C, 0xFF, 0xFF, 0x7F, 9, 1};
  WristHalf half;
  ASSERT_TRUE(decode_wrist_half(force, kWristForceStep_N, half));
  EXPECT_DOUBLE_EQ(half.value[0], 2.0);
  EXPECT_DOUBLE_EQ(half.value[1], -2.0);
  EXPECT_DOUBLE_EQ(half.value[2], 655.34);
  EXPECT_EQ(half.sequence, 9);
  EXPECT_EQ(half.status, WristStatus::kSaturated);
  EXPECT_FALSE(decode_wrist_half(std::span(force).first(7), kWristForceStep_N, half));

  const std::array<std::uint8_t, 8> message{3, 1, 2, 9, 200, 205, 198, 0};
  AdapterReading adapter;
  ASSERT_TRUE(decode_adapter(message, adapter));
  EXPECT_EQ(adapter.sequence, 3);
  EXPECT_EQ(adapter.captured, 1);
  EXPECT_EQ(adapter.latch, CatchState::kClosed);
  EXPECT_EQ(adapter.lock, CatchState::kFailed) << "a state that nobody knows";
  EXPECT_EQ(adapter.depth_01mm[1], 205);
  EXPECT_EQ(encode_adapter_command(AdapterCommand::kRelease, 5), (std::array<std::uint8_t, 2>{2, 5}));
}

}  // namespace
}  // namespace liana::serial
