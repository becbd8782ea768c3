// The state as Prometheus reads it.
#include "host/apps/gateway/metrics.hpp"

#include <gtest/gtest.h>

#include "host/base/json/json.hpp"

namespace liana::gateway {
namespace {

bool has_line(const std::string& text, const std::string& line) {
  return ("\n" + text).find("\n" + line + "\n") != std::string::npos;
}

TEST(Metrics, SayThatLianadIsAwayWithoutAState) {
  const std::string text = metrics_text(Json(), 2);
  EXPECT_TRUE(has_line(text, "liana_up 0"));
  EXPECT_TRUE(has_line(text, "liana_gateway_clients 2"));
  EXPECT_EQ(text.find("liana_state"), std::string::npos);
}

TEST(Metrics, NameEveryLatchedFaultAndTakeNoTextForAnEndOfALabel) {
  const Json fault{{"number", 3002}, {"name", "drive_silent"}, {"where", "a \"quoted\" \\ place\nhere"}};
  const std::string text = metrics_text({{"state", "FAULT"}, {"faults", Json::array({fault})}}, 0);
  EXPECT_TRUE(has_line(text, "liana_faults 1"));
  EXPECT_TRUE(has_line(text, R"(liana_fault{number="3002",name="drive_silent",where="a \"quoted\" \\ place here"} 1)"));
  EXPECT_TRUE(has_line(text, R"(liana_state{state="FAULT"} 1)"));
  EXPECT_TRUE(has_line(text, R"(liana_state{state="ENABLED"} 0)"));
}

TEST(Metrics, LeaveOutWhatTheStateDoesNotHave) {
  const std::string text =
      metrics_text({{"state", "ENABLED"}, {"tick_us", 250}, {"tension_N", {nullptr, 40.5}}, {"overruns", nullptr}}, 0);
  EXPECT_TRUE(has_line(text, "liana_tick_seconds 0.00025"));
  EXPECT_TRUE(has_line(text, R"(liana_tension_newtons{cable="2"} 40.5)"));
  EXPECT_EQ(text.find("cable=\"1\""), std::string::npos);
  EXPECT_EQ(text.find("overruns"), std::string::npos);
}

}  // namespace
}  // namespace liana::gateway
