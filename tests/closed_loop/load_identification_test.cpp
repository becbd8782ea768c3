// Weight found from tensions and angles of an arm that the bench draws (host/drives/calibration/load_fit.hpp).
#include <gtest/gtest.h>

#include "fixture.hpp"
#include "load_rig.hpp"

namespace liana::closed_loop {
namespace {

TEST(LoadIdentification, WithTheLoadFoundAnArmThatASeedBuildsExplainsItsTensions) {
  const LabMounting& lying = kMountings.front();
  const cable::RobotParams table = lab_arm(lying).table;
  const calibration::LoadResult found = find_load(lying, 1, calibration::load_poses(table, 4));
  measured("torque not explained with the table", found.before.torque_Nm, "N m");
  measured("torque not explained with what was found", found.after.torque_Nm, "N m");
  EXPECT_LT(found.after.torque_Nm, 0.7 * found.before.torque_Nm);
  EXPECT_TRUE(found.problems.empty());
  for (const auto& one : found.values) EXPECT_GT(one.sd, 0.0) << one.field;
}

}  // namespace
}  // namespace liana::closed_loop
