#include "host/base/svg/svg.hpp"

#include <gtest/gtest.h>

namespace liana::svg {
namespace {

TEST(Svg, TextCannotBreakTheDocument) {
  EXPECT_EQ(escaped("a<b & \"c\" > d"), "a&lt;b &amp; &quot;c&quot; &gt; d");
  EXPECT_EQ(escaped(std::string("a\x01\tb\n", 5)), "a  b\n");
  Svg svg(10, 10, "</title><script>");
  svg.text({1, 2}, "</text>");
  EXPECT_EQ(svg.document().find("<script>"), std::string::npos);
  EXPECT_NE(svg.document().find("&lt;/text&gt;"), std::string::npos);
}

TEST(Svg, NumbersAreShortAndNeverMinusZero) {
  EXPECT_EQ(short_number(1.25, 1), "1.2");
  EXPECT_EQ(short_number(3.0, 3), "3");
  EXPECT_EQ(short_number(100.0, 0), "100");
  EXPECT_EQ(short_number(-0.04, 1), "0");
  EXPECT_EQ(short_number(-2.5, 2), "-2.5");
}

TEST(Svg, BarsOfOneColourAreOneElement) {
  Svg svg(100, 100, "t");
  const std::size_t empty = svg.document().size();
  svg.bars({}, 5.0, "red");
  EXPECT_EQ(svg.document().size(), empty);
  svg.bars({{{1.0, 2.5}, 10.0}, {{20.0, 2.5}, 5.0}}, 5.0, "red");
  EXPECT_NE(svg.document().find("d=\"M1 2.5h10M20 2.5h5\""), std::string::npos);
}

TEST(Svg, ALineNeedsTwoPoints) {
  Svg svg(100, 100, "t");
  svg.polyline({{1, 1}}, {.stroke = "red"});
  EXPECT_EQ(svg.document().find("polyline"), std::string::npos);
  svg.polyline({{1, 1}, {2, 3}}, {.stroke = "red"});
  EXPECT_NE(svg.document().find("points=\"1,1 2,3\""), std::string::npos);
}

}  // namespace
}  // namespace liana::svg
