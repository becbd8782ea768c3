// How drives and cables are written.
#include "host/model/config/drive_names.hpp"

#include <gtest/gtest.h>

#include "tests/host/model/config/tables.hpp"

namespace liana::config {
namespace {

TEST(DriveNames, CountFromOneAndNameNodeAndSegment) {
  const DriveNames names(nominal_zhu2022().table);
  EXPECT_EQ(names.drive(3), "drive 4 (node 4, segment 2)");
  EXPECT_EQ(names.cable(14), "cable 15 (segment 5)");
}

TEST(DriveNames, NameTheAxisOfADriveThatIsNotTheFirstOfItsNode) {
  const DriveNames names(std::vector<DrivePlace>{{1, 1}, {1, 2}, {2, 1}});
  EXPECT_EQ(names.drive(0), "drive 1 (node 1)");
  EXPECT_EQ(names.drive(1), "drive 2 (node 1, axis 2)");
  EXPECT_EQ(names.drive(2), "drive 3 (node 2)");
}

TEST(DriveNames, AnArmWithoutCablesHasNoSegments) { EXPECT_EQ(DriveNames().drive(0), "drive 1 (node 1)"); }

}  // namespace
}  // namespace liana::config
