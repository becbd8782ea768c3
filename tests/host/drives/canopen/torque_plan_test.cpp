// What a torque drive is asked and told at boot besides, or instead of, what a csp drive is.
#include <gtest/gtest.h>

#include <algorithm>

#include "host/drives/canopen/boot_plan.hpp"

namespace liana::canopen {
namespace {

ExpectedDrive torque_drive() {
  ExpectedDrive drive;
  drive.node = 3;
  drive.type.is_cst = true;
  drive.type.writes = {{{0x3001, 1}, "damping", 4, 3000, true}};
  return drive;
}

// The last write of an object; nothing: it is not written.
std::optional<std::uint32_t> written(const BootPlan& plan, std::uint16_t index, std::uint8_t sub) {
  std::optional<std::uint32_t> value;
  for (const BootObject& object : plan.objects())
    if (object.write && object.index == index && object.sub == sub) value = object.value;
  return value;
}

TEST(TorquePlan, MapsTorqueAndRateAndASecondReportAndAsksForCst) {
  const ExpectedDrive drive = torque_drive();
  const BootPlan plan(std::span(&drive, 1));
  EXPECT_EQ(written(plan, 0x6060, 0), 10u);
  EXPECT_EQ(written(plan, 0x1600, 0), 3u);
  EXPECT_EQ(written(plan, 0x1600, 2), 0x60710010u);
  EXPECT_EQ(written(plan, 0x1600, 3), 0x60B10020u);
  EXPECT_EQ(written(plan, 0x1A00, 0), 3u);
  EXPECT_EQ(written(plan, 0x1A01, 0), 1u);
  EXPECT_EQ(written(plan, 0x1A01, 1), 0x606C0020u);
  EXPECT_EQ(written(plan, 0x1801, 1), 0x283u) << "enabled in the end";
  EXPECT_EQ(written(plan, 0x1802, 1), 0x80000000u) << "as all that are not used";
  EXPECT_EQ(written(plan, 0x3001, 1), 3000u);
  const auto modes = std::find_if(plan.objects().begin(), plan.objects().end(),
                                  [](const BootObject& object) { return object.index == 0x6502; });
  ASSERT_NE(modes, plan.objects().end());
  EXPECT_EQ(modes->value, 0x200u);
}

TEST(TorquePlan, ACspDriveHasOneReportAndItsSecondIsOff) {
  ExpectedDrive drive = torque_drive();
  drive.type.is_cst = false;
  const BootPlan plan(std::span(&drive, 1));
  EXPECT_EQ(written(plan, 0x6060, 0), 8u);
  EXPECT_EQ(written(plan, 0x1600, 2), 0x607A0020u);
  EXPECT_EQ(written(plan, 0x1801, 1), 0x80000000u);
  EXPECT_FALSE(written(plan, 0x1A01, 0));
}

}  // namespace
}  // namespace liana::canopen
