// Every shipped drive type boots a drive of the bench that has its maker's dictionary, which then is enabled, moves,
// fails and recovers; a drive of another maker is refused with every reason.
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "hil/config/scene_config.hpp"
#include "host/apps/mission_runner/evaluate.hpp"
#include "host/base/json/json.hpp"
#include "host/model/config/drive_types_of_buses.hpp"
#include "tests/drives/drive_channel.hpp"
#include "tests/message.hpp"

namespace liana {
namespace {

// Those that follow positions; torque drives are tests/payload's matter.
std::vector<std::string> shipped_types() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(LIANA_LUA_DIR "/drives"))
    if (!entry.path().stem().string().starts_with("liana_cst")) names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

// The bus table `embedded_micro` in which node 1 is of `type`, and really of `bench`; evaluated as a run does it.
std::string bus_table(const std::string& type, const std::string& bench) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("liana-drives-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const std::string file = folder / (type + "-" + bench + ".lua");
  std::ofstream(file) << "local t = require 'buses.embedded_micro'\nt.drives = { { type = '" << type << "', bench = '"
                      << bench << "', nodes = { 1 } } }\nreturn t\n";
  mission_runner::Activity activity;
  mission_runner::Script script(mission_runner::ScriptLimits{}, LIANA_LUA_DIR, activity);
  const std::string json = mission_runner::evaluate(script, LIANA_LUA_DIR, "buses", file);
  std::filesystem::remove_all(folder);
  return json;
}

bench::DriveSettings settings_of(const std::string& buses_json) {
  const std::string file = std::filesystem::temp_directory_path() / ("liana-buses-" + std::to_string(::getpid()));
  std::ofstream(file) << buses_json;
  bench::DriveSettings settings;
  settings.dictionary = bench::load_buses(file).dictionary_of(1);
  std::filesystem::remove(file);
  settings.vendor = settings.dictionary.vendor.value_or(0x4C49);
  settings.product = 1;
  settings.revision = 1;
  settings.serial = 1001;
  return settings;
}

canopen::ExpectedDrive expectation_of(const std::string& buses_json) {
  canopen::ExpectedDrive drive = test::expectation();
  drive.type = config::drive_types(config::parse_buses(buses_json, "b")).at(1);
  return drive;
}

TEST(DriveTypesOnTheBench, EachBootsIsEnabledMovesFailsAndRecovers) {
  ASSERT_GE(shipped_types().size(), 5U);
  for (const std::string& type : shipped_types()) {
    const std::string buses = bus_table(type, type);
    test::BootedDrive bench(expectation_of(buses), settings_of(buses));
    bench.run_boot();
    ASSERT_EQ(bench.boot.state(), canopen::BootState::kOperational) << type << ": " << bench.refusals();
    bench.enable(1000);
    ASSERT_EQ(bench.drive.power_state(), bench::PowerState::kOperationEnabled) << type;
    for (int i = 0; i < 200; ++i) bench.cycle(0x0F, 1000 + 20 * i);
    EXPECT_NEAR(bench.drive.motor().position_counts(), 1000 + 20 * 199, 300) << type;
    bench.drive.raise_fault(0x7305);
    for (int i = 0; i < 50; ++i) bench.cycle(0x0F, 4980);
    EXPECT_EQ(bench.drive.power_state(), bench::PowerState::kFault) << type;
    EXPECT_EQ(bench.emergencies.front(), 0x7305) << type;
    bench.cycle(0x80, 4980);
    bench.enable(4980);
    EXPECT_EQ(bench.drive.power_state(), bench::PowerState::kOperationEnabled) << type;
  }
}

TEST(DriveTypesOnTheBench, ANanotecThatCountsTenthsOfADegreeIsToldToCountIncrements) {
  const std::string buses = bus_table("nanotec_cl4e", "nanotec_cl4e");
  bench::DriveSettings settings = settings_of(buses);
  test::BootedDrive bench(expectation_of(buses), settings);
  bench.run_boot();
  EXPECT_EQ(bench.boot.state(), canopen::BootState::kOperational) << bench.refusals();
  settings.dictionary.read_only.push_back({0x60A8, {}});
  test::BootedDrive stuck(expectation_of(buses), settings);
  stuck.run_boot();
  ASSERT_EQ(stuck.boot.mismatches(0).size(), 1U) << stuck.refusals();
  EXPECT_EQ(stuck.boot.mismatches(0)[0].index, 0x60A8);
}

// What a table says of the drive's times is what the bench's drive takes, and what a type allows is what it is given.
TEST(DriveTypesOnTheBench, ADriveThatTakesItsTimeIsWaitedForAsLongAsItsTypeAllows) {
  Json buses = Json::parse(bus_table("cia402_csp", "cia402_csp"));
  buses["drive_types"]["cia402_csp"]["dictionary"]["times"] = {{"sdo_answer_s", 4.0}, {"reset_s", 14.0}};
  test::BootedDrive impatient(expectation_of(buses.dump()), settings_of(buses.dump()));
  impatient.run_boot();
  ASSERT_EQ(impatient.boot.state(), canopen::BootState::kFailed);
  EXPECT_EQ(impatient.boot.mismatches(0)[0].failure, canopen::BootFailure::kNoBootUp) << impatient.refusals();
  buses["drive_types"]["cia402_csp"]["times"] = {{"sdo_answer_s", 1.4}, {"boot_up_s", 15.0}};
  test::BootedDrive patient(expectation_of(buses.dump()), settings_of(buses.dump()));
  patient.run_boot();
  EXPECT_EQ(patient.boot.state(), canopen::BootState::kOperational) << patient.refusals();
  buses["drive_types"]["cia402_csp"]["dictionary"]["times"]["reset_s"] = 121;
  EXPECT_THROW(expectation_of(buses.dump()), std::runtime_error);
  EXPECT_THROW(settings_of(buses.dump()), std::runtime_error);
}

// A drive that the table calls by another maker's name: nothing is written, and the reasons name both.
TEST(DriveTypesOnTheBench, ADriveOfAnotherMakerIsRefused) {
  const std::string buses = bus_table("maxon_epos4", "elmo_gold");
  test::BootedDrive bench(expectation_of(buses), settings_of(buses));
  bench.run_boot();
  EXPECT_EQ(bench.boot.state(), canopen::BootState::kFailed);
  ASSERT_FALSE(bench.boot.mismatches(0).empty());
  EXPECT_EQ(bench.boot.mismatches(0)[0].index, 0x1018);
  EXPECT_TRUE(names(bench.refusals(), {"251", "154"}));
  EXPECT_NE(bench.refusals().find("0x6066"), std::string::npos) << bench.refusals();
}

}  // namespace
}  // namespace liana
