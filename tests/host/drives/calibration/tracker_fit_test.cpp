// Geometry and stiffness from the poses of a marker, planted by seed; and where tracker and marker are.
#include "host/drives/calibration/tracker_fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "firmware_like/cable/arm/static_load.hpp"
#include "firmware_like/math/trig.hpp"
#include "host/base/random/random.hpp"
#include "host/drives/calibration/calibration.hpp"
#include "host/drives/calibration/hand_eye.hpp"
#include "host/drives/calibration/jig.hpp"
#include "host/model/config/sha256.hpp"
#include "tests/host/drives/calibration/day.hpp"
#include "tests/host/drives/calibration/lab_arm.hpp"
#include "tests/host/model/config/tables.hpp"

namespace liana::calibration {

using namespace cable;
namespace {

using simulated::RandomStream;

constexpr int kSeeds = 100;
constexpr std::size_t kPoses = 14;

Vec3 drawn(RandomStream& random, double sd) { return {random.normal(sd), random.normal(sd), random.normal(sd)}; }
Pose drawn_pose(RandomStream& random, double sd_m, double sd_rad) {
  return {drawn(random, sd_m), quaternion_of(drawn(random, sd_rad))};
}

// An arm as a seed builds it, its tracker, and what its drives get wrong; `share` of what a table may be off by.
struct TrackedArm {
  RobotParams table, truth;
  HandEye tracker;
  CableVector zero_m{}, gain{};
  RandomStream random;

  TrackedArm(const RobotParams& as_designed, std::uint64_t seed, double share = 0.7)
      : table(as_designed), truth(as_designed), random(seed, 31) {
    for (const TableField& field : table_fields(table))
      *field.slot(truth, field.index) += random.normal(share * field.table_sd);
    truth.gravity_m_s2 = scale(truth.gravity_m_s2, norm(table.gravity_m_s2) / std::max(1e-9, norm(truth.gravity_m_s2)));
    tracker = {drawn_pose(random, 1.0, 0.7), drawn_pose(random, 0.05, 0.7)};
    for (std::size_t c = 0; c < static_cast<std::size_t>(table.cable_count()); ++c) {
      zero_m[c] = random.normal(0.1e-3);
      gain[c] = random.normal(0.01);
    }
  }

  StillPose stand(const ThetaVector& theta_rad) {
    StillPose out{theta_rad, {}, plan_at_rest(truth, cable_layout(truth), theta_rad).motor_N, {}};
    for (std::size_t k = 0; k < static_cast<std::size_t>(table.theta_count()); ++k)
      out.theta_rad[k] += random.normal(0.002);
    out.position_m = beyond_zero_m(truth, theta_rad, out.tension_N);
    for (std::size_t c = 0; c < static_cast<std::size_t>(table.cable_count()); ++c) {
      out.position_m[c] += random.normal(0.03e-3) - zero_m[c];
      out.tension_N[c] *= 1.0 + gain[c] + random.normal(0.003) + random.uniform(-0.05, 0.05);  // the last: friction
    }
    const Pose seen = tracker.marker_in_tracker(tip_pose(truth, arm_trig(truth, theta_rad)));
    const Pose noise = drawn_pose(random, kTrackerNoise_m, kTrackerNoise_rad);
    out.marker_in_tracker = {add(seen.position_m, noise.position_m), multiply(noise.quaternion, seen.quaternion)};
    return out;
  }

