// Weight found from tensions and angles of an arm that the bench draws (host/drives/calibration/load_fit.hpp).
#include <gtest/gtest.h>

#include "fixture.hpp"
#include "load_rig.hpp"

namespace liana::closed_loop {
namespace {

// The errors of a single arm may be as small as what its cables hide: three arms together show it.
TEST(LoadIdentification, WithTheLoadFoundArmsThatSeedsBuildExplainTheirTensions) {
  const LabMounting& lying = kLabMountings[0];
  const std::vector<calibration::LoadPose> poses = calibration::load_poses(lab_table(lying.gravity_m_s2), 6);
  double before_Nm = 0.0, after_Nm = 0.0;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const calibration::LoadResult found = find_load(lying, seed, poses);
    before_Nm += found.before.torque_Nm;
    after_Nm += found.after.torque_Nm;
    EXPECT_TRUE(found.problems.empty()) << seed;
    for (const auto& one : found.values) EXPECT_GT(one.sd, 0.0) << one.field;
  }
  measured("torque not explained with the table", before_Nm / 3.0, "N m");
  measured("torque not explained with what was found", after_Nm / 3.0, "N m");
  EXPECT_LT(after_Nm, 0.75 * before_Nm);
}

}  // namespace
}  // namespace liana::closed_loop
