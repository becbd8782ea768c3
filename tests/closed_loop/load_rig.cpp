#include "load_rig.hpp"

#include <algorithm>
#include <cmath>

#include "arm_under_control.hpp"
#include "firmware_like/cable/arm/payout.hpp"
#include "firmware_like/cable/arm/static_load.hpp"
#include "firmware_like/math/trig.hpp"
#include "host/base/random/random.hpp"
#include "host/drives/calibration/hand_eye.hpp"

namespace liana::closed_loop {

using namespace cable;
namespace {

constexpr double kRate_rad_s = 1.5 * kDegree;
constexpr double kSettle_s = 1.5;
constexpr int kReadings = 250;

void go_to(ArmUnderControl& arm, const ThetaVector& goal_rad) {
  double max_rad = 0.0;
  for (std::size_t k = 0; k < goal_rad.size(); ++k)
    max_rad = std::max(max_rad, std::fabs(goal_rad[k] - arm.outputs().theta_command_rad[k]));
  arm.move_joints(goal_rad, std::max(0.5, 1.9 * max_rad / kRate_rad_s));
}

calibration::LoadReading read(ArmUnderControl& arm) {
  arm.hold(kSettle_s);
  calibration::LoadReading sum;
  for (int i = 0; i < kReadings; ++i) {
    arm.step();
    for (std::size_t k = 0; k < sum.theta_rad.size(); ++k)
      sum.theta_rad[k] += arm.outputs().theta_measured_rad[k] / kReadings;
    for (std::size_t c = 0; c < sum.tension_N.size(); ++c)
      sum.tension_N[c] += arm.outputs().tension_measured_N[c] / kReadings;
  }
  return sum;
}

calibration::LoadReading come_to(ArmUnderControl& arm, const calibration::LoadPose& pose, double side) {
  go_to(arm, pose.beside_rad(side));
  go_to(arm, pose.theta_rad);
  return read(arm);
}

PlantSetup setup_of(const LabMounting& mounting, std::uint64_t seed, double geometry_share = 0.0,
                    const CableVector& zero_m = {}) {
  return {"nominal",      seed,  true, "park", CLOSED_LOOP_DATA "/lab_1g.json", mounting.gravity_m_s2,
          geometry_share, zero_m};
}

// A marker at the true tip as a tracker sees it, both somewhere.
Pose seen(const Pose& tip_in_base, simulated::RandomStream& random) {
  const calibration::HandEye tracker{{{1.5, -0.4, 0.8}, quaternion_of({0.3, -1.1, 0.6})},
                                     {{0.03, 0.02, -0.04}, quaternion_of({-0.5, 0.2, 0.9})}};
  const auto noise = [&](double sd) { return Vec3{random.normal(sd), random.normal(sd), random.normal(sd)}; };
  const Pose marker = tracker.marker_in_tracker(tip_in_base);
  return {add(marker.position_m, noise(0.1e-3)), multiply(quaternion_of(noise(1e-3)), marker.quaternion)};
}

double root_mean(const CableVector& a, const CableVector& b, std::int32_t count) {
  double sum = 0.0;
  for (std::size_t c = 0; c < static_cast<std::size_t>(count); ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return std::sqrt(sum / count);
}

}  // namespace

calibration::LoadResult find_load(const LabMounting& mounting, std::uint64_t seed,
                                  const std::vector<calibration::LoadPose>& poses) {
  const RobotParams table = lab_table(mounting.gravity_m_s2);
  ArmUnderControl arm(setup_of(mounting, seed), table);
  arm.boot();
  calibration::LoadFit fit(table);
  for (const calibration::LoadPose& pose : poses) {
    std::array<calibration::LoadReading, 2> sides;
    for (const std::size_t side : {0U, 1U}) sides[side] = come_to(arm, pose, side == 0 ? -1.0 : 1.0);
    fit.add(sides);
  }
  return fit.solve();
}

calibration::TrackerResult find_geometry(const LabMounting& mounting, std::uint64_t seed, double geometry_share,
                                         const std::vector<calibration::LoadPose>& poses) {
  const RobotParams table = lab_table(mounting.gravity_m_s2);
  ArmUnderControl arm(setup_of(mounting, seed, geometry_share), table);
  arm.boot();
  simulated::RandomStream random(seed, 78);
  std::vector<calibration::StillPose> still;
  for (const calibration::LoadPose& pose : poses) {
    const calibration::LoadReading now = come_to(arm, pose, 1.0);
    still.push_back({now.theta_rad, {}, now.tension_N, seen(arm.plant().tip_in_base(), random)});
    for (std::size_t c = 0; c < static_cast<std::size_t>(table.cable_count()); ++c) {
      const DriveParams& drive = table.drive[c];
      still.back().position_m[c] = payout_at_counts(drive, 0.0, arm.inputs().drive[c].position_counts);
    }
  }
  return calibration::tracker_fit(table, {}, still);
}

Standing standing(const LabMounting& mounting, std::uint64_t seed, const RobotParams& table,
                  const std::vector<calibration::LoadPose>& poses, double geometry_share, const CableVector& zero_m) {
  ArmUnderControl arm(setup_of(mounting, seed, geometry_share, zero_m), table);
  arm.boot();
  Standing out;
  for (const calibration::LoadPose& pose : poses) {
    Eigen::VectorXd left_Nm = Eigen::VectorXd::Zero(table.theta_count());
    CableVector measured_N{}, planned_N{};
    for (const double side : {-1.0, 1.0}) {
      const calibration::LoadReading now = come_to(arm, pose, side);
      out.tip_error_m.push_back(1e-3 * arm.error_against_command().tip_mm);
      left_Nm += 0.5 * calibration::load_equations(table, {}, now.theta_rad, now.tension_N).left_Nm;
      for (std::size_t c = 0; c < measured_N.size(); ++c) {
        measured_N[c] += 0.5 * now.tension_N[c];
        planned_N[c] += 0.5 * arm.outputs().tension_plan_N[c];
      }
    }
    out.tension_error_N.push_back(root_mean(measured_N, planned_N, table.cable_count()));
    out.load_error_Nm.push_back(std::sqrt(left_Nm.squaredNorm() / table.theta_count()));
  }
  return out;
}

RobotParams with(const RobotParams& table, const calibration::FieldsFound& found) {
  RobotParams out = table;
  calibration::set_fields(calibration::table_fields(table), found.values, out);
  return out;
}

std::vector<calibration::LoadPose> drawn_poses(const RobotParams& table, std::uint64_t seed, std::size_t count) {
  simulated::RandomStream random(seed, 77);
  std::vector<calibration::LoadPose> out;
  while (out.size() < count) {
    ThetaVector theta_rad{};
    for (std::size_t k = 0; k < static_cast<std::size_t>(table.theta_count()); ++k)
      theta_rad[k] = 0.8 * table.segment[k / 2].theta_limit_rad * random.uniform(-1.0, 1.0);
    out.push_back(calibration::load_pose(table, theta_rad));
  }
  return out;
}

}  // namespace liana::closed_loop
