#include "host/control/server/emergency_stop.hpp"

#include <gtest/gtest.h>

#include "host/base/json/json.hpp"
#include "tests/message.hpp"

namespace liana::server {
namespace {

std::string reason_of(const Json& reason) { return stop_reason(&reason); }

TEST(EmergencyStop, TheFirstOneStaysUntilItIsReleased) {
  EmergencyStop stop;
  EXPECT_FALSE(stop.order());
  stop.press({"ann", "first", 5});
  stop.press({"bob", "second", 9});
  ASSERT_TRUE(stop.order());
  EXPECT_TRUE(names(text_of(*stop.order()), {"emergency stop", "ann", "first"}));
  EXPECT_EQ(stop.order()->tick, 5u);
  stop.release();
  EXPECT_FALSE(stop.order());
}

TEST(EmergencyStop, TakesAnythingAsItsReason) {
  EXPECT_EQ(stop_reason(nullptr), "");
  EXPECT_EQ(reason_of(nullptr), "");
  EXPECT_EQ(reason_of(""), "");
  EXPECT_EQ(reason_of(7), "7");
  EXPECT_EQ(reason_of({1, "a"}), "[1,\"a\"]");
  EXPECT_EQ(reason_of(std::string(10'000'000, 'x')), std::string(200, 'x'));
}

TEST(EmergencyStop, AReasonIsShownOnOneLineWithoutTerminalEscapes) {
  EXPECT_EQ(printable("a\nb\x1b[31m\x7f"), "a b [31m ");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            " 31m")
      << "the one-byte escape of C1, as UTF-8";
  EXPECT_EQ(printable("caf\xc3\xa9 12\xc2\xb0"), "caf\xc3\xa9 12\xc2\xb0");
  EXPECT_EQ(printable("\xff\xc0\xaf\xed\xa0\x80\xe2\x82"), "????????") << "no UTF-8, too long a form, surrogate, cut";
  EXPECT_EQ(printable(std::string(199, 'x') + "\xc2\xb0").size(), 199u) << "no character is cut in two";
}

}  // namespace
}  // namespace liana::server
