// What `liana latency` says of a measurement.
#include "host/apps/report/latency_report.hpp"

#include <gtest/gtest.h>

#include "host/base/json/json.hpp"
#include "tests/message.hpp"

namespace liana::report {
namespace {

LatencyMeasurement measurement(unsigned overruns) {
  LatencyMeasurement measured;
  measured.enabled = true;
  measured.moving = 0.875;
  measured.last_state = {{"faults", Json::array()}};
  measured.timing = Json::parse(
      R"({"op":"ok","id":5,"ticks":4,"wakeup_us":{"median":3,"p99":100,"worst":100,"buckets":[[3,3],[100,1]]},
    "tick_us":{"median":40,"p99":50,"worst":50,"buckets":[[40,4]]},"overrun_causes":{"late_wake":0,"long_tick":0,"bus_wait":0,"lost_ticks":0}})");
  measured.timing["overruns"] = measured.timing["overrun_causes"]["late_wake"] = overruns;
  return measured;
}

Json report_of(const LatencyMeasurement& measured) {
  config::BusesConfig buses;
  buses.name = "embedded";
  buses.rate_hz = 250.0;
  const std::vector<Finding> realtime{{"memory locking", true, "unlimited", "", ""},
                                      {"PREEMPT_RT kernel", false, "6.1", "", "boot it"}};
  return latency_report(measured, buses, 2.0, realtime);
}

TEST(LatencyReport, HasWhatWasMeasuredAndHow) {
  const Json report = report_of(measurement(0));
  for (const char* key : {"rate_hz", "seconds", "buses", "enabled", "moving", "faults", "ticks", "wakeup_us", "tick_us",
                          "overruns", "overrun_causes", "realtime"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  EXPECT_FALSE(report.contains("op"));
  EXPECT_EQ(report["realtime"].size(), 2u);
}

TEST(LatencyReport, ComparesTheWorstWithThePeriodAndNamesWhatTheMachineLacks) {
  const std::string text = latency_text(report_of(measurement(0)));
  EXPECT_TRUE(names(text, {"2.5 %", "4000 us", "1.2 %"}));
  EXPECT_TRUE(names(text, {"no deadline"}));
  EXPECT_NE(text.find("PREEMPT_RT kernel: 6.1\n    to do: boot it"), std::string::npos) << text;
  EXPECT_EQ(text.find("memory locking"), std::string::npos) << text;
  EXPECT_EQ(text.find("NOT ENABLED"), std::string::npos) << text;
  EXPECT_TRUE(names(text, {"moved", "88 %"}));
}

TEST(LatencyReport, SaysLoudlyWhenDeadlinesWereMissedOrTheArmWasOff) {
  LatencyMeasurement measured = measurement(2);
  measured.enabled = false;
  const Json silent{{"number", 3002}, {"name", "drive_silent"}, {"where", "drive 3 (node 3, segment 1)"}};
  Json other = silent;
  other["where"] = "drive 4 (node 4, segment 2)";
  measured.last_state["faults"] = {silent, other};
  const std::string text = latency_text(report_of(measured));
  EXPECT_TRUE(names(text, {"deadlines missed: 2"}));
  EXPECT_NE(text.find("NOT ENABLED"), std::string::npos) << text;
  EXPECT_TRUE(names(text, {"fault 3002", "drive_silent", "drives 3", "4 (node 4, segment 2)"}));
}

TEST(LatencyReport, BinsDoubleAndTheLargestHasTheLongestBar) {
  const std::string text = histogram_text(Json::parse("[[1,1000],[2,1],[3,1],[8,1],[2048,1],[1023,0]]"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 12) << text;
  EXPECT_NE(text.find("             1      1000 " + std::string(50, '#') + "\n"), std::string::npos) << text;
  EXPECT_NE(text.find("        2 to 3         2 ########\n"), std::string::npos) << text;
  EXPECT_NE(text.find("        4 to 7         0 \n"), std::string::npos) << text;
  EXPECT_NE(text.find("  2048 or more         1 #####\n"), std::string::npos) << text;
  EXPECT_EQ(histogram_text(Json::array()), "");
}

}  // namespace
}  // namespace liana::report
