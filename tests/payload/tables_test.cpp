// The shipped scenes of the payload installation, and what is refused in such a table, by host and bench.
#include "hil/payload/torque_plant.hpp"
#include "tests/payload/payload_tables.hpp"

namespace liana::test {
namespace {

// req:B24
TEST(PayloadScenes, HostAndBenchReadTheSame) {
  for (const char* name : {"payload_adapter", "payload_at_adapter"}) {
    const Json table = scene_table(name);
    const config::SceneConfig host = config::parse_scene(table.dump(), "s");
    const bench::SceneConfig own = bench_scene(table);
    ASSERT_TRUE(host.payload && host.adapter && own.payload && own.adapter) << name;
    EXPECT_EQ(host.payload->on_arm, own.payload->on_arm) << name;
    EXPECT_EQ(host.payload->mass_kg, own.payload->body.mass_kg);
    EXPECT_EQ(host.payload->length_m, own.payload->length_m);
    EXPECT_EQ(host.payload->start_lateral_m, own.payload->start_lateral_m);
    EXPECT_EQ(host.payload->pose.position_m[0], own.payload->pose.position_m.x);
    EXPECT_EQ(host.adapter->position_m[2], own.adapter->pose.position_m.z);
    EXPECT_EQ(host.camera->dropout, own.camera.dropout);
    EXPECT_EQ(host.camera->bias_m, own.camera.bias_m);
  }
}

// With the arm at `install` the payload's pins are five millimetres before the face, and along its axis.
TEST(PayloadScenes, AtInstallThePinsAreJustBeforeTheAdapter) {
  bench::ModelOptions options;
  options.start_pose = "install";
  options.spread = false;
  const bench::TorquePlant plant(bench_robot(torque_arm_table()), bench_scene(scene_table("payload_at_adapter")),
                                 bench_buses(), options, {}, 1);
  const bench::SceneConfig scene = bench_scene(scene_table("payload_at_adapter"));
  EXPECT_LT(norm(plant.socket().position_m - scene.adapter->pose.position_m), 1e-9);
  const bench::Pose plate = plant.site()->plate_in_socket(plant.arm().tip().pose);
  EXPECT_NEAR(plate.position_m.z, -0.005, 1e-9);
  EXPECT_NEAR(std::hypot(plate.position_m.x, plate.position_m.y), 0.0, 1e-9);
  EXPECT_NEAR(bench::angle_of(plate.attitude), 0.0, 1e-6);
}

// Whatever the arm truly is, the payload on it begins beside the axis by what the table allows.
TEST(PayloadScenes, APayloadOnTheArmBeginsBesideTheAxisByWhatTheTableAllows) {
  bench::ModelOptions options;
  options.start_pose = "install";
  double widest_m = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const bench::TorquePlant plant(bench_robot(torque_arm_table()), bench_scene(scene_table("payload_at_adapter")),
                                   bench_buses(), options, {}, seed);
    const bench::Pose plate = plant.site()->plate_in_socket(plant.arm().tip().pose);
    const double beside_m = std::hypot(plate.position_m.x, plate.position_m.y);
    EXPECT_LT(beside_m, 0.0014 * 1.42 + 1e-4) << seed;
    EXPECT_LT(bench::angle_of(plate.attitude), 0.5 * 0.0175) << seed;
    EXPECT_NEAR(plate.position_m.z, -0.005, 1e-3) << seed;
    widest_m = std::max(widest_m, beside_m);
  }
  EXPECT_GT(widest_m, 0.001);
}

struct Wrong {
  const char* pointer;
  Json value;
  const char* word;
};

TEST(PayloadScenes, WhatIsWrongIsRefusedByBothWithItsField) {
  const Wrong cases[] = {{"/payload/mass_kg", 0, "mass_kg"},
                         {"/payload/length_m", 100, "length_m"},
                         {"/payload/start", "ground", "start"},
                         {"/payload/start_lateral_m", 1, "start_lateral_m"},
                         {"/payload/start_tilt_deg", -1, "start_tilt_deg"},
                         {"/payload/quaternion_wxyz", {1, 1, 0, 0}, "quaternion_wxyz"},
                         {"/adapter/position_m", {1, 2}, "position_m"},
                         {"/camera/dropout", 2, "dropout"},
                         {"/camera/bias_m", -1, "bias_m"}};
  for (const Wrong& wrong : cases) {
    Json table = scene_table("payload_adapter");
    config::spoil(table, std::string_view(wrong.pointer).substr(1), wrong.value);
    for (const bool by_host : {true, false}) {
      try {
        if (by_host)
          config::parse_scene(table.dump(), "s");
        else
          bench_scene(table);
        ADD_FAILURE() << wrong.pointer << " accepted by " << (by_host ? "the host" : "the bench");
      } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find(wrong.word), std::string::npos) << error.what();
      }
    }
  }
  for (const char* left_out : {"payload", "adapter"}) {
    Json table = scene_table("payload_adapter");
    table.erase(left_out);
    EXPECT_THROW(config::parse_scene(table.dump(), "s"), std::runtime_error) << left_out;
    EXPECT_THROW(bench_scene(table), std::runtime_error) << left_out;
  }
}

// Contact of its body is verification's, not the bench's.
TEST(PayloadScenes, TheRadiusOfThePayloadHasToBeOneThatABodyCanHave) {
  Json table = scene_table("payload_adapter");
  table["payload"]["radius_m"] = 0;
  EXPECT_THROW(config::parse_scene(table.dump(), "s"), std::runtime_error);
  table["payload"].erase("radius_m");
  EXPECT_THROW(config::parse_scene(table.dump(), "s"), std::runtime_error);
}

TEST(PayloadScenes, AnInertiaThatNoBodyHasIsRefused) {
  Json table = scene_table("payload_adapter");
  table["payload"]["inertia_kgm2"] = {10, 10, 30, 0, 0, 0};
  EXPECT_THROW(config::parse_scene(table.dump(), "s"), std::runtime_error);
}

TEST(TorqueArm, TheModeOfTheDrivesIsOneOfTwoWords) {
  Json table = torque_arm_table();
  EXPECT_TRUE(bench_robot(table).is_torque_controlled);
  table["drives"]["mode"] = "position";
  EXPECT_FALSE(bench_robot(table).is_torque_controlled);
  table["drives"]["mode"] = "force";
  EXPECT_THROW(bench_robot(table), std::runtime_error);
}

}  // namespace
}  // namespace liana::test
