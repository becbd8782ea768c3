// The three laws: pure functions of what is known of hand and arm.
#include "host/operator/haptics/feedback_law.hpp"

#include <gtest/gtest.h>

namespace liana::haptics {
namespace {

// All tips along x.
Motion tip_at_x(double x_m, double speed_m_s = 0.0) { return {{x_m, 0.0, 0.0}, {speed_m_s, 0.0, 0.0}}; }

// req:C15
TEST(FeedbackLaw, HasANameThatLeadsBackToIt) {
  for (const Law law : {Law::kClaim, Law::kAbstract, Law::kAligned}) EXPECT_EQ(law_of(name_of(law)), law);
  EXPECT_FALSE(law_of("force"));
  EXPECT_FALSE(law_of(""));
}

// req:C14 req:C15
TEST(FeedbackLaw, EachComparesTheArmWithItsOwnOther) {
  struct Row {
    Law law;
    double expected_N;
    const char* why;
  };
  const LawInputs inputs{tip_at_x(0.00), tip_at_x(0.04), tip_at_x(0.03), tip_at_x(0.01)};
  for (const Row& row : {Row{Law::kClaim, -8.0, "against what the hand asks for"},
                         Row{Law::kAbstract, -6.0, "against the prediction for now"},
                         Row{Law::kAligned, -2.0, "against the prediction of then"}})
    EXPECT_NEAR(law_force(row.law, {}, inputs)[0], row.expected_N, 1e-12) << row.why;
}

// req:C14
TEST(FeedbackLaw, IsZeroWhereArmAndOtherAreOne) {
  const LawInputs inputs{tip_at_x(0.3, 0.1), tip_at_x(0.3, 0.1), tip_at_x(0.3, 0.1), tip_at_x(0.3, 0.1)};
  for (const Law law : {Law::kClaim, Law::kAbstract, Law::kAligned}) EXPECT_EQ(norm(law_force(law, {}, inputs)), 0.0);
}

TEST(FeedbackLaw, OnlyTheLawsWithoutAlignmentDampSpeeds) {
  const LawInputs inputs{tip_at_x(0.0, 0.0), tip_at_x(0.0, 0.2), tip_at_x(0.0, 0.1), tip_at_x(0.0, 0.3)};
  EXPECT_NEAR(law_force(Law::kClaim, {}, inputs)[0], -1.0, 1e-12);
  EXPECT_NEAR(law_force(Law::kAbstract, {}, inputs)[0], -0.5, 1e-12);
  EXPECT_EQ(law_force(Law::kAligned, {}, inputs)[0], 0.0);
}

// P_md = P_rd / a: the hand's own millimetres.
// req:C14
TEST(FeedbackLaw, IsDividedByTheOperatingCoefficient) {
  LawGains gains;
  gains.scale = 4.0;
  EXPECT_NEAR(law_force(Law::kClaim, gains, {tip_at_x(0.0), tip_at_x(0.04), {}, {}})[0], -2.0, 1e-12);
}

TEST(FeedbackLaw, WhatIsNotSureIsNotFeltAndTheRestWithoutAStep) {
  LawGains gains;
  gains.unsure_m = 0.01;
  const auto felt_N = [&](double apart_m) {
    LawInputs inputs;
    inputs.robot.position_m = {0.6 * apart_m, 0.8 * apart_m, 0.0};
    return law_force(Law::kAligned, gains, inputs);
  };
  EXPECT_EQ(felt_N(0.009), (Vec3{}));
  EXPECT_LT(norm(felt_N(0.010001)), 1e-3);
  EXPECT_NEAR(norm(felt_N(0.030)), gains.stiffness_N_m * 0.020, 1e-9);
  EXPECT_NEAR(felt_N(0.030)[1] / felt_N(0.030)[0], 4.0 / 3.0, 1e-9);
}

}  // namespace
}  // namespace liana::haptics
