// Following the leader with a base that feeds: the body on the curve, on seeded curves; judged by the joints of the
// independent check and by distances from the given points.
#include <algorithm>
#include <cmath>
#include <random>

#include "firmware_like/math/trig.hpp"
#include "host/planning/planner/check/plan_check.hpp"
#include "host/planning/planner/follow/follow.hpp"
#include "host/planning/planner/plan.hpp"
#include "tests/host/planning/planner/requests.hpp"
#include "tests/message.hpp"

namespace liana::planner {
namespace {

using Index = std::size_t;

config::RobotConfig fed_arm() {
  const config::BusesConfig buses = config::parse_buses(config::good_table("buses", "embedded_feeder").dump(), "b");
  return config::parse_robot(config::good_table("robot", "feeder").dump(), "r", "nominal", buses);
}

// A curve that begins with straight ahead and has bends of a radius, each in a plane of its own.
struct Drawn {
  Vec3 at{0.375, 0.0, 0.0};
  Vec3 ahead{1.0, 0.0, 0.0};
  std::vector<Vec3> points_m{{0.375, 0.0, 0.0}};

  void straight(double length_m) {
    const int pieces = std::max(1, static_cast<int>(std::ceil(length_m / 0.01)));
    for (int i = 0; i < pieces; ++i) {
      at = add(at, scale(ahead, length_m / pieces));
      points_m.push_back(at);
    }
  }
  // Turns towards a direction across.
  void bend(double radius_m, double angle_rad, Vec3 to) {
    to = subtract(to, scale(ahead, dot(to, ahead)));
    to = scale(to, 1.0 / norm(to));
    const Vec3 center = add(at, scale(to, radius_m)), from = ahead;
    const int pieces = std::max(1, static_cast<int>(std::ceil(radius_m * angle_rad / 0.01)));
    for (int i = 1; i <= pieces; ++i) {
      const double angle = angle_rad * i / pieces;
      at = add(center, add(scale(from, radius_m * std::sin(angle)), scale(to, -radius_m * std::cos(angle))));
      points_m.push_back(at);
    }
    ahead = add(scale(from, std::cos(angle_rad)), scale(to, std::sin(angle_rad)));
  }
};

PlanRequest request_along(const std::vector<Vec3>& points_m) {
  PlanRequest request;
  request.robot = fed_arm();
  request.from_rad[0] = -85.0 * kDegree;
  request.max_step_rad = kFollowMaxStep_rad;
  request.follow.emplace();
  request.follow->points_m = points_m;
  return request;
}

std::vector<Vec3> seeded_curve(std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto draw = [&](double least, double most) {
    return least + (most - least) * std::generate_canonical<double, 32>(random);
  };
  Drawn curve;
  curve.straight(draw(0.02, 0.2));
  for (int i = 0; i < 2; ++i) {
    const double side = draw(0.0, 2.0 * kPi), radius_m = draw(0.22, 0.35);
    curve.bend(radius_m, draw(30.0, 60.0) * kDegree, {0.0, std::cos(side), std::sin(side)});
    curve.straight(draw(0.01, 0.08));
  }
  return curve.points_m;
}

// Of a point from the straight pieces between points, those up to the last one.
double distance_m(const Vec3& point_m, const std::vector<Vec3>& line_m) {
  double least_m = 1e300;
  for (Index i = 0; i + 1 < line_m.size(); ++i) {
    const Vec3 piece = subtract(line_m[i + 1], line_m[i]), away = subtract(point_m, line_m[i]);
    const double share = std::clamp(dot(away, piece) / dot(piece, piece), 0.0, 1.0);
    least_m = std::min(least_m, norm(subtract(away, scale(piece, share))));
  }
  return least_m;
}

// Greatest distance of the arm's axis from the slide's axis and the curve, at the waypoints.
double body_off_m(const PlanRequest& request, const Path& path) {
  std::vector<Vec3> line{{-1.0, 0.0, 0.0}};
  line.insert(line.end(), request.follow->points_m.begin(), request.follow->points_m.end());
  double most_m = 0.0;
  for (const ThetaVector& theta : path) {
    const std::vector<Vec3> axis = plain_axis(request.robot.table, theta);
    for (Index link = 0; link + 1 < axis.size(); ++link) {
      for (const double share : {0.0, 0.5, 1.0})
        most_m =
            std::max(most_m, distance_m(add(axis[link], scale(subtract(axis[link + 1], axis[link]), share)), line));
    }
  }
  return most_m;
}

TEST(FollowFed, TheBodyIsOnTheCurveBehindTheTip) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const PlanRequest request = request_along(seeded_curve(seed));
    const PlanResult result = plan(request, {});
    ASSERT_EQ(result.outcome, PlanOutcome::solved) << seed << " " << result.constraint << ": " << result.reason;
    EXPECT_LE(result.follow->curve_off_m, kFollowBodyOff_m) << seed;
    EXPECT_LE(result.follow->tip_off_m, kFollowTipOff_m) << seed;
    EXPECT_EQ(result.checked->over_limit_deg, 0.0) << seed;
    EXPECT_EQ(result.waypoints_rad.front(), request.from_rad) << seed;
    const Vec3 end = plain_axis(request.robot.table, result.waypoints_rad.back()).back();
    EXPECT_LT(norm(subtract(end, request.follow->points_m.back())), 1e-6) << seed;
  }
}