  std::vector<StillPose> poses(std::size_t count = kPoses, double limit_share = 0.7) {
    std::vector<StillPose> out;
    while (out.size() < count) {
      ThetaVector theta_rad{};
      for (std::size_t k = 0; k < static_cast<std::size_t>(table.theta_count()); ++k)
        theta_rad[k] = limit_share * table.segment[k / 2].theta_limit_rad * random.uniform(-1.0, 1.0);
      out.push_back(stand(theta_rad));
    }
    return out;
  }
};

double value_of(const RobotParams& table, const TableField& field) {
  RobotParams copy = table;
  return *field.slot(copy, field.index);
}

// Every field is found within its own standard deviation as often as chance has it.
TEST(TrackerFit, LengthsRadiusAndStiffnessAreFoundWithinTheirUncertaintyOver100Arms) {
  const RobotParams table = lab_1g(2.0).table;
  std::vector<TableField> fields = geometry_fields(table);
  for (const TableField& field : load_fields(table)) {
    if (field.field.ends_with("joint_stiffness_Nm_per_rad")) fields.push_back(field);
  }
  std::vector<double> squares(fields.size()), sd(fields.size());
  double worst = 0.0, before_m = 0.0, after_m = 0.0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    TrackedArm arm_seen(table, seed);
    const TrackerResult found = tracker_fit(table, {}, arm_seen.poses());
    ASSERT_EQ(found.values.size(), fields.size());
    for (std::size_t f = 0; f < fields.size(); ++f) {
      const double off = (found.values[f].value - value_of(arm_seen.truth, fields[f])) / found.values[f].sd;
      squares[f] += off * off / kSeeds;
      sd[f] += found.values[f].sd / fields[f].table_sd / kSeeds;
      worst = std::max(worst, std::fabs(off));
    }
    before_m += found.before.tip_m / kSeeds;
    after_m += found.after.tip_m / kSeeds;
  }
  for (std::size_t f = 0; f < fields.size(); ++f) {
    EXPECT_LT(std::sqrt(squares[f]), 1.4) << fields[f].field;
    EXPECT_GT(std::sqrt(squares[f]), 0.5) << fields[f].field << ": its deviation is no larger than it has to be";
    if (fields[f].field.ends_with("module_length_m")) {
      EXPECT_LT(sd[f], 0.6) << fields[f].field << ": of what is known before";
    }
    if (fields[f].field.starts_with("cables.hole_radius_m")) {
      EXPECT_LT(sd[f], 0.2) << fields[f].field;
    }
  }
  EXPECT_LT(worst, 4.5) << "of " << kSeeds * fields.size() << " values";
  EXPECT_LT(after_m, 0.3 * before_m);
}

TEST(TrackerFit, TheZerosOfTheCablesAreFoundAndPutRight) {
  config::RobotConfig arm = lab_1g(0.0);
  TrackedArm arm_seen(arm.table, 7);
  arm_seen.zero_m[4] = 0.5e-3;
  const TrackerResult found = tracker_fit(arm.table, {}, arm_seen.poses(20));
  EXPECT_NEAR(found.zero_m[4], 0.5e-3, 0.15e-3);
  Calibration calibration{arm.name, config::sha256_hex(arm.canonical_json), kDay, {}};
  for (std::size_t i = 0; i < 15; ++i)
    calibration.cables.push_back({static_cast<std::uint32_t>(i + 1), i % 2 == 0 ? 1 : -1, 500000, 0.012, 30.0, 0.0});
  const Calibration before = calibration;
  shift_zeros(found.zero_m, arm, calibration);
  for (std::size_t i = 0; i < 15; ++i) {
    config::RobotConfig old_arm = arm, new_arm = arm;
    apply(before, old_arm);
    apply(calibration, new_arm);
    const DriveParams &old_drive = old_arm.table.drive[i], &new_drive = new_arm.table.drive[i];
    const double longer_m = new_drive.direction * new_drive.metres_per_count * (500000 - new_drive.zero_counts);
    EXPECT_NEAR(longer_m, found.zero_m[i], 0.5 * old_drive.metres_per_count);
    EXPECT_DOUBLE_EQ(calibration.cables[i].offset_m, found.zero_m[i]);
  }
}

TEST(TrackerFit, StiffnessIsKnownAsItWasFoundAndTheTableIsWhereLengthsBegin) {
  const RobotParams table = lab_1g(2.0).table;
  TrackedArm arm_seen(table, 3);
  const std::vector<FieldValue> known{{"segments[0].module_length_m", 0.0601, 1e-9},
                                      {"segments[1].joint_stiffness_Nm_per_rad", 2.2, 1e-5}};
  const TrackerResult found = tracker_fit(table, known, arm_seen.poses());
  const auto value = [&](const char* field) {
    return std::ranges::find(found.values, field, &FieldValue::field)->value;
  };
  EXPECT_NEAR(value("segments[1].joint_stiffness_Nm_per_rad"), 2.2, 1e-4);
  EXPECT_NEAR(value("segments[0].module_length_m"), arm_seen.truth.segment[0].module_length_m, 0.2e-3);
}

TEST(TrackerFit, ALengthFarFromItsTableAndATrackerWhoseMarkerMovesAreProblems) {
  const RobotParams table = lab_1g(0.0).table;
  TrackedArm longer(table, 5, 0.0);
  longer.truth.segment[1].module_length_m *= 1.05;
  const TrackerResult found = tracker_fit(table, {}, longer.poses());
  ASSERT_FALSE(found.problems.empty());
  EXPECT_NE(found.problems.front().find("segments[1].module_length_m"), std::string::npos) << found.problems.front();

  TrackedArm loose(table, 6);
  std::vector<StillPose> poses = loose.poses();
  for (std::size_t i = 0; i < poses.size(); i += 2) poses[i].marker_in_tracker.position_m[1] += 0.02;
  EXPECT_FALSE(tracker_fit(table, {}, poses).problems.empty());
  EXPECT_TRUE(tracker_fit(table, {}, TrackedArm(table, 6).poses()).problems.empty());
}

TEST(TrackerFit, TooFewPosesAndPosesThatHardlyBendTheArmAreRefused) {
  const RobotParams table = lab_1g(0.0).table;
  TrackedArm arm_seen(table, 9);
  EXPECT_THROW(tracker_fit(table, {}, arm_seen.poses(kMinTrackerPoses - 1)), std::runtime_error);
  EXPECT_NO_THROW(tracker_fit(table, {}, arm_seen.poses(kMinTrackerPoses)));
  EXPECT_THROW(tracker_fit(table, {}, arm_seen.poses(kPoses, 0.0)), std::runtime_error);
}

TEST(HandEye, FramesAreFoundWhateverTheyAre) {
  RandomStream random(1, 2);
  for (int i = 0; i < 100; ++i) {
    const HandEye truth{drawn_pose(random, 2.0, 1.5), drawn_pose(random, 0.1, 1.5)};
    std::vector<Pose> tips, markers;
    for (int p = 0; p < 8; ++p) {
      tips.push_back(drawn_pose(random, 0.3, 0.4));
      markers.push_back(truth.marker_in_tracker(tips.back()));
    }
    const HandEye found = hand_eye(tips, markers);
    for (const auto& [a, b] :
         {std::pair{found.base_in_tracker, truth.base_in_tracker}, {found.marker_in_tip, truth.marker_in_tip}}) {
      EXPECT_LT(norm(subtract(a.position_m, b.position_m)), 1e-9);
      EXPECT_LT(norm(rotation_vector(multiply(a.quaternion, conjugate(b.quaternion)))), 1e-9);
    }
  }
}

}  // namespace
}  // namespace liana::calibration
