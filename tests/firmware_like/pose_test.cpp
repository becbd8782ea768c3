// Poses and quaternions.
#include "firmware_like/math/pose.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "firmware_like/math/slow_directions.hpp"
#include "tests/firmware_like/extremes.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana {
namespace {

namespace zhu2022 = cable::zhu2022;

using zhu2022::largest_difference;
using zhu2022::Random;

Quat random_quaternion(Random& random) { return quaternion_of(random.vector(1.7)); }

TEST(Pose, RotationVectorsGoThroughQuaternionsAndBack) {
  Random random(1);
  for (std::int32_t i = 0; i < 20000; ++i) {
    const Vec3 axis = random.vector(1.0);
    const double angle = random.uniform(0.0, kPi - 1e-6);
    const Vec3 turn = scale(axis, angle / norm(axis));
    ASSERT_LE(largest_difference(rotation_vector(quaternion_of(turn)), turn), 1e-12);
  }
}

TEST(Pose, TinyRotationsKeepTheirSizeAndDirection) {
  for (const double angle : {1e-3, 1e-8, 1e-11, 9e-13, 1e-13, 1e-18}) {
    const Vec3 turn{angle, -2.0 * angle, 0.5 * angle};
    ASSERT_LE(largest_difference(rotation_vector(quaternion_of(turn)), turn), 1e-12 * angle + 1e-30) << angle;
  }
  EXPECT_EQ(rotation_vector(quaternion_of({0.0, 0.0, 0.0})), (Vec3{0.0, 0.0, 0.0}));
}

TEST(Pose, RotationVectorTakesTheShorterWayRound) {
  const Quat q = quaternion_of({0.0, 0.0, 0.3});
  const Quat other{-q[0], -q[1], -q[2], -q[3]};
  EXPECT_LE(largest_difference(rotation_vector(other), {0.0, 0.0, 0.3}), 1e-15);
  EXPECT_LE(norm(rotation_vector(quaternion_of({0.0, 4.0, 0.0}))), kPi);
}

TEST(Pose, RotateAgreesWithTheQuaternionProduct) {
  Random random(2);
  for (std::int32_t i = 0; i < 5000; ++i) {
    const Quat q = random_quaternion(random);
    const Vec3 v = random.vector(2.0);
    const Quat product = multiply(multiply(q, {0.0, v[0], v[1], v[2]}), conjugate(q));
    ASSERT_LE(largest_difference(rotate(q, v), {product[1], product[2], product[3]}), 1e-14);
  }
}

TEST(Pose, ComposingWithTheInverseGivesTheIdentity) {
  Random random(3);
  for (std::int32_t i = 0; i < 5000; ++i) {
    const Pose pose{random.vector(4.0), random_quaternion(random)};
    const Pose identity = compose(pose, inverse(pose));
    ASSERT_LE(norm(identity.position_m), 1e-14);
    ASSERT_LE(norm(rotation_vector(identity.quaternion)), 1e-14);
  }
}

TEST(Pose, ComposeChainsFramesInOrder) {
  const Pose turned{{1.0, 0.0, 0.0}, quaternion_of({0.0, 0.0, kPi / 2.0})};
  const Pose out = compose(turned, {{2.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}});
  EXPECT_LE(largest_difference(out.position_m, {1.0, 2.0, 0.0}), 1e-15);
}

TEST(Pose, NormalizeTurnsWhatHasNoDirectionIntoTheIdentity) {
  const Quat identity{1.0, 0.0, 0.0, 0.0};
  EXPECT_EQ(normalize({0.0, 0.0, 0.0, 0.0}), identity);
  EXPECT_EQ(normalize({kNan, 0.0, 0.0, 0.0}), identity);
  EXPECT_EQ(normalize({kInf, 1.0, 0.0, 0.0}), identity);
  EXPECT_EQ(normalize({0.0, 3.0, 0.0, 0.0}), (Quat{0.0, 1.0, 0.0, 0.0}));
}

TEST(Pose, ValidMeansFiniteAndOfUnitLength) {
  EXPECT_TRUE(is_valid(Pose{}));
  EXPECT_TRUE(is_valid({{1e300, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}}));
  for (const double bad : {kNan, kInf, -kInf}) {
    for (std::size_t i = 0; i < 3; ++i) {
      Pose pose;
      pose.position_m[i] = bad;
      EXPECT_FALSE(is_valid(pose)) << i;
    }
    for (std::size_t i = 0; i < 4; ++i) {
      Pose pose;
      pose.quaternion[i] = bad;
      EXPECT_FALSE(is_valid(pose)) << i;
    }
  }
  EXPECT_TRUE(is_valid({{}, {1.0 + 0.9e-6, 0.0, 0.0, 0.0}}));
  EXPECT_FALSE(is_valid({{}, {1.0 + 1.1e-6, 0.0, 0.0, 0.0}}));
  EXPECT_FALSE(is_valid({{}, {1.0 - 1.1e-6, 0.0, 0.0, 0.0}}));
  EXPECT_FALSE(is_valid({{}, {0.0, 0.0, 0.0, 0.0}}));
}

// Symmetric matrices of every size and shape, the zero matrix and those with equal eigenvalues among them.
TEST(SlowDirections, EigenvectorsOfASymmetricMatrixAreUnitVectorsAtRightAnglesThatItOnlyStretches) {
  Random random(7);
  for (std::int32_t i = 0; i < 2000; ++i) {
    const double size = std::pow(10.0, i % 13 - 6);
    const Vec3 a = i == 0 ? Vec3{} : random.vector(size);
    const Vec3 b = i % 5 == 0 ? Vec3{} : random.vector(i % 3 == 0 ? 1e-3 * size : size);
    const double even = i % 7 == 6 ? size : 0.0;
    Symmetric3 matrix{};
    std::size_t element = 0;
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t s = 0; s <= r; ++s) matrix[element++] = a[r] * a[s] + b[r] * b[s] + (r == s ? even : 0.0);
    }
    const std::array<Vec3, 3> vectors = eigenvectors(matrix);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& v = vectors[k];
      EXPECT_NEAR(dot(v, v), 1.0, 1e-12) << i;
      EXPECT_NEAR(dot(v, vectors[(k + 1) % 3]), 0.0, 1e-12) << i;
      const Vec3 image = add(add(scale(a, dot(a, v)), scale(b, dot(b, v))), scale(v, even));
      EXPECT_LE(norm(subtract(image, scale(v, dot(image, v)))), 1e-12 * (size * size + size)) << i;
    }
  }
}

TEST(SlowDirections, LeaveOfAMotionItsShareAlongEachAxis) {
  SlowDirections slow;
  EXPECT_TRUE(is_even(slow));
  slow.axis = eigenvectors({1.0, 0.5, 2.0, 0.1, -0.7, 3.0});
  slow.share = {1e-6, 1.0, 0.3};
  EXPECT_FALSE(is_even(slow));
  Random random(8);
  for (std::int32_t i = 0; i < 100; ++i) {
    const Vec3 motion = random.vector(0.1), left = slowed(slow, motion);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(dot(slow.axis[k], left), slow.share[k] * dot(slow.axis[k], motion), 1e-15) << i;
    }
  }
}

}  // namespace
}  // namespace liana
