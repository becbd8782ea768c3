#include "host/reach/spectrum.hpp"

#include <gtest/gtest.h>

#include "tests/firmware_like/zhu2022.hpp"

namespace liana {
namespace {

TEST(Spectrum, OfADiagonalIsItsEntriesInFallingOrder) {
  ThetaRows<3> rows{};
  rows[0][4] = 2.0, rows[1][1] = -7.0, rows[2][0] = 0.5;
  const Spectrum<3> s = spectrum(rows);
  EXPECT_EQ(s.value, (std::array<double, 3>{7.0, 2.0, 0.5}));
  EXPECT_EQ(std::fabs(s.axis[0][1]), 1.0);
}

TEST(Spectrum, AxesAreOrthonormalAndEveryValueIsWhatItsAxisLetsThrough) {
  zhu2022::Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    ThetaRows<6> rows{};
    for (auto& row : rows) {
      for (double& x : row) x = random.uniform(-1.0, 1.0);
    }
    const Spectrum<6> s = spectrum(rows);
    for (std::size_t i = 0; i < 6; ++i) {
      std::array<double, kMaxTheta> through{};
      for (std::size_t row = 0; row < 6; ++row) through = zhu2022::plus(through, rows[row], s.axis[i][row]);
      EXPECT_NEAR(zhu2022::length(through), s.value[i], 1e-12);
      for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(inner_product(s.axis[i], s.axis[k]), i == k ? 1.0 : 0.0, 1e-12);
      EXPECT_LE(s.value[i], i == 0 ? s.value[0] : s.value[i - 1]);
    }
  }
}

TEST(Spectrum, FindsASmallValueBesideLargeOnesToManyDigits) {
  ThetaRows<3> rows{};
  rows[0] = {1.0, 1.0};
  rows[1] = {1.0, 1.0, 1e-10};  // values sqrt(4), 1e-10 / sqrt(2) to first order, 0
  const Spectrum<3> s = spectrum(rows);
  EXPECT_NEAR(s.value[0], 2.0, 1e-14);
  EXPECT_NEAR(s.value[1] / (1e-10 / std::sqrt(2.0)), 1.0, 1e-5);
  EXPECT_EQ(s.value[2], 0.0);
}

}  // namespace
}  // namespace liana
