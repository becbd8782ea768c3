// Values that chance gives, and lines for a shell.
#include "host/apps/campaign/rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "host/model/config/campaign.hpp"

namespace liana::campaign {
namespace {

using config::Distribution;
using config::Drawn;

Drawn uniform(const char* key) { return {key, {{.kind = Distribution::Kind::kUniform, .low = 2.0, .high = 3.0}}}; }

TEST(DrawnValue, DependsOnSeedAndKeyAlone) {
  EXPECT_EQ(drawn_value(uniform("gravity"), 7), drawn_value(uniform("gravity"), 7));
  EXPECT_NE(drawn_value(uniform("gravity"), 7), drawn_value(uniform("gravity"), 8));
  EXPECT_NE(drawn_value(uniform("gravity"), 7), drawn_value(uniform("gravitx"), 7));
}

TEST(DrawnValue, OfAUniformDistributionFillsItsRangeEvenly) {
  double sum = 0.0;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    const double value = drawn_value(uniform("gravity"), seed).get<double>();
    ASSERT_GE(value, 2.0);
    ASSERT_LT(value, 3.0);
    sum += value;
  }
  EXPECT_NEAR(sum / 4000, 2.5, 4.0 / std::sqrt(12.0 * 4000));
}

TEST(DrawnValue, OfANormalDistributionStaysWithinItsBoundsAndNotOnThem) {
  const Drawn drawn{"linkage_error",
                    {{.kind = Distribution::Kind::kNormal, .low = 0.0, .high = 0.5, .mean = 0.0, .sd = 1.0}}};
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const double value = drawn_value(drawn, seed).get<double>();
    ASSERT_GT(value, 0.0);
    ASSERT_LT(value, 0.5);
  }
}

TEST(DrawnValue, OfAChoiceIsEachOfItsValues) {
  const Drawn drawn{"true_physics", {{.kind = Distribution::Kind::kChoice, .values = {"nominal", "worn", "ideal"}}}};
  std::set<std::string> found;
  for (std::uint64_t seed = 0; seed < 50; ++seed) found.insert(drawn_value(drawn, seed).text());
  EXPECT_EQ(found.size(), 3u);
}

TEST(DrawnValue, OfSeveralPartsHasCommasBetween) {
  Drawn drawn = uniform("scene_offset");
  drawn.parts.push_back({.kind = Distribution::Kind::kFixed, .values = {0.5}});
  const std::string text = drawn_value(drawn, 1).text();
  EXPECT_TRUE(text.starts_with("2.")) << text;
  EXPECT_TRUE(text.ends_with(",0.5")) << text;
}

TEST(ShellLine, QuotesWhatAShellWouldRead) {
  EXPECT_EQ(shell_line({"run", "--delay=0.5,0.5", "a b", "it's", "$x", ""}),
            "run --delay=0.5,0.5 'a b' 'it'\\''s' '$x' ''");
}

}  // namespace
}  // namespace liana::campaign
