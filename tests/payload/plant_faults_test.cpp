// Faults while the payload is pushed: every kind of a drive's, the base, a jam; and the payload's way from the
// mechanism through the arm into the adapter.
#include <cmath>
#include <nlohmann/json.hpp>

#include "hil/payload/payload_equipment.hpp"
#include "tests/payload/stand_in.hpp"

namespace liana::test {
namespace {

std::string fault(const std::string& kind, const std::string& more = "") {
  return R"([{"kind":")" + kind + R"(","at_slot":900)" + more + "}]";
}

// All drives without power, nothing turns, next to no force left.
void expect_at_rest(const Stand& stand, const char* name) {
  for (std::size_t i = 0; i < 7; ++i) {
    const bench::Drive& drive = stand.plant.drives().drive(i);
    EXPECT_NE(drive.power_state(), bench::PowerState::kOperationEnabled) << name << " " << i;
    EXPECT_FALSE(drive.is_torque_controlled()) << name << " " << i;
  }
  EXPECT_LT(stand.plant.fastest_rad_s(), 0.002) << name;
  EXPECT_LT(stand.peak_Nm, 150.0) << name;
}

// The fault comes in the middle of pushing; a tenth of a second later the master notices it and falls silent. Whatever
// the faulty drive does, all end without power and the arm at rest.
// req:B26
TEST(TorqueDriveFaults, EveryKindEndsInTheDrivesOwnSafeState) {
  const std::pair<const char*, const char*> kinds[] = {{"missing", ""},
                                                       {"silent", ""},
                                                       {"fault", ""},
                                                       {"sto", ""},
                                                       {"late", R"(,"cycles":5)"},
                                                       {"stuck", ""},
                                                       {"noisy", R"(,"counts":500,"permille":50)"},
                                                       {"wrong_pdo_length", ""},
                                                       {"emcy", R"(,"code":8976)"},
                                                       {"reboot", ""},
                                                       {"wrong_identity_after_reboot", ""},
                                                       {"encoder_jump", R"(,"counts":3000)"},
                                                       {"no_reports", ""},
                                                       {"duplicate_node_id", ""},
                                                       {"slow_sdo", ""}};
  for (const auto& [kind, more] : kinds) {
    Stand stand(7, fault(kind, std::string(R"(,"drive":4)") + more), false);
    stand.start();
    while (stand.now_s() < 3.7) stand.press(30.0);
    ASSERT_GT(std::fabs(stand.plant.wrist().force_N.z), 3.0) << kind << ": there is a force to get rid of";
    for (int i = 0; i < 1500; ++i) stand.tick({}, true);
    expect_at_rest(stand, kind);
  }
}

TEST(TorqueDriveFaults, QuickStopTakesTheForceOutAndThenBrakes) {
  Stand stand(7, "[]", false);
  stand.start();
  while (stand.now_s() < 4.0) stand.press(30.0);
  stand.controlword = 0x02;
  for (int i = 0; i < 1500; ++i) stand.tick({});
  expect_at_rest(stand, "quick stop");
}

TEST(PayloadFaults, WithAJamThePayloadIsNotCapturedAndTheForceStaysBounded) {
  Stand stand(1, R"([{"kind":"jam","pin":2,"depth_m":0.008,"at_slot":0}])", false);
  stand.start();
  while (stand.now_s() < 14.0) stand.press(30.0);
  EXPECT_FALSE(stand.heard.captured);
  nlohmann::json summary;
  stand.plant.summarise(summary);
  EXPECT_LT(summary["peaks"]["contact_N"], 120.0);
  EXPECT_LT(summary["peaks"]["joint_torque_Nm"], 150.0);
}

// Latched, a base that moves pulls at the payload; free, it leaves the adapter elsewhere.
TEST(PayloadFaults, ABaseThatMovesMovesTheAdapterTheOtherWay) {
  Stand stand(1, R"([{"kind":"base_moved","x_m":0.004,"slots":50,"at_slot":100}])", false);
  stand.start();
  const bench::Pose before = stand.plant.socket();
  while (stand.now_s() < 1.0) stand.tick({});
  const bench::Vec3 moved = stand.plant.socket().position_m - before.position_m;
  EXPECT_NEAR(moved.x, -0.004, 1e-9);
  EXPECT_NEAR(moved.y, 0.0, 1e-9);
  EXPECT_NEAR(moved.z, 0.0, 1e-9);
}

TEST(PayloadFaults, TheSensorsFaultsComeOverTheWire) {
  Stand stand(1, R"([{"kind":"sensor_failed","at_slot":100},{"kind":"capture_early","at_slot":150}])", false);
  while (stand.now_s() < 0.39) stand.tick({});
  EXPECT_EQ(stand.heard.wrist_status, 0);
  while (stand.now_s() < 0.5) stand.tick({});
  EXPECT_EQ(stand.heard.wrist_status, 2);
  EXPECT_FALSE(stand.heard.captured);
  while (stand.now_s() < 0.8) stand.tick({});
  EXPECT_TRUE(stand.heard.captured);
}

// Faults that wait for where the payload is: contact before depth before capture, each in its moment.
// req:B26
TEST(PayloadFaults, BeginWhenThePinsTouchAreInAndAreCaptured) {
  Stand stand(1, R"([{"kind":"sensor_failed","when":{"contact_above_N":8,"for_slots":5},"for_slots":1},
                     {"kind":"sensor_saturated","when":{"depth_above_m":0.012},"for_slots":1},
                     {"kind":"lock_fails","when":{"captured":true}},
                     {"kind":"target_lost","when":{"depth_above_m":-0.3,"depth_below_m":-0.1}}])",
              false);
  stand.start();
  while (stand.now_s() < 14.0 && !stand.heard.captured) {
    stand.press(30.0);
    const auto& begun = stand.injector().courses();
    const double depth_m = stand.plant.site()->plate_in_socket(stand.plant.arm().tip().pose).position_m.z;
    const bool is_captured = stand.plant.site()->adapter().captured();
    EXPECT_TRUE(!begun[0].begun || depth_m > -0.003) << depth_m;
    EXPECT_TRUE(!begun[1].begun || depth_m > 0.0119) << depth_m;
    EXPECT_TRUE(!begun[2].begun || is_captured);
  }
  ASSERT_TRUE(stand.heard.captured);
  const auto& courses = stand.injector().courses();
  ASSERT_TRUE(courses[0].begun && courses[1].begun && courses[2].begun);
  EXPECT_LT(*courses[0].begun, *courses[1].begun);
  EXPECT_LT(*courses[1].begun, *courses[2].begun);
  EXPECT_FALSE(courses[3].begun) << "it is nearer than that from the start";
}

