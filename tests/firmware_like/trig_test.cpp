// Own elementary functions against long double libm, over the ranges and with the errors that trig.hpp states.
#include "firmware_like/math/trig.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/firmware_like/zhu2022.hpp"

namespace liana {
namespace {

namespace zhu2022 = cable::zhu2022;

struct TrigError {
  double sin, cos;
};

TrigError trig_error(double x) {
  const SinCos own = sin_cos(x);
  return {static_cast<double>(fabsl(own.sin - sinl(x))), static_cast<double>(fabsl(own.cos - cosl(x)))};
}

TEST(Trig, SineAndCosineAreExactTo3e16WithinAnEighthTurn) {
  constexpr std::int32_t kSteps = 200000;
  for (std::int32_t i = -kSteps; i <= kSteps; ++i) {
    const double x = kPi / 4.0 * i / kSteps;
    const TrigError error = trig_error(x);
    ASSERT_LE(error.sin, 3e-16) << x;
    ASSERT_LE(error.cos, 3e-16) << x;
  }
}

TEST(Trig, SineAndCosineAreExactTo1e13OverThousandRadians) {
  zhu2022::Random random(1);
  for (std::int32_t i = 0; i < 300000; ++i) {
    const double x = random.uniform(-1000.0, 1000.0);
    const TrigError error = trig_error(x);
    ASSERT_LE(error.sin, 1e-13) << x;
    ASSERT_LE(error.cos, 1e-13) << x;
  }
}

TEST(Trig, QuadrantBordersAreAsGoodAsTheRest) {
  for (std::int32_t k = -636; k <= 636; ++k) {
    for (const double offset : {-1e-9, -1e-16, 0.0, 1e-16, 1e-9}) {
      const double x = k * (kPi / 4.0) * 1.0 + offset;
      const TrigError error = trig_error(x);
      ASSERT_LE(std::max(error.sin, error.cos), 1e-13) << x;
    }
  }
}

TEST(Trig, SineIsOddAndCosineIsEvenToTheLastBit) {
  zhu2022::Random random(2);
  for (std::int32_t i = 0; i < 10000; ++i) {
    const double x = random.uniform(0.0, 100.0);
    ASSERT_EQ(sin_cos(-x).sin, -sin_cos(x).sin) << x;
    ASSERT_EQ(sin_cos(-x).cos, sin_cos(x).cos) << x;
  }
}

TEST(Trig, ArgumentsOutsideTheRangeGiveTheStatedValue) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  for (const double x : {1000.1, -1000.1, 1e300, kInf, -kInf, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(sin_cos(x).sin, 0.0) << x;
    EXPECT_EQ(sin_cos(x).cos, 1.0) << x;
  }
}

TEST(Trig, ArcTangentIsExactTo1e15AllRoundAtEveryRadius) {
  zhu2022::Random random(3);
  for (std::int32_t i = 0; i < 300000; ++i) {
    const double angle = random.uniform(-kPi, kPi);
    const double radius = std::pow(10.0, random.uniform(-12.0, 12.0));
    const double y = radius * std::sin(angle), x = radius * std::cos(angle);
    ASSERT_LE(static_cast<double>(fabsl(arc_tangent(y, x) - atan2l(y, x))), 1e-15) << y << " " << x;
  }
}

TEST(Trig, ArcTangentIsRightOnTheAxesAndAtTheOrigin) {
  EXPECT_EQ(arc_tangent(0.0, 0.0), 0.0);
  EXPECT_EQ(arc_tangent(0.0, 1.0), 0.0);
  EXPECT_DOUBLE_EQ(arc_tangent(0.0, -1.0), kPi);
  EXPECT_DOUBLE_EQ(arc_tangent(1.0, 0.0), kPi / 2.0);
  EXPECT_DOUBLE_EQ(arc_tangent(-1.0, 0.0), -kPi / 2.0);
}

TEST(Trig, ExponentialIsExactTo1e14BetweenMinusFourAndFour) {
  for (std::int32_t i = -100000; i <= 100000; ++i) {
    const double x = 4.0 * i / 100000;
    ASSERT_LE(static_cast<double>(fabsl(exponential(x) / expl(x) - 1.0L)), 1e-14) << x;
  }
}

TEST(Trig, ExponentialStopsAtTheEndsOfItsRange) {
  EXPECT_EQ(exponential(7.0), exponential(4.0));
  EXPECT_EQ(exponential(-1e9), exponential(-4.0));
}

}  // namespace
}  // namespace liana
