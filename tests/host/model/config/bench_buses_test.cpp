// Buses for arms that come without a bus table, and the two optional fields of a robot table that name poses.
#include <algorithm>
#include <set>

#include "firmware_like/drive/drive_io.hpp"
#include "host/model/config/bench_buses.hpp"
#include "host/model/config/robot_parts.hpp"
#include "tests/host/model/config/tables.hpp"

namespace liana::config {
namespace {

// Whatever the capacity, every drive has a bus, and no bus is loaded beyond what it is allowed.
TEST(BenchBuses, CarryAnyNumberOfDrivesWithinTheirLoadOnAsFewBusesAsPossible) {
  for (std::int32_t drives = 1; drives <= kMaxDrives; ++drives) {
    const BusesConfig buses = parse_buses(bench_buses(drives), "made");
    std::set<DrivePlace> nodes;
    std::size_t least = 1000, most = 0;
    for (std::size_t b = 0; b < buses.buses.size(); ++b) {
      const auto& on_bus = buses.buses[b].nodes;
      nodes.insert(on_bus.begin(), on_bus.end());
      least = std::min(least, on_bus.size()), most = std::max(most, on_bus.size());
      EXPECT_LE(worst_case_load(buses, b), buses.max_load) << drives << " drives, bus " << b;
    }
    EXPECT_EQ(nodes.size(), static_cast<std::size_t>(drives));
    EXPECT_EQ(nodes.rbegin()->node, drives) << "drive i is node i + 1";
    EXPECT_LE(most - least, 1u) << drives << " drives are shared out evenly";
    if (buses.buses.size() == 1) continue;
    BusesConfig fewer = buses;
    fewer.buses.pop_back();
    const auto share = (static_cast<std::size_t>(drives) + fewer.buses.size() - 1) / fewer.buses.size();
    fewer.buses.front().nodes.assign(share, 1);
    EXPECT_GT(worst_case_load(fewer, 0), buses.max_load) << drives << " drives would fit on one bus less";
  }
}

TEST(BenchBuses, CountsTheDrivesOfBothKindsOfArm) {
  EXPECT_EQ(drive_count(good_table("robot", "zhu2022").dump(), "r"), 15);
  EXPECT_EQ(drive_count(good_table("robot", "three_segment_lab").dump(), "r"), 9);
  EXPECT_EQ(drive_count(good_table("robot", "tdcr_benchmark").dump(), "r"), 6);
  EXPECT_EQ(drive_count(good_table("robot", "micro").dump(), "r"), 7);
}

RobotConfig lab_with(const char* field, const Json& value) {
  Json table = good_table("robot", "three_segment_lab");
  spoil(table, field, value);
  return parse_robot_alone(table.dump(), "r");
}

std::string refusal_of(const char* field, const Json& value) {
  try {
    lab_with(field, value);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(NamedPoses, StartAndFixturesMayBeNamedAndMustExist) {
  EXPECT_EQ(lab_with("start_pose", "look").start_pose, "look");
  EXPECT_EQ(lab_with("start_pose", nullptr).start_pose, "");
  EXPECT_EQ(lab_with("jig_poses", nullptr).jig_poses, std::vector<std::string>{});
  EXPECT_EQ(lab_with("jig_poses", {"zero", "deep"}).jig_poses, (std::vector<std::string>{"zero", "deep"}));
  EXPECT_TRUE(names(refusal_of("start_pose", "nowhere"), {"r", "start_pose", "nowhere", "jig_a"}));
  EXPECT_TRUE(names(refusal_of("jig_poses", {"zero"}), {"r", "jig_poses", "two"}));
  EXPECT_TRUE(names(refusal_of("fixture_poses", {"zero", "deep"}), {"r", "fixture_poses", "jig_poses"}));
  EXPECT_TRUE(names(refusal_of("jig_poses", {"zero", "zero"}), {"r", "jig_poses[2]", "zero"}));
  EXPECT_TRUE(names(refusal_of("jig_poses", {"zero", "nowhere"}), {"r", "jig_poses[2]", "jig_a"}));
}

TEST(NamedPoses, MayBeExactlyAtTheLimit) {
  const Json at_limit = {15, -15, 15, -15, 15, -15};
  EXPECT_EQ(lab_with("named_poses_deg/look", at_limit).named_poses_deg.at("look").front(), 15.0);
  EXPECT_TRUE(names(refusal_of("named_poses_deg/look", {15.001, 0, 0, 0, 0, 0}),
                    {"r", "named_poses_deg.look[1]", "15.001", "-15", "15"}));
}

}  // namespace
}  // namespace liana::config
