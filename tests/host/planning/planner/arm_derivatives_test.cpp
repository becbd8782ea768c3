// First and second derivatives of the planner's arm against central differences and against the control core.
#include "host/planning/planner/problem/arm_derivatives.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "firmware_like/cable/arm/cables.hpp"
#include "firmware_like/cable/arm/kinematics.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::planner {
namespace {

using Index = std::size_t;

constexpr double kStep_rad = 1e-5;

double dot4(const Quat& a, const Quat& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]; }

ThetaVector moved(ThetaVector theta, Index k, double step) {
  theta[k] += step;
  return theta;
}

ArmPoint random_point(zhu2022::Random& random) {
  return {static_cast<std::int32_t>(random.uniform(0.0, 23.999)), random.uniform(0.0, 1.0)};
}

// Every theta within 15 deg, or the straight arm, where the closed form must not be singular.
ThetaVector pose_of_case(zhu2022::Random& random, const RobotParams& table, int i) {
  return i == 0 ? ThetaVector{} : random.theta(table, 15.0);
}

TEST(ArmDerivatives, PlaceLinksAndTipWhereTheCoreDoes) {
  for (const RobotParams& table : {zhu2022::table(), zhu2022::uneven_table()}) {
    zhu2022::Random random(1);
    for (int i = 0; i < 100; ++i) {
      const ThetaVector theta = pose_of_case(random, table, i);
      const ArmDerivatives arm(table, theta);
      const LinkPoints points = link_points(table, theta);
      for (std::int32_t link = 0; link + 1 < points.count; ++link) {
        const Vec3 middle = scale(add(points.point_in_base[Index(link)], points.point_in_base[Index(link) + 1]), 0.5);
        EXPECT_LT(norm(subtract(arm.point({link, 0.5}).position_m, middle)), 1e-12);
      }
      const ArmKinematics core = forward_kinematics(table, theta);
      EXPECT_NEAR(std::fabs(dot4(arm.tip_quaternion(), core.tip_in_base.quaternion)), 1.0, 1e-12);
      EXPECT_LT(norm(subtract(arm.point(arm.node(2)).position_m, core.node_in_base[2].position_m)), 1e-12);
    }
  }
}

TEST(ArmDerivatives, OfPointsAreTheCentralDifferences) {
  for (const RobotParams& table : {zhu2022::table(), zhu2022::uneven_table()}) {
    zhu2022::Random random(2);
    const Index thetas = Index(table.theta_count());
    for (int i = 0; i < 40; ++i) {
      const ThetaVector theta = pose_of_case(random, table, i);
      const ArmPoint where = random_point(random);
      const Vec3 weight = random.vector(1.0);
      const ArmDerivatives arm(table, theta);
      const PointDerivatives here = arm.point(where);
      ThetaHessian hessian{};
      arm.add_hessian(where, here, weight, hessian);
      for (Index k = 0; k < thetas; ++k) {
        const PointDerivatives after = ArmDerivatives(table, moved(theta, k, kStep_rad)).point(where);
        const PointDerivatives before = ArmDerivatives(table, moved(theta, k, -kStep_rad)).point(where);
        const Vec3 slope = scale(subtract(after.position_m, before.position_m), 0.5 / kStep_rad);
        EXPECT_LT(norm(subtract(here.by_theta[k], slope)), 1e-7);
        for (Index j = 0; j <= k; ++j) {
          EXPECT_NEAR(hessian[k][j], dot(weight, subtract(after.by_theta[j], before.by_theta[j])) / (2.0 * kStep_rad),
                      1e-6);
        }
      }
    }
  }
}

TEST(ArmDerivatives, OfTheTipAttitudeAreTheCentralDifferences) {
  for (const RobotParams& table : {zhu2022::table(), zhu2022::uneven_table()}) {
    zhu2022::Random random(3);
    const Index thetas = Index(table.theta_count());
    for (int i = 0; i < 40; ++i) {
      const ThetaVector theta = pose_of_case(random, table, i);
      const Quat weight{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
      const ArmDerivatives arm(table, theta);
      const auto by_theta = arm.tip_quaternion_by_theta();
      ThetaHessian hessian{};
      arm.add_quaternion_hessian(weight, hessian);
      for (Index k = 0; k < thetas; ++k) {
        const ArmDerivatives after(table, moved(theta, k, kStep_rad)), before(table, moved(theta, k, -kStep_rad));
        for (Index x = 0; x < 4; ++x) {
          EXPECT_NEAR(by_theta[k][x], (after.tip_quaternion()[x] - before.tip_quaternion()[x]) / (2.0 * kStep_rad),
                      1e-7);
        }
        const auto slope_after = after.tip_quaternion_by_theta(), slope_before = before.tip_quaternion_by_theta();
        for (Index j = 0; j <= k; ++j) {
          const double slope = (dot4(weight, slope_after[j]) - dot4(weight, slope_before[j])) / (2.0 * kStep_rad);
          EXPECT_NEAR(hessian[k][j], slope, 1e-6);
        }
      }
    }
  }
}

TEST(CableDerivatives, AreTheCoresLengthsAndTheCentralDifferences) {
  for (const RobotParams& table : {zhu2022::table(), zhu2022::uneven_table()}) {
    zhu2022::Random random(4);
    for (int i = 0; i < 40; ++i) {
      const ThetaVector theta = pose_of_case(random, table, i);
      const CableDerivatives here = cable_derivatives(table, theta);
      const CableGeometry core = cable_geometry(table, cable_layout(table), arm_trig(table, theta));
      for (Index c = 0; c < here.length_m.size(); ++c) EXPECT_NEAR(here.length_m[c], core.length_m[c], 1e-12);
      for (Index k = 0; k < Index(table.theta_count()); ++k) {
        const CableDerivatives after = cable_derivatives(table, moved(theta, k, kStep_rad));
        const CableDerivatives before = cable_derivatives(table, moved(theta, k, -kStep_rad));
        for (Index c = 0; c < here.length_m.size(); ++c) {
          if (k / 2 >= here.by_segment_m[c].size()) continue;
          const Jet &part = here.by_segment_m[c][k / 2], &a = after.by_segment_m[c][k / 2],
                    &b = before.by_segment_m[c][k / 2];
          EXPECT_NEAR(first(part, k % 2), (after.length_m[c] - before.length_m[c]) / (2.0 * kStep_rad), 1e-7);
          for (Index j = 0; j < 2; ++j)
            EXPECT_NEAR(second(part, k % 2, j), (first(a, j) - first(b, j)) / (2.0 * kStep_rad), 1e-6);
        }
      }
    }
  }
}

}  // namespace
}  // namespace liana::planner
