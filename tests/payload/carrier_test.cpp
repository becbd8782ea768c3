// The arm that carries brings the small one, and what that holds, from where it is fetched to where it is installed.
#include "hil/payload/carrier.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "hil/payload/payload_equipment.hpp"
#include "tests/message.hpp"
#include "tests/payload/payload_tables.hpp"

namespace liana::test {
namespace {

using bench::Carrier;
using bench::CarryObservation;

constexpr CarryObservation kReady{.takes_s = 100.0, .arm_rests = true, .has_torque = true};

// req:B6
TEST(Carrier, GoesItsWayInItsTimeWithoutAJerkAndSaysSoOnce) {
  Carrier carrier;
  carrier.ask({3, "carry", 1.0});
  EXPECT_FALSE(carrier.act(0.9, kReady));
  EXPECT_EQ(carrier.act(1.0, kReady)->phase, "acting");
  double before = 0.0, rate = 0.0, max_rate = 0.0, max_change = 0.0;
  for (double now_s = 1.1; now_s < 100.95; now_s += 0.1) {
    ASSERT_FALSE(carrier.act(now_s, kReady)) << now_s;
    const double now_rate = (carrier.share() - before) / 0.1;
    max_change = std::max(max_change, std::fabs(now_rate - rate) / 0.1);
    max_rate = std::max(max_rate, now_rate);
    EXPECT_GE(now_rate, 0.0);
    before = carrier.share();
    rate = now_rate;
  }
  EXPECT_NEAR(max_rate, 2.1875 / 100.0, 1e-4);
  EXPECT_LT(max_change, 7.6 / 1e4) << "of a rate that has no jump";
  const auto done = carrier.act(101.01, kReady);
  ASSERT_TRUE(done);
  EXPECT_EQ(done->phase, "done");
  EXPECT_EQ(done->number, 3);
  EXPECT_EQ(carrier.share(), 1.0);
  EXPECT_FALSE(carrier.act(102.0, kReady));
}

TEST(Carrier, WhatCannotBeSaysWhy) {
  const auto answer = [](Carrier& carrier, const CarryObservation& sight) {
    carrier.ask({1, "carry", 0.0});
    const auto report = carrier.act(0.0, sight);
    EXPECT_EQ(report->phase, "failed");
    return report->reason;
  };
  Carrier carrier;
  EXPECT_TRUE(names(answer(carrier, {.takes_s = 0.0, .arm_rests = true}), {"no arm"}));
  EXPECT_NE(answer(carrier, {.takes_s = 9.0, .arm_rests = false}).find("rest first"), std::string::npos);
  carrier.ask({1, "carry", 0.0});
  carrier.act(0.0, kReady);
  EXPECT_EQ(carrier.act(101.0, kReady)->phase, "done");
  EXPECT_NE(answer(carrier, kReady).find("already"), std::string::npos);
}

// It comes to rest softly, says so then, and a second command goes on from there.
TEST(Carrier, StopsWhenTheSmallArmMovesOrLosesItsTorqueOrAJointJams) {
  for (const std::string why : {"moved", "torque", "on its way"}) {
    Carrier carrier;
    carrier.suffer({.jams = why == "on its way"});
    carrier.ask({1, "carry", 0.0});
    std::optional<bench::ToolStatus> stopped;
    double before = 0.0, rate = 0.0, now_s = 0.0;
    for (; !stopped && now_s < 200.0; now_s += 0.1) {
      CarryObservation sight = kReady;
      if (why == "moved") sight.arm_rests = now_s < 55.0;
      if (why == "torque") sight.has_torque = now_s < 55.0;
      const auto report = carrier.act(now_s, sight);
      if (report && report->phase == "failed") stopped = report;
      const double now_rate = carrier.share() - before;
      EXPECT_LT(std::fabs(now_rate - rate), 2e-5) << now_s << ": no jump";
      before = carrier.share();
      rate = now_rate;
    }
    ASSERT_TRUE(stopped);
    EXPECT_NE(stopped->reason.find(why), std::string::npos);
    EXPECT_LT(rate, 1e-7);
    const double share = carrier.share();
    EXPECT_GT(share, 0.6);
    EXPECT_LT(share, 0.95);
    EXPECT_FALSE(carrier.act(now_s + 1.0, kReady));
    carrier.suffer({});
    carrier.ask({2, "carry", 300.0});
    EXPECT_EQ(carrier.act(300.0, kReady)->phase, "acting");
    EXPECT_FALSE(carrier.act(300.1, kReady));
    EXPECT_NEAR(carrier.share(), share, 1e-6);
    EXPECT_EQ(carrier.act(401.0, kReady)->phase, "done");
  }
}

// A large arm that is stiff enough to be there when it has been led there.
bench::SerialRobotConfig stiff_pair(double carry_s) {
  Json table = torque_arm_table();
  for (Json& joint : table["base"]["robot"]["joints"]) joint["stiffness_Nm_per_rad"] = 4e6;
  table["base"]["carry_s"] = carry_s;
  return bench_robot(table);
}

bench::TorquePlant plant_of(const bench::SerialRobotConfig& robot, const Json& scene) {
  return bench::TorquePlant(robot, bench_scene(scene), bench_buses(), {}, {}, 1);
}

// The adapter is far away, and then where the table has it, in the frame of a base that has gone there.
// req:B6
TEST(CarriedPlant, TheAdapterIsWhereTheTableHasItOnceTheBaseIsLockedThere) {
  const Json scene = scene_table("payload_adapter");
  bench::TorquePlant plant = plant_of(stiff_pair(10.0), scene);
  const bench::SceneConfig own = bench_scene(scene);
  EXPECT_LT(norm(plant.grapple().position_m - own.payload->pose.position_m), 1e-9);
  EXPECT_GT(norm(plant.socket().position_m - own.adapter->pose.position_m), 1.0);
  const bench::Vec3 base_m = plant.arm().base().pose.position_m;
  const auto equipment = plant.make_equipment(own, 1);
  equipment->ask({1, "carry", 0.0});
  std::string phase;
  for (int slot = 0; slot < 2750; ++slot) {
    if (const auto report = equipment->act(0.004 * slot)) phase = report->phase;
    plant.integrate(0.004);
  }
  EXPECT_EQ(phase, "done");
  EXPECT_LT(norm(plant.socket().position_m - own.adapter->pose.position_m), 1e-9);
  EXPECT_GT(norm(plant.arm().base().pose.position_m - base_m), 1.0) << "it has truly gone there";
  nlohmann::json summary;
  plant.summarise(summary);
  EXPECT_LT(summary["peaks"]["base_deflection_m"], 0.002);
}

// req:B26
TEST(CarriedPlant, AFaultMayWaitForAShareOfTheWay) {
  const Json scene = scene_table("payload_adapter");
  bench::TorquePlant plant = plant_of(stiff_pair(10.0), scene);
  bench::FaultConfig jam;
  jam.kind = bench::FaultKind::kToolJams;
  jam.when.carried_above = 0.5;
  bench::FaultInjector injector({jam});
  const auto equipment = plant.make_equipment(bench_scene(scene), 1);
  plant.inject(0, injector);
  equipment->ask({1, "carry", 0.0});
  for (std::uint32_t slot = 0; slot < 2750 && !injector.is_on(0); ++slot) {
    equipment->act(0.004 * slot);
    plant.integrate(0.004);
    plant.inject(slot, injector);
  }
  ASSERT_TRUE(injector.courses()[0].begun);
  EXPECT_NEAR(*injector.courses()[0].begun, 1250.0, 2.0) << "half of 10 s at 250 Hz";
}

TEST(CarriedPlant, APoseThatTheLargeArmDoesNotHaveIsRefused) {
  Json scene = scene_table("payload_adapter");
  scene["payload"]["fetch_pose"] = "nowhere";
  EXPECT_THROW(plant_of(stiff_pair(10.0), scene), std::runtime_error);
  Json table = torque_arm_table();
  table["base"].erase("carry_s");
  EXPECT_THROW(plant_of(bench_robot(table), scene_table("payload_adapter")), std::runtime_error);
}

// One that begins at the adapter, or stands firm, is not carried.
TEST(CarriedPlant, WhereNothingCarriesTheCommandFails) {
  Json firm = torque_arm_table();
  firm.erase("base");
  bench::TorquePlant at_adapter = plant_of(stiff_pair(10.0), scene_table("payload_at_adapter"));
  bench::TorquePlant on_ground = plant_of(bench_robot(firm), scene_table("payload_adapter"));
  for (bench::TorquePlant* plant : {&at_adapter, &on_ground}) {
    EXPECT_EQ(plant->carry_s(), 0.0);
    const auto equipment = plant->make_equipment(bench_scene(scene_table("payload_adapter")), 1);
    equipment->ask({1, "carry", 0.0});
    EXPECT_EQ(equipment->act(0.0)->phase, "failed");
  }
}

}  // namespace
}  // namespace liana::test
