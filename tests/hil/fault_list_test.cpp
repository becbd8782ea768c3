// The fault list: what is read and refused, when faults begin and end, and the faults that need an arm to be seen.
#include "bench_harness.hpp"
#include "tests/message.hpp"

namespace liana::bench {
namespace {

std::vector<FaultConfig> faults_of(const std::string& text) {
  const std::string path = temporary("faults.json");
  std::ofstream(path) << text;
  return load_faults(path, 15, 10);
}

TEST(FaultList, ANumberThatNoDoubleHoldsIsRefusedWithFileFieldAndItself) {
  const char* rows[][3] = {
      {"1e400", "", "1e400"},
      {R"([{"kind":"drive_silent","at_slot":1e400}])", "/0/at_slot", "1e400"},
      {R"([{"a":[{"b":1},[2,[3]],4,{"c":5}]},{"b":true,"c":null,"d":"x","e":[0.5,[],-1e400]}])", "/1/e/2", "-1e400"},
  };
  for (const auto& [text, field, number] : rows) {
    try {
      faults_of(text);
      ADD_FAILURE() << text << " was accepted";
    } catch (const std::runtime_error& error) {
      EXPECT_TRUE(names(error.what(), {temporary("faults.json"), number, "-1.79769313486232e+308"}));
      EXPECT_NE(std::string(error.what()).find(field), std::string::npos) << error.what();
    }
  }
}

struct Outcome {
  Truth truth;
  nlohmann::json summary;
  int tpdos = 0;
  int boot_ups = 0;
  std::array<int, 15> torque_permille{};
};

// All drives are enabled from slot 49 on; from slot 90 on all targets move by `counts_per_slot`.
Outcome run_with(const std::string& faults, std::uint32_t slots, int counts_per_slot = 0) {
  BenchOptions options = options_of(1);
  options.truth_path = temporary("truth.bin");
  options.summary_path = temporary("summary.json");
  options.faults = faults_of(faults);
  ScriptedBus bus(slots, counts_per_slot);
  {
    Bench bench(options);
    bench.run(bus);
  }
  return {read_truth(options.truth_path), nlohmann::json::parse(content(options.summary_path)), bus.tpdos, bus.boot_ups,
          bus.torque_permille};
}

TEST(FaultList, IsReadWithDrivesParametersAndConditions) {
  const auto faults = faults_of(R"([
    {"drive":4,"kind":"fault","at_slot":7},
    {"drive":[2,15],"kind":"noisy","counts":20,"when":{"theta":3,"above_deg":-6,"below_deg":5,"moving":true,"for_slots":9},"for_slots":50},
    {"drive":"all","kind":"motor_saturation","tension_N":55,"when":{"enabled":true}}])");
  ASSERT_EQ(faults.size(), 3U);
  EXPECT_EQ(faults[0].drives, std::vector<std::size_t>{3});
  EXPECT_EQ(faults[0].at_slot, 7U);
  EXPECT_EQ(faults[0].parameters.code, 0x2310);
  EXPECT_EQ(faults[1].drives, (std::vector<std::size_t>{1, 14}));
  EXPECT_EQ(faults[1].parameters.counts, 20.0);
  EXPECT_EQ(faults[1].when.theta, 2U) << "0-based";
  EXPECT_NEAR(faults[1].when.above_rad, -6.0 * kRadPerDeg, 1e-12);
  EXPECT_NEAR(faults[1].when.below_rad, 5.0 * kRadPerDeg, 1e-12);
  EXPECT_TRUE(faults[1].when.moving);
  EXPECT_FALSE(faults[1].when.enabled);
  EXPECT_EQ(faults[1].when.for_slots, 9U);
  EXPECT_EQ(faults[1].for_slots, 50U);
  EXPECT_FALSE(faults[1].at_slot);
  EXPECT_EQ(faults[2].drives.size(), 15U);
  EXPECT_EQ(faults[2].parameters.tension_N, 55.0);
}

// req:B26
TEST(FaultList, OfAPayloadNamesNoDrive) {
  const auto faults = faults_of(R"([{"kind":"jam","pin":2,"depth_m":0.012,"at_slot":3,"for_slots":9},
                                   {"kind":"base_moved","z_m":-0.003,"slots":25,"at_slot":4},
                                   {"kind":"capture_early","at_slot":5},
                                   {"kind":"lock_fails","when":{"captured":true,"contact_above_N":8,"depth_below_m":-0.1}}])");
  EXPECT_TRUE(faults[3].when.captured);
  EXPECT_EQ(faults[3].when.contact_above_N, 8.0);
  EXPECT_EQ(faults[3].when.depth_below_m, -0.1);
  EXPECT_TRUE(faults[0].drives.empty());
  EXPECT_EQ(faults[0].parameters.pin, 2.0);
  EXPECT_EQ(faults[0].parameters.depth_m, 0.012);
  EXPECT_EQ(faults[1].parameters.z_m, -0.003);
  EXPECT_EQ(faults[1].parameters.slots, 25.0);
  EXPECT_EQ(fault_of(faults[2].kind), FaultOf::kPayload);
}

