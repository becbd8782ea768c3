// Motion waits for a cable that is on its way to slack.
#include "host/control/arbiter/taut_pace.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/firmware_like/zhu2022.hpp"
#include "tests/host/control/arbiter/interval.hpp"

namespace liana::arbiter {
namespace {

const cable::RobotParams kArm = cable::zhu2022::table();

// All cables at the planned tension but one.
cable::CableVector tensions_N(std::size_t cable, double tension_N) {
  cable::CableVector all_N{};
  for (std::size_t c = 0; c < static_cast<std::size_t>(kArm.cable_count()); ++c) all_N[c] = kArm.tension.plan_N;
  all_N[cable] = tension_N;
  return all_N;
}

// After a second in which nothing changes.
double settled(std::size_t cable, double tension_N, TautPace pace = TautPace(kArm, kInterval_s)) {
  double share = 1.0;
  for (int i = 0; i < 50; ++i) share = pace.next(tensions_N(cable, tension_N));
  return share;
}

TEST(TautPace, EveryCableSlowsMotionUnderItsLevelAndLeavesALittleWhereItIsSlack) {
  const double floor_N = kArm.tension.floor_motor_N;
  for (std::size_t c = 0; c < static_cast<std::size_t>(kArm.cable_count()); ++c) {
    EXPECT_EQ(settled(c, floor_N + 3.0), 1.0) << c;
    EXPECT_LT(settled(c, floor_N + 2.9), 1.0) << c;
    EXPECT_NEAR(settled(c, floor_N - 1.5), 0.5, 1e-12) << c;
    EXPECT_GT(settled(c, floor_N - 5.8), TautPace::kLeast) << c;
    EXPECT_EQ(settled(c, floor_N - 6.0), TautPace::kLeast) << c;
    EXPECT_EQ(settled(c, 0.0), TautPace::kLeast) << c;
  }
}

TEST(TautPace, ACableThatFallsSlowsMotionBeforeItIsThereAndOneThatRisesDoesNot) {
  const double free_N = kArm.tension.floor_motor_N + 3.0;
  TautPace falls(kArm, kInterval_s), rises(kArm, kInterval_s);
  falls.next(tensions_N(4, free_N + 7.0));
  EXPECT_EQ(falls.next(tensions_N(4, free_N + 5.7)), 1.0) << "65 N/s: 5.2 N in the 0.08 s that count";
  EXPECT_LT(falls.next(tensions_N(4, free_N + 4.2)), 1.0) << "75 N/s: 6 N";
  rises.next(tensions_N(4, free_N - 1.0));
  EXPECT_EQ(rises.next(tensions_N(4, free_N + 0.01)), 1.0);
}

TEST(TautPace, ItChangesNoFasterThanMotionComesToRest) {
  TautPace pace(kArm, kInterval_s);
  double before = 1.0;
  for (int i = 0; i < 40; ++i) {
    const double share = pace.next(tensions_N(0, i < 20 ? 0.0 : kArm.tension.plan_N));
    EXPECT_LE(std::fabs(share - before), 4.0 * kInterval_s + 1e-12) << i;
    before = share;
  }
  pace.next(tensions_N(0, 0.0));
  pace.forget();
  EXPECT_EQ(pace.next(tensions_N(0, kArm.tension.plan_N)), 1.0);
}

TEST(TautPace, ItsNewtonsAreThoseOfTheArm) {
  cable::RobotParams strong = kArm;
  strong.tension.plan_N *= 2.0;
  strong.tension.floor_motor_N *= 2.0;
  TautPace pace(strong, kInterval_s);
  cable::CableVector all_N{};
  all_N.fill(strong.tension.plan_N);
  double share = 1.0;
  for (int i = 0; i < 50; ++i) {
    all_N[14] = strong.tension.floor_motor_N - 3.0;
    share = pace.next(all_N);
  }
  EXPECT_NEAR(share, 0.5, 1e-12);
}

}  // namespace
}  // namespace liana::arbiter
