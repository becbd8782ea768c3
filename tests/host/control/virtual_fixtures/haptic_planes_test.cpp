// Fixtures as planes for the hand: where the force begins, how strong it gets, and which of them a device is told.
#include "host/control/virtual_fixtures/haptic_planes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace liana::virtual_fixtures {
namespace {

const config::SceneFixture kPlane{"plane", config::FixtureKind::kPlane, {}, 2.0, 1.0, 0.05};
const config::SceneFixture kWalls{"walls", config::FixtureKind::kWalls, {}, 2.0, 1.0, 0.05};

// The force on a hand that stands, of all planes.
Vec3 felt_N(const std::vector<HapticPlane>& planes, const Vec3& hand_m) {
  Vec3 force{};
  for (const HapticPlane& one : planes) {
    EXPECT_TRUE(haptics::is_valid(one.plane));
    force = add(force, haptics::plane_force(one.plane, 0.0, {hand_m, {}}));
  }
  return force;
}

TEST(FeltPlanes, AWallOfTheTipIsFeltWhereTheHandBringsTheTipToIt) {
  const HandMap map{{0.01, 0.02, 0.03}, {1.0, 0.005, 0.0}, 4.0};
  const auto planes = render_planes(kWalls, 0, {}, 0.0, 0.03, map);
  const double at_m = 0.02 + (0.02 - 0.005) / 4.0;  // of the hand: the tip 20 mm off the middle
  EXPECT_NEAR(felt_N(planes, {0.0, at_m - 1e-6, 0.0})[1], 0.0, 1e-9);
  EXPECT_NEAR(felt_N(planes, {0.0, at_m + 0.001, 0.0})[1], -1.5, 1e-9) << "1500 N/m";
  const double other_m = 0.02 + (-0.02 - 0.005) / 4.0;
  EXPECT_NEAR(felt_N(planes, {0.0, other_m - 0.001, 0.0})[1], 1.5, 1e-9);
}

// req:A55
TEST(FeltPlanes, APlaneIsFeltInFullWhereThreeQuartersOfItsRoomAreUsed) {
  for (const double scale : {0.5, 1.0, 2.0, 4.0}) {
    for (const double room_m : {0.02, 0.012, 0.02 * 0.6}) {
      const HandMap map{{}, {}, scale};
      const auto planes = render_planes(kPlane, 0, {}, room_m, 0.03, map);
      const double full_m = 0.75 * room_m / scale;
      if (full_m < 0.002) continue;  // stiffer than 3000 N/m: felt less
      EXPECT_NEAR(felt_N(planes, {0.0, full_m, 0.0})[1], -6.0, 1e-9) << scale << ", " << room_m;
      EXPECT_NEAR(felt_N(planes, {0.0, 0.0, 0.0})[1], 0.0, 1e-9) << "in the plane nothing is felt";
    }
  }
}

TEST(FeltPlanes, NoRoomAtAllIsAStiffPlaneAndStillOneThatDevicesCanRender) {
  const HandMap map{{}, {}, 4.0};
  for (const double room_m : {0.0, -0.01, 0.001}) {
    const auto planes = render_planes(kPlane, 0, {}, room_m, 0.03, map);
    EXPECT_NEAR(felt_N(planes, {0.0, 0.001, 0.0})[1], -3.0, 1e-9) << room_m;
  }
}

TEST(FeltPlanes, AnAxisIsAFunnelThatNarrowsToItsRadiusAtItsEnd) {
  config::SceneFixture axis{"axis", config::FixtureKind::kAxis, {}, 0.3, 1.0, 0.05};
  axis.radius_m = 0.01;
  axis.opening_deg = 30.0;
  const auto planes = render_planes(axis, 0, {}, 0.0, 0.03, {{}, {}, 1.0});
  for (const double x_m : {0.0, 0.1, 0.3}) {
    const double half_m = 0.01 + (0.3 - x_m) * std::tan(30.0 * 3.14159265358979 / 180.0);
    for (const double side : {1.0, -1.0}) {
      EXPECT_NEAR(norm(felt_N(planes, {x_m, 0.0, side * (half_m - 1e-6)})), 0.0, 1e-9) << x_m;
      const Vec3 force = felt_N(planes, {x_m, 0.0, side * (half_m + 0.001)});
      EXPECT_LT(side * force[2], -1.0) << "back into the funnel";
      EXPECT_LT(force[0], -0.5) << "and back out of it";
    }
  }
}

TEST(FeltPlanes, TheEndsOfAWorkspacePushInwards) {
  const auto planes = feel_workspace({-0.08, -0.08, -0.05}, {0.08, 0.08, 0.06}, 0.005);
  EXPECT_EQ(felt_N(planes, {0.0, 0.0, 0.0}), (Vec3{}));
  EXPECT_NEAR(felt_N(planes, {0.078, 0.0, 0.0})[0], -4.5, 1e-9);
  EXPECT_NEAR(felt_N(planes, {0.0, 0.0, -0.047})[2], 3.0, 1e-9);
}

// A plane that has left its slot leaves an interval without stiffness behind: a device that moves every plane evenly
// would otherwise sweep it through the hand.
TEST(PlaneSlots, NeverGiveASlotToAnotherPlaneWithoutAnIntervalOfNone) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> one(-1.0, 1.0);
  PlaneSlots slots;
  PlaneSlots::Told before{};
  for (int i = 0; i < 5000; ++i) {
    std::vector<HapticPlane> planes;
    for (std::uint32_t number = 0; number < 12; ++number) {
      if (one(random) > 0.9) continue;  // K tells the planes apart
      planes.push_back({number, {{0.0, 1.0, 0.0}, 0.1 * one(random), 100.0 + number, 1.0}});
    }
    const PlaneSlots::Told& told = slots.next(planes, {0.0, 0.1 * one(random), 0.0});
    for (std::size_t k = 0; k < kMaxPlanes; ++k) {
      if (before[k].stiffness_N_m > 0.0 && told[k].stiffness_N_m > 0.0) {
        ASSERT_EQ(before[k].stiffness_N_m, told[k].stiffness_N_m) << "slot " << k;
      }
      for (std::size_t other = 0; other < k; ++other) {
        if (told[k].stiffness_N_m > 0.0) {
          ASSERT_NE(told[k].stiffness_N_m, told[other].stiffness_N_m) << "told twice";
        }
      }
    }
    before = told;
  }
}

TEST(PlaneSlots, ThePlanesThatTheHandIsInAreAmongThoseTold) {
  PlaneSlots slots;
  std::vector<HapticPlane> planes;
  for (std::uint32_t number = 0; number < 10; ++number)
    planes.push_back({number, {{0.0, 1.0, 0.0}, number == 7 ? 0.01 : -0.1 - 0.01 * number, 100.0 + number, 1.0}});
  slots.next(planes, {});
  const auto& told = slots.next(planes, {});
  EXPECT_TRUE(std::any_of(told.begin(), told.end(), [](const auto& one) { return one.stiffness_N_m == 107.0; }));
}

}  // namespace
}  // namespace liana::virtual_fixtures
