// Faults that a mission is shipped with, by name.
#include "host/apps/launcher/mission_faults.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/base/json/json.hpp"
#include "tests/message.hpp"

namespace liana::launcher {
namespace {

std::string refusal_of(const Json& mission, const std::string& name) {
  try {
    fault_file(mission, name);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "accepted";
}

// req:B26
TEST(MissionFaults, AreFilesBesideTheMissionAndAnUnknownNameIsToldAllThatThereAre) {
  const Json mission = check_mission("payload_install", "macro_micro", "embedded_payload");
  const std::string file = fault_file(mission, "jam");
  EXPECT_TRUE(file.ends_with("missions/payload_install/faults/jam.json")) << file;
  EXPECT_TRUE(std::filesystem::exists(file));
  const std::string said = refusal_of(mission, "jamm");
  EXPECT_TRUE(names(
      said, {"--fault", "jamm", "target_lost", "jam", "no_capture", "early_capture", "sensor_failed", "base_moving",
             "lock_failed", "lying_capture", "stale_capture", "duplicate_capture", "lost_capture"}));
  EXPECT_TRUE(names(refusal_of(mission, "../../lab_search/way"), {"--fault", "../../lab_search/way", "jam"}));
}

TEST(MissionFaults, OfAMissionWithoutAnyAreRefused) {
  EXPECT_TRUE(
      names(refusal_of(check_mission("slit_crossing", "zhu2022", "embedded"), "jam"), {"--fault", "jam", "faults"}));
  EXPECT_TRUE(names(refusal_of(Json(), "jam"), {"--fault", "jam", "faults"}));
}

}  // namespace
}  // namespace liana::launcher
