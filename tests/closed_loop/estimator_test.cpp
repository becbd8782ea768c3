// Measured theta: from motor lengths and tensions back to angles, on an arm that is not exactly the table's
// (req:A11).
#include <gtest/gtest.h>

#include "arm_under_control.hpp"
#include "fixture.hpp"

namespace liana::closed_loop {
namespace {

double estimate_error_deg(ArmUnderControl& arm) {
  return largest_difference_deg(arm.outputs().theta_measured_rad, arm.plant().theta_rad());
}

class Estimator : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(Estimator, SaysTheTrueAnglesOfAFrictionlessArmWithinATwentiethOfADegree) {
  ArmUnderControl arm({"ideal", GetParam(), true, "prepare"});
  arm.boot();
  arm.hold(2.0);
  const double at_prepare_deg = estimate_error_deg(arm);
  const double start_offset_deg = largest_difference_deg(arm.plant().theta_rad(), named_pose_rad("prepare"));
  arm.move_joints(named_pose_rad("panel_edge"), 25.0);
  arm.hold(8.0);
  measured("start offset from the named pose", start_offset_deg, "deg");
  measured("error of measured theta at prepare", at_prepare_deg, "deg");
  measured("error of measured theta at panel edge", estimate_error_deg(arm), "deg");
  EXPECT_GT(start_offset_deg, 0.1) << "an estimate that repeats the table would pass";
  EXPECT_LT(at_prepare_deg, 0.05);
  EXPECT_LT(estimate_error_deg(arm), 0.05);
}

INSTANTIATE_TEST_SUITE_P(Seed, Estimator, ::testing::Values(1, 2, 3));

}  // namespace
}  // namespace liana::closed_loop
