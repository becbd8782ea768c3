#include "host/planning/error_budget/budget.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "host/base/json/json.hpp"
#include "host/planning/error_budget/monte_carlo.hpp"
#include "tests/message.hpp"

namespace liana::error_budget {
namespace {

constexpr double kMillimetre = 1e-3;

Json table() {
  return Json::parse(R"({"format":1,"kind":"budget","name":"paper",
    "open_loop":{"errors":[{"name":"macro","position_m":0.05,"angle_deg":1},
                           {"name":"micro","position_m":0.01,"angle_deg":1}],
                 "terms":[{"name":"a","positions":["macro"],"angles":["macro"],"lever_m":5},
                          {"name":"b","positions":["micro"]},
                          {"name":"c","angles":["macro","micro"],"lever_m":1}]},
    "closed_loop":{"errors":[{"name":"camera","position_m":0.002,"angle_deg":0.2},
                             {"name":"micro","position_m":0.005,"angle_deg":0.1}],
                   "terms":[{"name":"d","positions":["camera","micro"]},
                            {"name":"e","angles":["camera","micro"],"lever_m":1}]}})");
}

config::ErrorBudget paper() { return config::parse_error_budget(table(), "paper"); }

std::string refusal_of(const Json& changed) {
  try {
    config::parse_error_budget(changed, "paper");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "accepted";
}

// req:B8
TEST(ErrorBudget, TheChainOfTheSourceIs142MillimetresBesideItsGoal) {
  // sqrt((50 + 5000 sin 1 deg)^2 + 10^2 + (1000 sin 2 deg)^2)
  EXPECT_NEAR(readings_of(paper().open_loop).terms, 141.98 * kMillimetre, 0.005 * kMillimetre);
}

// req:B9
TEST(ErrorBudget, LedByTheCameraItIsLessThan20Millimetres) {
  // sqrt((2 + 5)^2 + (1000 sin 0.3 deg)^2)
  EXPECT_NEAR(readings_of(paper().closed_loop).terms, 8.741 * kMillimetre, 0.001 * kMillimetre);
}

// req:B7
TEST(ErrorBudget, AnAngleCountsOverTheLengthAfterIt) {
  const config::ErrorLoop loop = paper().open_loop;
  EXPECT_NEAR(size_m(loop, loop.terms[0]), 137.262 * kMillimetre, 0.001 * kMillimetre);
  EXPECT_NEAR(size_m(loop, loop.terms[1]), 10.0 * kMillimetre, 1e-12);
  EXPECT_NEAR(size_m(loop, loop.terms[2]), 34.899 * kMillimetre, 0.001 * kMillimetre);
}

// req:B8
TEST(ErrorBudget, TheOtherReadingsOfTheSourceAreThere) {
  const Readings readings = readings_of(paper().open_loop);
  EXPECT_NEAR(readings.sum, 182.16 * kMillimetre, 0.01 * kMillimetre);
  EXPECT_NEAR(readings.apart, 106.92 * kMillimetre, 0.05 * kMillimetre);
  EXPECT_NEAR(readings.independent, 141.68 * kMillimetre, 0.05 * kMillimetre);
}

// req:B8
TEST(ErrorBudget, ByChance95PercentStayWithinWhatTheFormulaSays) {
  const Spread spread = draw(paper().open_loop, 200000, 7);
  EXPECT_NEAR(spread.p95_m, 144 * kMillimetre, 1.5 * kMillimetre);
  EXPECT_NEAR(spread.within_formula, 0.945, 0.005);
  EXPECT_LT(spread.median_m, spread.p95_m);
  EXPECT_LT(spread.p95_m, spread.worst_m);
}

// req:B9
TEST(ErrorBudget, ByChanceNothingLedByTheCameraComesTo20Millimetres) {
  EXPECT_LT(draw(paper().closed_loop, 200000, 7).worst_m, 20 * kMillimetre);
}

TEST(ErrorBudget, TheSameSeedDrawsTheSame) {
  const Spread one = draw(paper().open_loop, 1000, 3), again = draw(paper().open_loop, 1000, 3);
  const Spread other = draw(paper().open_loop, 1000, 4);
  EXPECT_EQ(one.p95_m, again.p95_m);
  EXPECT_NE(one.p95_m, other.p95_m);
}

TEST(ErrorBudget, OneErrorInTwoTermsIsDrawnOnce) {
  config::ErrorLoop loop;
  loop.errors = {{"only", 0.01, 0.0}};
  loop.terms = {{"once", {0}, {}, 0.0}, {"again", {0}, {}, 0.0}};
  config::ErrorLoop single = loop;
  single.terms.pop_back();
  EXPECT_DOUBLE_EQ(draw(loop, 1000, 1).worst_m, 2.0 * draw(single, 1000, 1).worst_m);
}

struct Refused {
  const char* path;
  const char* value;
  Facts facts;
};

class BadBudget : public testing::TestWithParam<Refused> {};

TEST_P(BadBudget, IsRefusedWithFieldValueAndWhatIsAllowed) {
  Json changed = table();
  Json* at = &changed["open_loop"];
  const std::string path = GetParam().path;
  if (path == "errors") {
    (*at)["errors"] = Json::parse(GetParam().value);
  } else if (path == "terms") {
    (*at)["terms"] = Json::parse(GetParam().value);
  } else {
    changed[path] = Json::parse(GetParam().value);
  }
  EXPECT_TRUE(names(refusal_of(changed), GetParam().facts));
}

INSTANTIATE_TEST_SUITE_P(
    Tables, BadBudget,
    testing::Values(Refused{"errors", R"([])", {"open_loop.errors"}},
                    Refused{"errors", R"([{"name":"macro","position_m":-1}])", {"position_m"}},
                    Refused{"errors", R"([{"name":"macro","angle_deg":31}])", {"angle_deg", "31", "0", "30"}},
                    Refused{"errors", R"([{"name":"macro"},{"name":"macro"}])", {"name", "macro"}},
                    Refused{"errors", R"([{"name":"macro","metres":1}])", {"metres"}},
                    Refused{"terms", R"([{"name":"a","positions":["nobody"]}])", {"macro", "micro"}},
                    Refused{"terms", R"([{"name":"a","positions":["macro","macro"]}])", {"positions[2]", "macro"}},
                    Refused{"terms", R"([{"name":"a","angles":["macro"]}])", {"angles", "lever_m"}},
                    Refused{"terms", R"([{"name":"a","lever_m":2,"positions":["macro"]}])", {"angles", "lever_m"}},
                    Refused{"terms", R"([{"name":"a"}])", {"positions", "angles"}},
                    Refused{"terms", R"([{"name":"a","positions":"macro"}])", {"positions"}},
                    Refused{"kind", R"("robot")", {"kind"}}));

}  // namespace
}  // namespace liana::error_budget
