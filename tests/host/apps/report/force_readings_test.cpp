// The table that `liana force --self-test` makes of its readings.
#include "host/apps/report/force_readings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include "tests/message.hpp"

namespace liana::report {
namespace {

ForceReadings some() {
  ForceReadings all;
  all.readings.push_back({ForceMoment::kStill, 0, {2.0, 0.0, 0.0}, {1.7, 0.0, 0.4}, {0.2, 0.2, 0.2}});
  all.readings.push_back({ForceMoment::kStill, 0, {0.0, 2.0, 0.0}, {std::nullopt, 1.9, 0.0}, {5.0, 0.2, 0.2}});
  all.found.push_back({ForceMoment::kStill, 2.0, 0.8});
  all.found.push_back({ForceMoment::kStill, 2.0, std::nullopt});
  all.free_moving_N = {0.1, 0.2, 1.3};
  all.faults.push_back({5001, 3.5});
  all.body.push_back({3, true, 3});
  all.body.push_back({4, true, 5});
  return all;
}

TEST(ForceReadings, ErrorsCountOnlyAlongAxesThatAreSeen) {
  const Json table = force_json(some());
  const Json& row = table.at("errors")[0];
  EXPECT_EQ(row.at("state").text(), "still");
  EXPECT_EQ(row.at("count").get<int>(), 2);
  EXPECT_NEAR(row.at("rms_N").get<double>(), std::sqrt((0.25 + 0.01) / 2.0), 1e-9);
  EXPECT_NEAR(row.at("bias_N").get<double>(), -0.3, 1e-9) << "of the one that is seen whole";
  EXPECT_NEAR(row.at("within_95").get<double>(), 4.0 / 5.0, 1e-9) << "0.4 N are twice 0.2 N";
  EXPECT_NEAR(row.at("seen").get<double>(), 5.0 / 6.0, 1e-9);
}

TEST(ForceReadings, WhatWasFoundAndWhatWasNotAreCounted) {
  const Json table = force_json(some());
  EXPECT_NEAR(table.at("found")[0].at("found").get<double>(), 0.5, 1e-9);
  EXPECT_EQ(table.at("free").at("moving").at("found").get<int>(), 1);
  EXPECT_EQ(table.at("body").at("right").get<int>(), 1);
  EXPECT_TRUE(names(force_text(table), {"fault 5001", "3.5 N"}));
}

}  // namespace
}  // namespace liana::report