TEST(FaultList, OfAPayloadIsRefusedByACableArmAndSoIsOneThatWaitsForContact) {
  for (const auto& [faults, facts] : std::vector<std::pair<std::string, Facts>>{
           {R"([{"kind":"sensor_failed","at_slot":3}])", {"sensor_failed"}},
           {R"([{"drive":4,"kind":"sto","when":{"contact_above_N":3}}])", {"when", "contact", "capture"}},
           {R"([{"drive":4,"kind":"sto","when":{"carried_above":0.5}}])", {"when", "contact", "capture"}}}) {
    try {
      run_with(faults, 5);
      ADD_FAILURE() << faults << " was accepted";
    } catch (const std::runtime_error& error) {
      EXPECT_TRUE(names(error.what(), facts));
    }
  }
}

TEST(FaultList, RefusesWhatItDoesNotUnderstandWithFieldAndWhatIsAllowed) {
  struct Case {
    const char* fault;
    Facts facts;
  };
  const Case cases[] = {
      {R"({"drive":16,"kind":"fault","at_slot":1})", {"/0/drive", "16", "1", "15"}},
      {R"({"drive":"some","kind":"fault","at_slot":1})", {"/0/drive", "some", "all"}},
      {R"({"drive":[],"kind":"fault","at_slot":1})", {"/0/drive", "one"}},
      {R"({"drive":[3,3],"kind":"fault","at_slot":1})", {"/0/drive", "twice"}},
      {R"({"drive":[3,16],"kind":"fault","at_slot":1})", {"/0/drive/1", "16"}},
      {R"({"drive":4,"kind":"tired","at_slot":1})", {"/0/kind", "tired", "missing", "wrong_identity", "cable_break"}},
      {R"({"drive":4,"kind":"fault"})", {"at_slot", "when"}},
      {R"({"drive":4,"kind":"fault","at_slot":1,"when":{"moving":true}})", {"at_slot", "when"}},
      {R"({"drive":4,"kind":"fault","at_slot":-1})", {"/0/at_slot", "-1"}},
      {R"({"drive":4,"kind":"fault","at_slto":1})", {"/0/at_slto", "known", "at_slot"}},
      {R"({"drive":4,"kind":"fault","at_slot":1,"for_slots":5})", {"/0/for_slots", "known"}},
      {R"({"drive":4,"kind":"silent","at_slot":1,"for_slots":0})", {"/0/for_slots", "0"}},
      {R"({"drive":4,"kind":"silent","at_slot":1,"counts":5})", {"/0/counts", "known"}},
      {R"({"drive":4,"kind":"encoder_jump","at_slot":1})", {"/0/counts", "missing"}},
      {R"({"kind":"jam","pin":4,"depth_m":0.01,"at_slot":1})", {"/0/pin", "4", "1", "3"}},
      {R"({"kind":"jam","pin":1,"at_slot":1})", {"/0/depth_m", "missing"}},
      {R"({"kind":"jam","drive":2,"pin":1,"depth_m":0.01,"at_slot":1})", {"/0/drive", "known"}},
      {R"({"kind":"base_moved","at_slot":1})", {"/0", "nothing", "x_m"}},
      {R"({"kind":"base_moved","x_m":0.06,"at_slot":1})", {"/0/x_m", "0.06", "0.05"}},
      {R"({"kind":"base_moved","x_m":0.01,"at_slot":1,"for_slots":5})", {"/0/for_slots", "known"}},
      {R"({"drive":4,"kind":"encoder_jump","at_slot":1,"counts":0.5})", {"/0/counts", "whole"}},
      {R"({"drive":4,"kind":"noisy","at_slot":1})", {"counts", "permille"}},
      {R"({"drive":4,"kind":"late","at_slot":1,"cycles":0})", {"/0/cycles", "0"}},
      {R"({"drive":4,"kind":"wrong_pdo_length","at_slot":1,"bytes":9})", {"/0/bytes", "9"}},
      {R"({"drive":4,"kind":"emcy","at_slot":1})", {"/0/code", "missing"}},
      {R"({"drive":4,"kind":"emcy","at_slot":1,"code":65536})", {"/0/code", "65536"}},
      {R"({"drive":4,"kind":"cable_slip","at_slot":1,"length_m":1})", {"/0/length_m", "0.1"}},
      {R"({"drive":4,"kind":"motor_saturation","at_slot":1,"tension_N":-1})", {"/0/tension_N", "-1"}},
      {R"({"drive":4,"kind":"sto","when":{}})", {"/0/when", "condition"}},
      {R"({"drive":4,"kind":"sto","when":{"theta":11,"above_deg":1}})", {"/0/when/theta", "11"}},
      {R"({"drive":4,"kind":"sto","when":{"theta":3}})", {"/0/when", "above_deg"}},
      {R"({"drive":4,"kind":"sto","when":{"above_deg":3}})", {"/0/when/theta", "missing"}},
      {R"({"drive":4,"kind":"sto","when":{"moving":false}})", {"/0/when/moving", "true"}},
      {R"({"drive":4,"kind":"sto","when":{"moving":true,"for_slots":0}})", {"/0/when/for_slots", "0"}},
      {R"({"drive":4,"kind":"sto","when":{"resting":true}})", {"/0/when/resting", "known"}},
      {R"({"drive":4,"kind":"sto","when":7})", {"/0/when"}},
      {R"({"drive":4,"kind":"camera_frozen","at_slot":1})", {"/0/drive", "known"}},
      {R"({"kind":"camera_jump","at_slot":1})", {"/0/length_m", "missing"}},
      {R"({"kind":"camera_jump","at_slot":1,"length_m":0})", {"/0/length_m", "0"}},
      {R"({"drive":4,"kind":"external_force","at_slot":1,"x_N":1})", {"/0/drive", "known"}},
      {R"({"kind":"push","at_slot":1,"x_N":1})", {"/0/kind", "push", "external_force"}},
      {R"({"kind":"external_force","at_slot":1})", {"x_N", "y_N", "z_N"}},
      {R"({"kind":"external_force","at_slot":1,"x_N":101})", {"/0/x_N", "101"}},
      {R"({"kind":"external_force","at_slot":1,"x_N":1,"link":-1})", {"/0/link", "-1"}},
      {R"({"kind":"camera_late","at_slot":1,"seconds":0})", {"/0/seconds", "0"}},
      {R"({"drive":4,"kind":"sto","when":{"depth_above_m":11}})", {"/0/when/depth_above_m", "11"}},
      {R"({"kind":"lock_fails","when":{"captured":false}})", {"/0/when/captured", "true"}},
      {R"({"kind":"tool_jams","when":{"carried_above":1.5}})", {"/0/when/carried_above", "1.5"}},
      {R"({"kind":"lock_fails","when":{"contact_above_N":-1}})", {"/0/when/contact_above_N", "-1"}},
      {R"(5)", {"/0"}}};
  for (const Case& test : cases) {
    try {
      faults_of(std::string("[") + test.fault + "]");
      ADD_FAILURE() << test.fault << " was accepted";
    } catch (const std::runtime_error& error) {
      EXPECT_TRUE(names(error.what(), test.facts)) << test.fault;
    }
  }
  EXPECT_THROW(faults_of("{}"), std::runtime_error);
}