TEST(PayloadFaults, WhatHappensToAPayloadIsRefusedWhereThereIsNone) {
  try {
    Stand stand(1, R"([{"kind":"jam","pin":1,"depth_m":0.01,"at_slot":0}])", false, scene_table("none"));
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("\"jam\""), std::string::npos) << error.what();
  }
}

TEST(TorquePlant, WithoutAPayloadTheArmGivesTorqueAllTheSame) {
  Stand stand(1, "[]", true, scene_table("none"));
  stand.start();
  EXPECT_EQ(stand.plant.drives().enabled(), 7U);
  EXPECT_GT(stand.heard.wrist_frames, 40);
  EXPECT_EQ(stand.heard.adapter_frames, 0);
}

// Taken where it is, not where it should be; nothing jumps, and the wrist then feels its inertia.
// req:B6
TEST(PayloadSite, TheArmTakesThePayloadJustWhereItIsWithoutAnyForce) {
  Json scene = scene_table("payload_adapter");
  const Json at_adapter = scene_table("payload_at_adapter");
  for (const char* field : {"position_m", "quaternion_wxyz"}) scene["payload"][field] = at_adapter["payload"][field];
  scene["payload"]["position_m"][0] = scene["payload"]["position_m"][0].get<double>() + 0.002;
  Stand stand(1, "[]", false, scene);
  stand.start();
  const auto equipment = stand.plant.make_equipment(bench_scene(scene), 1);
  equipment->ask({1, "grapple", stand.now_s()});
  const bench::Pose grapple = stand.plant.grapple();
  double most_N = 0.0;
  std::string phase;
  for (int i = 0; i < 1000; ++i) {
    if (const auto report = equipment->act(stand.now_s())) phase = report->phase;
    stand.tick({});
    most_N = std::max(most_N, norm(stand.plant.wrist().force_N));
  }
  EXPECT_EQ(phase, "done");
  EXPECT_EQ(stand.plant.site()->holder(), bench::Holder::kArm);
  EXPECT_LT(norm(stand.plant.grapple().position_m - grapple.position_m), 1e-4);
  EXPECT_LT(most_N, 1.0);
}

TEST(PayloadSite, ATipThatPressesOnTheHeldPayloadIsPushedBack) {
  bench::PayloadConfig payload;
  payload.body.mass_kg = 500.0;
  payload.length_m = 1.0;
  const bench::PayloadSite site(payload, {{0.0, 0.0, 5.0}, {}}, {});
  EXPECT_EQ(norm(site.push({{{0.0, 0.0, -0.001}, {}}, {}, {}}).force_N), 0.0);
  EXPECT_NEAR(site.push({{{0.0, 0.0, 0.001}, {}}, {}, {}}).force_N.z, -20.0, 1e-9);
  EXPECT_EQ(norm(site.push({{{0.0, 0.2, 0.001}, {}}, {}, {}}).force_N), 0.0);
}

// The inertia about the tip is the same, whichever frame it is computed in.
TEST(PayloadSite, ABodyInAnotherFrameKeepsItsPrincipalMoments) {
  const bench::BodyConfig body{10.0, {0.1, 0.2, 0.3}, {1.0, 2.0, 2.5, 0.1, -0.2, 0.3}};
  const bench::Pose there{{1.0, 0.0, 0.0}, bench::from_rotation_vector({0.3, -0.7, 1.1})};
  const bench::BodyConfig moved = bench::moved_body(there, body);
  const bench::BodyConfig back = bench::moved_body(relative(there, {}), moved);
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(back.inertia_kgm2[k], body.inertia_kgm2[k], 1e-12);
  EXPECT_LT(norm(back.center_m - body.center_m), 1e-12);
  EXPECT_NEAR(moved.inertia_kgm2[0] + moved.inertia_kgm2[1] + moved.inertia_kgm2[2], 5.5, 1e-12);
}

}  // namespace
}  // namespace liana::test
