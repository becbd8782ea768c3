#include "host/model/config/config.hpp"
#include "host/model/config/drive_names.hpp"
#include "tests/host/model/config/tables.hpp"

namespace liana::config {
namespace {

TEST(Buses, KnowPeriodIntervalAndTheBusOfANode) {
  const BusesConfig buses = parse_buses(good_table("buses", "embedded").dump(), "b");
  EXPECT_EQ(buses.period_us(), 4000);
  EXPECT_EQ(buses.interval_ticks(), 5);
  EXPECT_EQ(buses.bus_of_node(8), 0);
  EXPECT_EQ(buses.bus_of_node(9), 1);
  EXPECT_EQ(buses.bus_of_node(16), -1);
}

// SYNC 55, RPDO 115, TPDO 135, heartbeat 65 bits at worst stuffing; 20 SDO pairs a second of 2 x 135 bits.
TEST(Buses, WorstCaseLoadIsTheSumOfTheLongestFrames) {
  const BusesConfig two = parse_buses(good_table("buses", "embedded").dump(), "b");
  EXPECT_NEAR(worst_case_load(two, 0), ((55 + 8 * 250) * 250 + 9 * 65 * 10 + 5400) / 1e6, 1e-12);
  const BusesConfig fast = parse_buses(good_table("buses", "embedded_500").dump(), "b");
  EXPECT_EQ(fast.interval_ticks(), 10);
  EXPECT_NEAR(worst_case_load(fast, 0), ((55 + 4 * 250) * 500 + 5 * 65 * 10 + 5400) / 1e6, 1e-12);
  const BusesConfig one = parse_buses(good_table("buses", "embedded_single").dump(), "b");
  EXPECT_NEAR(worst_case_load(one, 0), ((55 + 15 * 250) * 100 + 16 * 65 * 10 + 5400) / 1e6, 1e-12);
}

// A torque drive has 135 bits of RPDO, 135 and 95 of TPDOs; the wrist sensor 2 x 135 a tick, the adapter 135 and 75
// every fourth.
TEST(Buses, TorqueDrivesAndSensorsAreInTheWorstCaseLoad) {
  const BusesConfig buses = parse_buses(good_table("buses", "embedded_payload").dump(), "b");
  EXPECT_EQ(torque_drives(buses, 0), 4);
  EXPECT_EQ(torque_drives(buses, 1), 3);
  EXPECT_EQ(buses.buses[1].wrist_sensor, 0x20);
  EXPECT_EQ(buses.buses[1].adapter, 0x30);
  EXPECT_NEAR(worst_case_load(buses, 0), ((55 + 4 * 365) * 250 + 5 * 65 * 10 + 5400) / 1e6, 1e-12);  // 38.7 %
  EXPECT_NEAR(worst_case_load(buses, 1), ((55 + 3 * 365 + 270 + 52.5) * 250 + 6 * 65 * 10 + 5400) / 1e6, 1e-12);
  EXPECT_NEAR(worst_case_load(buses, 1), 0.377, 0.001);
}

TEST(Buses, ASensorHasANodeOfItsOwnAndThereIsOneOfEach) {
  const Json good = good_table("buses", "embedded_payload");
  const auto parse = [](const std::string& text) { parse_buses(text, "given.json"); };
  expect_refused(good, {"/buses/1/wrist_sensor", 5, "buses[2].wrist_sensor", {"can1"}}, parse);
  expect_refused(good, {"/buses/1/adapter", 32, "buses[2].adapter", {"can1"}}, parse);
  expect_refused(good, {"/buses/1/adapter", 127, "buses[2].adapter", {"1", "126"}}, parse);
  expect_refused(good, {"/buses/0/adapter", 50, "buses", {"wrist_sensor", "adapter"}}, parse);
}

// Three nodes with a frame of 6 bytes (115 bits) a tick each, and a heartbeat. req:A10
TEST(Buses, LoadCellsAreReadWithWhatTheyHaveInCommonAndCountInTheLoad) {
  const BusesConfig buses = parse_buses(good_table("buses", "embedded_lab_1g").dump(), "b");
  ASSERT_EQ(buses.buses[0].load_cells.size(), 3U);
  EXPECT_EQ(buses.buses[0].load_cells[2].node, 34);
  EXPECT_EQ(buses.buses[0].load_cells[2].cables, (std::vector<std::size_t>{6, 7, 8}));
  EXPECT_EQ(buses.load_cell.newtons_per_step, 0.02);
  EXPECT_TRUE(buses.load_cell.goes_on);
  EXPECT_NEAR(worst_case_load(buses, 0), ((55 + 8 * 250 + 3 * 115) * 250 + 12 * 65 * 10 + 5400) / 1e6, 1e-12);
}

TEST(Buses, ALoadCellHasANodeOfItsOwnACableOfItsOwnAndARowForAll) {
  const Json good = good_table("buses", "embedded_lab_1g");
  const auto parse = [](const std::string& text) { parse_buses(text, "given.json"); };
  expect_refused(good, {"/buses/0/load_cells/1/node", 8, "buses[1].load_cells[2].node", {"can0"}}, parse);
  expect_refused(good, {"/buses/0/load_cells/1/node", 32, "buses[1].load_cells[2].node", {"can0"}}, parse);
  expect_refused(good, {"/buses/0/load_cells/1/cables/0", 3, "buses[1].load_cells", {"cable 3", "32"}}, parse);
  expect_refused(good, {"/buses/0/load_cells/1/cables/0", 33, "buses[1].load_cells[2].cables[1]", {"32"}}, parse);
  expect_refused(good, {"/load_cell/when_lost", "stop", "load_cell.when_lost", {"hold", "torque"}}, parse);
  expect_refused(good, {"/load_cell/agree_N", 0, "load_cell.agree_N", {"0.1"}}, parse);
  expect_refused(good, {"/load_cell/range_N", 655.35, "load_cell.range_N", {"655.34", "32767"}}, parse);
  EXPECT_EQ(message_of(good, {"/load_cell/range_N", 655.34, "", {}}, parse), "");
}

TEST(Buses, LoadCellsReadAtLeastWhatTheRobotCallsAnAlarm) {
  const std::string robot = good_table("robot", "lab_1g").dump();
  const auto parse = [&](const std::string& text) {
    parse_robot(robot, "given.json", "nominal", parse_buses(text, "given.json"));
  };
  const Json good = good_table("buses", "embedded_lab_1g");
  EXPECT_EQ(message_of(good, {"/load_cell/range_N", 300, "", {}}, parse), "");
  expect_refused(good, {"/load_cell/range_N", 299, "load_cell.range_N", {"299.0", "300.0", "tension.alarm_N"}}, parse);
}

// Seven nodes of two axes and one of one: 15 drives, 8 heartbeats.
TEST(Buses, ANodeMayHaveTwoAxesAndDrivesCountByNodeThenAxis) {
  const BusesConfig buses = parse_buses(good_table("buses", "embedded_two_axes").dump(), "b");
  const std::vector<DrivePlace> places = buses.places();
  ASSERT_EQ(places.size(), 15U);
  EXPECT_EQ(places[0], DrivePlace(1, 1));
  EXPECT_EQ(places[1], DrivePlace(1, 2));
  EXPECT_EQ(places[8], DrivePlace(5, 1));
  EXPECT_EQ(places[14], DrivePlace(8, 1));
  EXPECT_NEAR(worst_case_load(buses, 0), ((55 + 8 * 250) * 250 + 5 * 65 * 10 + 5400) / 1e6, 1e-12);
  const RobotConfig robot = parse_robot(good_table("robot", "zhu2022").dump(), "r", "nominal", buses);
  EXPECT_EQ(DriveNames(robot).drive(3), "drive 4 (node 2, axis 2, segment 2)");
  EXPECT_EQ(DriveNames(robot).drive(4), "drive 5 (node 3, segment 2)");
}

TEST(Buses, AnAxisIsOfANodeOfItsBusAndNamedOnce) {
  const auto parse = [](const std::string& text) { parse_buses(text, "given.json"); };
  const auto axis = [](int node, int number) { return Json{{"node", node}, {"axis", number}}; };
  const Json good = good_table("buses", "embedded");
  EXPECT_EQ(message_of(good, {"/buses/0/nodes/1", axis(1, 2), "", {}}, parse), "");
  EXPECT_EQ(message_of(good, {"/buses/0/nodes/0", axis(1, 1), "", {}}, parse), "") << "the same as 1";
  expect_refused(good, {"/buses/0/nodes/1", axis(1, 1), "buses[1].nodes[2].node", {"1", "can0"}}, parse);
  expect_refused(good, {"/buses/0/nodes/1", axis(9, 2), "buses[1].nodes[2]", {"9"}}, parse);
  expect_refused(good, {"/buses/1/nodes/1", axis(1, 2), "buses[2].nodes[2]", {"1"}}, parse);
  expect_refused(good, {"/buses/0/nodes/1", axis(1, 3), "buses[1].nodes[2].axis", {"1", "2"}}, parse);
  expect_refused(good, {"/buses/0/nodes/1", axis(1, 0), "buses[1].nodes[2].axis", {"1", "2"}}, parse);
  expect_refused(good, {"/buses/0/nodes/1", axis(127, 1), "buses[1].nodes[2].node", {"126"}}, parse);
  expect_refused(good, {"/buses/0/nodes/1", Json{{"node", 2}}, "buses[1].nodes[2].axis", {"missing"}}, parse);
  const Json two = good_table("buses", "embedded_two_axes");
  expect_refused(two, {"/buses/0/nodes/3", axis(1, 2), "buses[1].nodes[4]", {"axis"}}, parse);
}

TEST(Buses, PeriodIsWhatObject60C2Holds) {
  const auto expect = [](std::int32_t period_us, int value, int exponent) {
    const InterpolationPeriod period = interpolation_period(period_us);
    EXPECT_EQ(period.value, value) << period_us;
    if (value != 0) {
      EXPECT_EQ(period.exponent, exponent) << period_us;
    }
  };
  expect(4000, 4, -3);
  expect(10000, 1, -2);
  expect(2000, 2, -3);
  expect(2500, 25, -4);
  expect(6667, 0, 0);  // 150 Hz
}

TEST(Buses, MaySayWhatMachineThereIs) {
  Json table = good_table("buses", "embedded");
  EXPECT_EQ(parse_buses(table.dump(), "b").machine.mips, 500.0);
  table["machine"] = {{"mips", 1200}, {"tick_share", 0.5}};
  EXPECT_EQ(parse_buses(table.dump(), "b").machine.mips, 1200.0);
  EXPECT_EQ(parse_buses(table.dump(), "b").machine.tick_share, 0.5);
  table["machine"] = {{"mips", 0}, {"tick_share", 0.5}};
  EXPECT_THROW(parse_buses(table.dump(), "b"), std::runtime_error);
}

TEST(Buses, AreRefusedWithFileFieldValueRangeAndAdvice) {
  const Json good = good_table("buses", "embedded");
  const std::vector<Spoiled> cases = {{"/kind", "bus", "kind", {"buses"}},
                                      {"/backend", "serial", "backend", {"embedded", "socketcan"}},
                                      {"/rate_hz", 150, "rate_hz", {"60C2"}},
                                      {"/rate_hz", 5000, "rate_hz", {"10", "1000"}},
                                      {"/rate_hz", 500, "buses[1].nodes", {"load"}},
                                      {"/command_interval_s", 0.018, "command_interval_s", {"multiples"}},
                                      {"/command_interval_s", 0.001, "command_interval_s", {"multiples"}},
                                      {"/buses", Json::array(), "buses", {"1", "8"}},
                                      {"/buses/0/bitrate", 2000000, "buses[1].bitrate", {"10000", "1000000"}},
                                      {"/buses/0/bitrate", 250000, "buses[1].nodes", {"load"}},
                                      {"/buses/0/name", "a-very-long-interface", "buses[1].name", {"1", "11"}},
                                      {"/buses/0/nodes/0", 127, "buses[1].nodes[1]", {"1", "126"}},
                                      {"/buses/1/nodes/0", 8, "buses[2].nodes[1]", {"8", "can0"}},
                                      {"/buses/0/nodes/1", 1, "buses[1].nodes[2]", {"1"}},
                                      {"/buses/0/nodes", nullptr, "buses[1].nodes", {"missing"}},
                                      {"/heartbeat_ms", 5, "heartbeat_ms", {"10", "1000"}},
                                      {"/max_load", 1.2, "max_load", {"0.9"}},
                                      {"/extra", 1, "extra", {"field"}}};
  for (const Spoiled& spoiled : cases) {
    expect_refused(good, spoiled, [](const std::string& text) { parse_buses(text, "given.json"); });
  }
}

}  // namespace
}  // namespace liana::config
