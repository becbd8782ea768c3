// Worst-case load, and the tables that are refused because of it (mission, A9: 15 drives over 1 to 4 buses).
#include "host/drives/bus/bus_load.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include "tests/message.hpp"

namespace liana::bus {
namespace {

struct LoadRow {
  double rate_hz;
  int drives;
  int rpdo_bytes;
  double percent;  // from a computation that was made independently
};

// Drives with 10 heartbeats a second each, 20 SDO pairs a second, 1 Mbit/s.
constexpr LoadRow kRows[] = {
    {100, 15, 8, 42.6}, {100, 8, 8, 23.2},  {100, 5, 8, 14.9},   {100, 4, 8, 12.2},   {200, 15, 8, 83.6},
    {200, 8, 8, 45.4},  {200, 5, 8, 29.0},  {200, 4, 8, 23.5},   {250, 15, 8, 104.1}, {250, 8, 8, 56.4},
    {250, 5, 8, 36.0},  {250, 4, 8, 29.2},  {500, 15, 8, 206.8}, {500, 8, 8, 111.8},  {500, 5, 8, 71.1},
    {500, 4, 8, 57.6},  {1000, 15, 8, 412}, {1000, 8, 8, 223},   {1000, 5, 8, 141},   {1000, 4, 8, 114.3},
    {250, 15, 6, 96.6}, {250, 8, 6, 52.4},  {250, 5, 6, 33.5},   {250, 4, 6, 27.2},   {250, 15, 4, 89.1},
    {250, 8, 4, 48.4},  {250, 5, 4, 31.0},  {250, 4, 4, 25.2},
};

TEST(BusLoad, AgreesWithTheIndependentTable) {
  for (const LoadRow& row : kRows) {
    const LoadTerms terms{row.rate_hz, row.drives, row.rpdo_bytes, 8, 10.0 * row.drives, 20.0};
    const double percent = worst_bits_per_second(terms) / 1e4;
    const double rounding = row.percent == std::floor(row.percent) && row.percent > 130 ? 0.5 : 0.05;
    EXPECT_NEAR(percent, row.percent, rounding + 1e-6)
        << row.rate_hz << " Hz, " << row.drives << " drives, RPDO " << row.rpdo_bytes;
  }
}

// The default: 15 drives on two buses at 250 Hz.
config::BusesConfig two_buses() {
  config::BusesConfig config;
  config.name = "test";
  config.backend = "embedded";
  config.rate_hz = 250;
  config.command_interval_s = 0.02;
  config.heartbeat_ms = 100;
  config.max_load = 0.75;
  config.buses = {{"can0", 1000000, {1, 2, 3, 4, 5, 6, 7, 8}}, {"can1", 1000000, {9, 10, 11, 12, 13, 14, 15}}};
  return config;
}

std::string refusal(const config::BusesConfig& config) {
  try {
    check_buses(config);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(BusLoad, TheDefaultTableIsAcceptedAndItsLoadCountsTheMastersHeartbeatToo) {
  EXPECT_EQ(refusal(two_buses()), "");
  EXPECT_NEAR(worst_load_with_sdo(two_buses(), 0), 0.525, 1e-9);
  for (const std::size_t bus : {0u, 1u}) {
    EXPECT_NEAR(config::worst_case_load(two_buses(), bus), worst_load_with_sdo(two_buses(), bus), 1e-12)
        << "what lianad reports and what liana-bus checks";
  }
}

TEST(BusLoad, AllDrivesOnOneBusAt250HzAreRefusedWithTheLoad) {
  config::BusesConfig config = two_buses();
  for (int node = 9; node <= 15; ++node) config.buses[0].nodes.push_back(node);
  config.buses.pop_back();
  const std::string message = refusal(config);
  EXPECT_TRUE(names(message, {"15 drives", "250 Hz", "can0", "96.7 %"}));
  EXPECT_NE(message.find("75 %"), std::string::npos) << message;
  config.rate_hz = 100;
  EXPECT_EQ(refusal(config), "");
}

TEST(BusLoad, PeriodsThatObject60C2CannotExpressAreRefused) {
  config::BusesConfig config = two_buses();
  for (const double rate_hz : {150.0, 300.0, 333.0, 0.0, -100.0}) {
    config.rate_hz = rate_hz;
    EXPECT_NE(refusal(config).find("60C2"), std::string::npos) << rate_hz;
  }
  for (const double rate_hz : {100.0, 125.0, 200.0, 250.0}) {
    config.rate_hz = rate_hz;
    config.command_interval_s = 0.04;
    EXPECT_EQ(refusal(config), "") << rate_hz;
  }
}

TEST(BusLoad, ACommandIntervalThatIsNotWholeTicksIsRefused) {
  config::BusesConfig config = two_buses();
  config.command_interval_s = 0.018;
  EXPECT_NE(refusal(config).find("command_interval_s: 0.018"), std::string::npos);
  config.command_interval_s = 0.001;
  EXPECT_NE(refusal(config).find("0.004 s"), std::string::npos);
}

TEST(BusLoad, NodesThatDoNotExistOrExistTwiceAreRefused) {
  config::BusesConfig config = two_buses();
  config.buses[1].nodes[0] = 8;
  EXPECT_NE(refusal(config).find("buses[1].nodes: 8"), std::string::npos);
  config.buses[1].nodes[0] = 127;
  EXPECT_TRUE(names(refusal(config), {"127", "master"}));
}

TEST(BusLoad, NamesAndBitRatesThatCannotBeAreRefused) {
  config::BusesConfig config = two_buses();
  config.buses[0].name = "a_name_too_long";
  EXPECT_NE(refusal(config).find("buses[0].name"), std::string::npos);
  config = two_buses();
  config.buses[0].bitrate = 5000000;
  EXPECT_NE(refusal(config).find("buses[0].bitrate: 5000000"), std::string::npos);
  config = two_buses();
  config.buses.clear();
  EXPECT_NE(refusal(config).find("1 to 8 buses"), std::string::npos);
}

}  // namespace
}  // namespace liana::bus
