// Cable map: path lengths from plain geometry, derivatives, wrap angles.
#include "firmware_like/cable/arm/cables.hpp"

#include <gtest/gtest.h>

#include "firmware_like/math/pose.hpp"
#include "tests/firmware_like/pose_of_arm.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::cable {
namespace {

using zhu2022::Random;

// The same path measured with a string: hole to hole, joint by joint, in the order of the physical axes.
double string_length_m(const RobotParams& robot, const ThetaVector& theta, std::size_t own_segment, double phase_rad) {
  const double r = robot.segment[own_segment].hole_radius_m, y = r * std::cos(phase_rad), z = r * std::sin(phase_rad);
  double sum = 0.0;
  for (std::size_t m = 0; m <= own_segment; ++m) {
    const double g = robot.segment[m].face_offset_m;
    const Quat pitch = quaternion_of({0.0, 0.0, theta[2 * m]}), yaw = quaternion_of({0.0, theta[2 * m + 1], 0.0});
    for (std::int32_t k = 0; k < robot.segment[m].modules; ++k) {
      const Quat joint = k % 2 == 0 ? multiply(pitch, yaw) : multiply(yaw, pitch);
      sum += norm(subtract(rotate(joint, {g, y, z}), {-g, y, z}));
      const bool is_last = k + 1 == robot.segment[m].modules;
      if (is_last && m == own_segment) break;  // the anchor
      sum += robot.segment[m].module_length_m - g - (is_last ? robot.segment[m + 1].face_offset_m : g);
    }
  }
  return sum;
}

// req:A11
TEST(Cables, LengthsAreThoseOfAStringThroughTheHoles) {
  for (const RobotParams& robot : {zhu2022::table(), zhu2022::uneven_table()}) {
    Random random(1);
    for (std::int32_t i = 0; i < 200; ++i) {
      const ThetaVector theta = random.theta(robot, 20.0);
      const CableGeometry geometry = geometry_at(robot, theta);
      std::size_t cable = 0;
      for (std::size_t m = 0; m < static_cast<std::size_t>(robot.segment_count); ++m) {
        for (std::int32_t c = 0; c < robot.segment[m].cables; ++c, ++cable) {
          const double phase = robot.segment[m].cable_phase_rad[static_cast<std::size_t>(c)];
          ASSERT_NEAR(geometry.length_m[cable], string_length_m(robot, theta, m, phase), 1e-13) << cable;
        }
      }
    }
  }
}

TEST(Cables, PartsAddUpToTheLength) {
  const RobotParams robot = zhu2022::uneven_table();
  Random random(2);
  const CableGeometry geometry = geometry_at(robot, random.theta(robot, 20.0));
  for (std::size_t c = 0; c < 10; ++c) {
    double sum = 0.0;
    for (double part : geometry.part_m[c]) sum += part;
    EXPECT_NEAR(sum, geometry.length_m[c], 1e-15) << c;
  }
}

// req:A5
TEST(Cables, ZeroLengthIsTheStraightWayToTheLastDisc) {
  const RobotParams robot = zhu2022::table();
  const CableLayout layout = cable_layout(robot);
  for (std::size_t c = 0; c < zhu2022::kCables; ++c) {
    const double modules = 8.0 * static_cast<double>(c / 3 + 1);
    // From the first disc, one offset before the first joint, to the disc one offset after the last joint.
    EXPECT_NEAR(layout.zero_length_m[c], 0.1 * (modules - 1.0) + 0.02, 1e-14);
    EXPECT_NEAR(geometry_at(robot, ThetaVector{}).length_m[c], layout.zero_length_m[c], 1e-14);
  }
}

TEST(Cables, JacobianEqualsFiniteDifferencesAtZeroNearZeroAndElsewhere) {
  constexpr double kStep = 1e-5;
  for (const RobotParams& robot : {zhu2022::table(), zhu2022::uneven_table()}) {
    Random random(3);
    for (std::int32_t i = 0; i < 100; ++i) {
      const ThetaVector theta = i == 0 ? ThetaVector{} : random.theta(robot, i < 10 ? 1e-8 / kDegree : 20.0);
      const CableGeometry geometry = geometry_at(robot, theta);
      for (std::size_t k = 0; k < static_cast<std::size_t>(robot.theta_count()); ++k) {
        ThetaVector more = theta, less = theta;
        more[k] += kStep, less[k] -= kStep;
        const CableGeometry a = geometry_at(robot, less), b = geometry_at(robot, more);
        for (std::size_t c = 0; c < static_cast<std::size_t>(robot.cable_count()); ++c) {
          ASSERT_NEAR(geometry.jacobian_m_rad[c][k], (b.length_m[c] - a.length_m[c]) / (2.0 * kStep), 2e-9)
              << c << " " << k;
        }
      }
    }
  }
}

TEST(Cables, SegmentsBehindTheAnchorDoNotTouchACable) {
  const RobotParams robot = zhu2022::table();
  Random random(4);
  const CableGeometry geometry = geometry_at(robot, random.theta(robot, 20.0));
  for (std::size_t c = 0; c < zhu2022::kCables; ++c) {
    for (std::size_t j = c / 3 + 1; j < kMaxSegments; ++j) {
      EXPECT_EQ(geometry.part_m[c][j], 0.0);
      EXPECT_EQ(geometry.jacobian_m_rad[c][2 * j], 0.0);
      EXPECT_EQ(geometry.jacobian_m_rad[c][2 * j + 1], 0.0);
    }
  }
}

// The lengths of three cables do not sum to a constant: that is why angles from lengths are a least-squares problem
// (mission, A3).
TEST(Cables, ThreeLengthsOfABentSegmentDoNotSumToTheStraightOnes) {
  const RobotParams robot = zhu2022::table();
  ThetaVector theta{};
  theta[0] = 15.0 * kDegree;
  const CableGeometry bent = geometry_at(robot, theta), straight = geometry_at(robot, ThetaVector{});
  double excess = 0.0;
  for (std::size_t c = 0; c < 3; ++c) excess += bent.length_m[c] - straight.length_m[c];
  EXPECT_GT(std::fabs(excess), 1e-3);
}

TEST(Cables, WrapIsTheBendOfAllJointsOfTheSegment) {
  const RobotParams robot = zhu2022::uneven_table();
  Random random(5);
  for (std::int32_t i = 0; i < 100; ++i) {
    const ThetaVector theta = random.theta(robot, 20.0);
    const SegmentVector wrap_rad = cable_wraps(robot, arm_trig(robot, theta));
    for (std::size_t m = 0; m < 3; ++m) {
      const double bend = std::acos(std::cos(theta[2 * m]) * std::cos(theta[2 * m + 1]));
      ASSERT_NEAR(wrap_rad[m], robot.segment[m].modules * bend, 1e-12);
    }
  }
  for (double wrap : cable_wraps(robot, arm_trig(robot, ThetaVector{}))) EXPECT_EQ(wrap, 0.0);
}

}  // namespace
}  // namespace liana::cable