TEST(FollowFed, TheDistanceToldIsThatOfThePointsGiven) {
  for (std::uint32_t seed = 21; seed <= 25; ++seed) {
    const PlanRequest request = request_along(seeded_curve(seed));
    const PlanResult result = plan(request, {});
    ASSERT_EQ(result.outcome, PlanOutcome::solved) << seed << " " << result.reason;
    EXPECT_NEAR(result.follow->curve_off_m, body_off_m(request, result.waypoints_rad), 0.0005) << seed;
    EXPECT_GE(result.follow->curve_off_segment, 2);
    EXPECT_LE(result.follow->curve_off_segment, 5);
  }
}

// 3 segments of 5 modules of 40 mm: their joints do not come by the curve in step with the tip.
config::RobotConfig short_arm() {
  config::RobotConfig robot = fed_arm();
  robot.table.segment_count = 4;
  for (Index m = 1; m < 4; ++m) {
    robot.table.segment[m].modules = 5;
    robot.table.segment[m].module_length_m = 0.04;
    robot.table.segment[m].theta_limit_rad = 15.0 * kDegree;
  }
  return robot;
}

TEST(FollowFed, NoAngleGoesToAndFroOnTheWayAndAFasterArmFollowsAsWell) {
  for (const double cable_speed_m_s : {0.005, 0.01, 0.02, 0.1}) {
    Drawn curve;
    curve.at[0] = 0.175;
    curve.points_m = {curve.at};
    curve.straight(0.1);
    curve.bend(0.4, 20.0 * kDegree, {0.0, 1.0, 0.0});
    curve.bend(0.4, 20.0 * kDegree, {0.0, 0.0, 1.0});
    PlanRequest request = request_along(curve.points_m);
    request.robot = short_arm();
    request.robot.table.limits.cable_speed_m_s = cable_speed_m_s;
    const PlanResult result = plan(request, {});
    ASSERT_EQ(result.outcome, PlanOutcome::solved) << cable_speed_m_s << " " << result.reason;
    for (Index k = 2; k < 8; ++k) {
      double least = 0.0, most = 0.0, gone = 0.0;
      for (Index w = 1; w < result.waypoints_rad.size(); ++w) {
        const double here = result.waypoints_rad[w][k];
        least = std::min(least, here), most = std::max(most, here);
        gone += std::fabs(here - result.waypoints_rad[w - 1][k]);
      }
      EXPECT_LT(gone, 3.0 * (most - least) + 0.5 * kDegree) << cable_speed_m_s << ", angle " << k;
    }
  }
}

TEST(FollowFed, TheSameCurveGivesTheSamePlan) {
  const PlanRequest request = request_along(seeded_curve(1));
  EXPECT_EQ(plan_hash(request, plan(request, {})), plan_hash(request, plan(request, {})));
}

TEST(FollowFed, RefusesACurveThatBendsMoreThanTheArm) {
  Drawn curve;
  curve.straight(0.2);
  curve.bend(0.08, 90.0 * kDegree, {0.0, 1.0, 0.0});
  curve.straight(0.3);
  const PlanResult result = plan(request_along(curve.points_m), {});
  EXPECT_NE(result.outcome, PlanOutcome::solved);
  EXPECT_EQ(result.constraint, "curve");
  EXPECT_TRUE(names(result.reason, {"segment", "along", "15.0 mm", "0.16 m"})) << result.reason;
  EXPECT_TRUE(result.waypoints_rad.empty());
}

TEST(FollowFed, RefusesACurveThatIsLongerThanTheSlideFeeds) {
  Drawn curve;
  curve.straight(0.3);
  curve.bend(0.3, 90.0 * kDegree, {0.0, 1.0, 0.0});
  curve.straight(0.2);
  const PlanResult result = plan(request_along(curve.points_m), {});
  EXPECT_EQ(result.outcome, PlanOutcome::infeasible);
  EXPECT_EQ(result.constraint, "curve");
  EXPECT_TRUE(names(result.reason, {"slide", "0.875 m", "0.971 m"})) << result.reason;
}

}  // namespace
}  // namespace liana::planner