TEST(FaultsOfTheBench, HitTheDriveAndTheSlotTheyName) {
  for (const auto& [kind, expected] : {std::pair{"missing", 14.0}, std::pair{"fault", 14.0}, std::pair{"sto", 14.0},
                                       std::pair{"silent", 15.0}, std::pair{"slack", 15.0}}) {
    const Outcome run = run_with(std::string(R"([{"drive":4,"at_slot":120,"kind":")") + kind + "\"}]", 160);
    EXPECT_EQ(run.truth.at(119, "enabled"), 15.0);
    EXPECT_EQ(run.truth.at(159, "enabled"), expected);
    EXPECT_EQ(run.truth.at(159, "tension_min_N") < 0.5 * run.truth.at(119, "tension_min_N"),
              std::string(kind) == "slack");
    const bool quiet = std::string(kind) == "missing" || std::string(kind) == "silent";
    EXPECT_EQ(run.tpdos, quiet ? 15 * 140 - 40 : 15 * 140);
    EXPECT_EQ(run.summary.at("faults")[0].at("begun_slot"), 120);
    EXPECT_TRUE(run.summary.at("faults")[0].at("ended_slot").is_null());
  }
}

TEST(FaultsOfTheBench, EndAfterTheSlotsTheyLast) {
  const Outcome silent = run_with(R"([{"drive":[4,5],"kind":"silent","at_slot":120,"for_slots":10}])", 160);
  EXPECT_EQ(silent.tpdos, 15 * 140 - 20);
  EXPECT_EQ(silent.summary.at("faults")[0].at("ended_slot"), 130);
  const Outcome missing = run_with(R"([{"drive":4,"kind":"missing","at_slot":120,"for_slots":10}])", 160);
  EXPECT_EQ(missing.boot_ups, 16) << "it boots when its power is back";
  EXPECT_EQ(missing.truth.at(159, "enabled"), 14.0);
}

