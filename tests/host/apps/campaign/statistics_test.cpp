// Intervals against the binomial distribution itself, quantiles, and the order of the worst rows.
#include "host/apps/campaign/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace liana::campaign {
namespace {

// P(X >= k) of n throws that each succeed with p, by its sum.
double at_least(std::uint64_t k, std::uint64_t n, double p) {
  double sum = 0.0;
  for (std::uint64_t i = k; i <= n; ++i) {
    const auto a = static_cast<double>(i), b = static_cast<double>(n);
    sum += std::exp(std::lgamma(b + 1) - std::lgamma(a + 1) - std::lgamma(b - a + 1) + a * std::log(p) +
                    (b - a) * std::log1p(-p));
  }
  return sum;
}

StoredRow row(std::uint64_t number, const std::string& outcome, double clearance_m) {
  StoredRow out;
  out.result.number = number;
  out.result.outcome = outcome;
  out.result.figures = {{"min_clearance_m", clearance_m}};
  return out;
}

TEST(ExactShare, HasBoundsAtWhichTheTailIsHalfOfWhatIsLeft) {
  for (const std::uint64_t n : {1u, 2u, 10u, 37u, 1000u}) {
    for (const std::uint64_t k : {std::uint64_t{0}, std::uint64_t{1}, n / 3, n - 1, n}) {
      const Share share = exact_share(k, n);
      if (k > 0) {
        EXPECT_NEAR(at_least(k, n, share.low), 0.025, 1e-9) << k << " of " << n;
      } else {
        EXPECT_EQ(share.low, 0.0);
      }
      if (k < n) {
        EXPECT_NEAR(1.0 - at_least(k + 1, n, share.high), 0.025, 1e-9) << k << " of " << n;
      } else {
        EXPECT_EQ(share.high, 1.0);
      }
    }
  }
}

TEST(ExactShare, IsThatOfPublishedTables) {
  EXPECT_NEAR(exact_share(5, 10).low, 0.18709, 5e-6);
  EXPECT_NEAR(exact_share(5, 10).high, 0.81291, 5e-6);
  EXPECT_NEAR(exact_share(0, 10).high, 0.30850, 5e-6);
  EXPECT_NEAR(exact_share(1000, 1000).low, 0.99632, 5e-6);
}

TEST(ExactShare, OfNothingSaysNothing) {
  const Share none = exact_share(0, 0);
  EXPECT_EQ(none.low, 0.0);
  EXPECT_EQ(none.high, 1.0);
  EXPECT_EQ(none.value(), 0.0);
}

TEST(Spreads, LieBetweenNeighboursInAStraightLine) {
  const Spread spread = spread_of({4, 1, 3, 2, 5});
  EXPECT_DOUBLE_EQ(spread.least, 1.0);
  EXPECT_DOUBLE_EQ(spread.p05, 1.2);
  EXPECT_DOUBLE_EQ(spread.p25, 2.0);
  EXPECT_DOUBLE_EQ(spread.median, 3.0);
  EXPECT_DOUBLE_EQ(spread.p95, 4.8);
  EXPECT_DOUBLE_EQ(spread.most, 5.0);
  EXPECT_DOUBLE_EQ(spread_of({7}).p95, 7.0);
}

TEST(WorstRows, BeginWithFailuresThenTheLeastClearance) {
  const std::vector<StoredRow> rows{row(0, "success", 0.02), row(1, "failed", 0.03), row(2, "success", 0.01),
                                    row(3, "failed", 0.0), row(4, "success", 0.03)};
  std::vector<std::uint64_t> numbers;
  for (const StoredRow* each : worst_rows(rows, "min_clearance_m", 4)) numbers.push_back(each->result.number);
  EXPECT_EQ(numbers, (std::vector<std::uint64_t>{1, 3, 2, 0}));
  EXPECT_EQ(worst_rows(rows, "no such figure", 10).size(), rows.size());
}

TEST(OutcomeShares, CountEveryOutcomeAndSuccessAlways) {
  const auto shares = outcome_shares({row(0, "failed", 0), row(1, "failed", 0)});
  EXPECT_EQ(shares.at("success").count, 0u);
  EXPECT_EQ(shares.at("failed").count, 2u);
}

TEST(Figures, AreTheNumbersOfAReportByTheirPaths) {
  const Json figures = figures_of(Json::parse(
      R"({"seed":3,"tip_error_m":0.1,"outcome":"success","buses":[{"name":"can0","frames":7},{"name":"can0","frames":8}],
          "final":[1,2],"tension":{"max":116.5,"unit":"N"}})"));
  EXPECT_EQ(figures, Json::parse(R"({"tip_error_m":0.1,"buses.can0.frames":7,"tension.max":116.5})"));
}

TEST(ReportHash, LeavesOutWhereAndWhen) {
  const Json report = Json::parse(R"({"mission":"a.lua","robot":"zhu2022","overruns":0,"tip_error_m":0.1})");
  Json elsewhere = report, other = report;
  elsewhere["mission"] = "/home/b/a.lua";
  elsewhere["overruns"] = 4;
  other["tip_error_m"] = 0.2;
  EXPECT_EQ(report_hash(report), report_hash(elsewhere));
  EXPECT_NE(report_hash(report), report_hash(other));
}

}  // namespace
}  // namespace liana::campaign
