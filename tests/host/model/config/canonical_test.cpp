#include "host/model/config/canonical.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "tests/host/model/config/tables.hpp"

namespace liana::config {

TEST(CanonicalJson, WritesEveryNumberInOneWay) {
  EXPECT_EQ(canonical_number(-0.0), "0");
  EXPECT_EQ(canonical_number(20.0), "20");
  EXPECT_EQ(canonical_number(1000000.0), "1000000");
  EXPECT_EQ(canonical_number(0.1), "0.1");
  EXPECT_EQ(canonical_json(Json::parse(R"({"b":1.0,"a":[1,2.5,{"d":[],"c":{}}]})")),
            R"({"a":[1,2.5,{"c":{},"d":[]}],"b":1})");
}

TEST(CanonicalJson, NumbersReadBackExactly) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-12.0, 12.0);
  for (int i = 0; i < 10000; ++i) {
    const double value = std::pow(10.0, exponent(random)) * (i % 2 == 0 ? 1.0 : -1.0);
    EXPECT_EQ(std::strtod(canonical_number(value).c_str(), nullptr), value);
    EXPECT_EQ(Json::parse(canonical_number(value)).get<double>(), value);
  }
}

// req:A19
TEST(ConfigHash, IsTheSameForTheSameTablesAndChangesWithAnyOfThem) {
  const auto hash = [](const std::string& buses_name, const std::string& radius) {
    const BusesConfig buses = parse_buses(good_table("buses", buses_name).dump(), "b");
    Json scene = good_table("scene", "panel_slit");
    scene["spheres"][0]["radius_m"] = std::stod(radius);
    const RobotConfig robot = parse_robot(good_table("robot", "zhu2022").dump(2), "r", "nominal", buses);
    return config_hash(robot.canonical_json, parse_scene(scene.dump(), "s").canonical_json, buses.canonical_json);
  };
  EXPECT_EQ(hash("embedded", "0.25"), hash("embedded", "0.250"));
  EXPECT_NE(hash("embedded", "0.25"), hash("embedded", "0.26"));
  EXPECT_NE(hash("embedded", "0.25"), hash("vcan", "0.25"));
  EXPECT_EQ(hash("embedded", "0.25").size(), 64u);
}

}  // namespace liana::config