TEST(FaultsOfTheBench, WaitForTheirConditionAndBeginOnce) {
  const Outcome enabled = run_with(R"([{"drive":4,"kind":"sto","when":{"enabled":true,"for_slots":20}}])", 160);
  const int begun = enabled.summary.at("faults")[0].at("begun_slot");
  EXPECT_LT(enabled.truth.at(static_cast<std::size_t>(begun) - 20, "enabled"), 15.0)
      << "the first of twenty slots comes after this one";
  EXPECT_EQ(enabled.truth.at(static_cast<std::size_t>(begun) - 19, "enabled"), 15.0);
  EXPECT_EQ(enabled.truth.at(static_cast<std::size_t>(begun) + 1, "enabled"), 14.0);
  EXPECT_LT(begun, 90);

  const Outcome moving =
      run_with(R"([{"drive":4,"kind":"sto","when":{"moving":true,"enabled":true,"for_slots":3}}])", 160, 5);
  EXPECT_GT(moving.summary.at("faults")[0].at("begun_slot"), 90) << "targets move from slot 90 on";

  const Outcome resting = run_with(R"([{"drive":4,"kind":"sto","when":{"theta":3,"above_deg":30}}])", 160, 5);
  EXPECT_TRUE(resting.summary.at("faults")[0].at("begun_slot").is_null());
  const Outcome there = run_with(R"([{"drive":4,"kind":"sto","when":{"theta":3,"below_deg":-5}}])", 160, 5);
  EXPECT_EQ(there.summary.at("faults")[0].at("begun_slot"), 0) << "theta 3 starts at -12 deg";
}

TEST(FaultsOfTheBench, WaitForTheDepthInTheSlitAndForTheFirstOfTheList) {
  BenchOptions options = options_of(1);
  options.start_pose = "press_rod";
  options.fixture = true;
  options.summary_path = temporary("depth.json");
  options.faults = faults_of(R"([
    {"drive":4,"kind":"silent","when":{"depth_above_m":1.0,"enabled":true}},
    {"drive":5,"kind":"silent","when":{"after_first_slots":25}},
    {"drive":6,"kind":"silent","when":{"depth_above_m":3.0}},
    {"kind":"camera_dropped","at_slot":7,"for_slots":4}])");
  {
    Bench bench(options);
    ScriptedBus bus(160, 0);
    bench.run(bus);
  }
  const auto faults = nlohmann::json::parse(content(options.summary_path)).at("faults");
  const int first = faults[0].at("begun_slot");
  EXPECT_GT(first, 40) << "not before every drive is enabled";
  EXPECT_EQ(faults[1].at("begun_slot"), first + 25);
  EXPECT_TRUE(faults[2].at("begun_slot").is_null()) << "the tip is 1.9 m past the mouth";
  EXPECT_EQ(faults[3].at("ended_slot"), 11);
  EXPECT_TRUE(faults[3].at("drives").empty());
}

TEST(FaultsOfTheBench, NoiseIsInTheTorqueThatIsReported) {
  const Outcome quiet = run_with(R"([])", 160);
  const Outcome noisy = run_with(R"([{"drive":4,"kind":"noisy","permille":200,"at_slot":100}])", 160);
  EXPECT_GT(std::abs(quiet.torque_permille[3] - static_cast<std::int16_t>(noisy.torque_permille[3])), 5);
  EXPECT_EQ(quiet.torque_permille[4], noisy.torque_permille[4]) << "the others' readings are what they were";
}

TEST(FaultsOfTheBench, ASlipLosesTensionInProportionAndABreakAllOfIt) {
  const Outcome quiet = run_with(R"([])", 160);
  const Outcome slipped = run_with(R"([{"drive":4,"kind":"cable_slip","length_m":0.0002,"at_slot":120}])", 160);
  const Outcome broken = run_with(R"([{"drive":4,"kind":"cable_break","at_slot":120}])", 160);
  EXPECT_LT(slipped.torque_permille[3], quiet.torque_permille[3] - 2);
  EXPECT_GT(slipped.torque_permille[3], 0);
  EXPECT_EQ(broken.torque_permille[3], 0);
  EXPECT_EQ(broken.truth.at(159, "tension_min_N"), 0.0);
}

}  // namespace
}  // namespace liana::bench
