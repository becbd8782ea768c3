#include "host/drives/calibration/load_poses.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "firmware_like/cable/arm/static_load.hpp"
#include "firmware_like/math/trig.hpp"
#include "host/base/random/random.hpp"
#include "host/drives/calibration/load_model.hpp"
#include "host/drives/calibration/text.hpp"

namespace liana::calibration {

using namespace cable;
namespace {

using Index = std::size_t;

constexpr std::uint64_t kSeed = 1, kCandidates = 1, kDirections = 2;  // the same arm always gets the same poses
constexpr int kTried = 400;                                           // candidates
constexpr int kDirectionsTried = 32;                                  // of an approach
constexpr double kPoseShare = 0.8, kApproachShare = 1.0 / 7.0;        // of the limit

// Planned tensions are between the motors' floor and the ceiling.
bool is_borne(const RobotParams& table, const CableLayout& layout, const ThetaVector& theta_rad) {
  const TensionPlan plan = plan_at_rest(table, layout, theta_rad);
  const std::span<const double> tension_N = of_cables(table, plan.motor_N);
  const auto [least, most] = std::minmax_element(tension_N.begin(), tension_N.end());
  return plan.balanced && *least >= table.tension.floor_motor_N && *most <= table.tension.ceiling_free_N;
}

double approach_rad(const RobotParams& table, Index theta) {
  return std::min(kApproach_rad, kApproachShare * table.segment[theta / 2].theta_limit_rad);
}

// Least that any cable slides through the middle of any segment on its way to the pose.
double least_slide_m(const RobotParams& table, const CableLayout& layout, const CableGeometry& there,
                     const ThetaVector& from_rad) {
  const CableGeometry before = cable_geometry(table, layout, arm_trig(table, from_rad));
  double least_m = 1.0;
  for (Index c = 0; c < static_cast<Index>(layout.cable_count); ++c) {
    double beyond_m = 0.0;
    for (Index j = static_cast<Index>(layout.segment[c]) + 1; j-- > 0;) {
      const double change_m = there.part_m[c][j] - before.part_m[c][j];
      least_m = std::min(least_m, std::fabs(beyond_m + 0.5 * change_m));
      beyond_m += change_m;
    }
  }
  return least_m;
}

LoadPose with_approach(const RobotParams& table, const CableLayout& layout, const ThetaVector& theta_rad) {
  simulated::RandomStream random(kSeed, kDirections);
  const CableGeometry there = cable_geometry(table, layout, arm_trig(table, theta_rad));
  LoadPose best{theta_rad, {}};
  double best_m = -1.0;
  for (int i = 0; i < kDirectionsTried; ++i) {
    LoadPose tried{theta_rad, {}};
    for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k)
      tried.approach_rad[k] =
          approach_rad(table, k) * random.uniform(0.3, 1.0) * (random.uniform(-1.0, 1.0) < 0.0 ? -1.0 : 1.0);
    const double slide_m = std::min(least_slide_m(table, layout, there, tried.beside_rad(-1.0)),
                                    least_slide_m(table, layout, there, tried.beside_rad(1.0)));
    if (slide_m <= best_m) continue;
    best_m = slide_m;
    best = tried;
  }
  return best;
}

bool is_borne(const RobotParams& table, const CableLayout& layout, const LoadPose& pose) {
  return is_borne(table, layout, pose.theta_rad) && is_borne(table, layout, pose.beside_rad(-1.0)) &&
         is_borne(table, layout, pose.beside_rad(1.0));
}

// What a reading in this pose adds, every row in units of its noise and every column of what is known before.
Eigen::MatrixXd information(const RobotParams& table, const CableLayout& layout, const std::vector<TableField>& fields,
                            const Eigen::VectorXd& prior, const ThetaVector& theta_rad) {
  const LoadEquations one = load_equations(table, fields, theta_rad, plan_at_rest(table, layout, theta_rad).motor_N);
  const Eigen::MatrixXd rows = one.reading_Nm.array().inverse().matrix().asDiagonal() * one.rows * prior.asDiagonal();
  return rows.transpose() * rows;
}

double log_volume(const Eigen::MatrixXd& known) {
  return Eigen::LLT<Eigen::MatrixXd>(known).matrixL().toDenseMatrix().diagonal().array().log().sum();
}

}  // namespace

ThetaVector LoadPose::beside_rad(double side) const {
  ThetaVector out = theta_rad;
  for (Index k = 0; k < out.size(); ++k) out[k] += side * approach_rad[k];
  return out;
}

std::vector<LoadPose> load_poses(const RobotParams& table, Index count) {
  const std::vector<TableField> fields = load_fields(table);
  if (fields.empty())
    throw std::runtime_error("the robot table has neither gravity_m_s2 nor joint stiffness: there is no load to find");
  const CableLayout layout = cable_layout(table);
  const Eigen::VectorXd prior = prior_sd(fields, static_cast<Index>(table.cable_count()));
  simulated::RandomStream random(kSeed, kCandidates);
  std::vector<LoadPose> candidates;
  std::vector<Eigen::MatrixXd> adds;
  for (int i = 0; i < kTried; ++i) {
    ThetaVector theta_rad{};
    for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k)
      theta_rad[k] = kPoseShare * table.segment[k / 2].theta_limit_rad * random.uniform(-1.0, 1.0);
    if (!is_borne(table, layout, theta_rad)) continue;
    const LoadPose pose = with_approach(table, layout, theta_rad);
    if (!is_borne(table, layout, pose)) continue;
    candidates.push_back(pose);
    adds.push_back(information(table, layout, fields, prior, theta_rad));
  }
  if (candidates.size() < count)
    throw std::runtime_error(
        text("only %zu of %d drawn poses keep their planned tensions between floor and ceiling, "
             "%zu are asked for: name poses, or see what the arm can carry (liana robot check)",
             candidates.size(), kTried, count));
  Eigen::MatrixXd known = Eigen::MatrixXd::Identity(prior.size(), prior.size());
  std::vector<LoadPose> out;
  while (out.size() < count) {
    Index best = 0;
    double most = -1e300;
    for (Index i = 0; i < candidates.size(); ++i) {
      const double volume = log_volume(known + adds[i]);
      if (volume > most) most = volume, best = i;
    }
    known += adds[best];
    out.push_back(candidates[best]);
    candidates.erase(candidates.begin() + static_cast<std::ptrdiff_t>(best));
    adds.erase(adds.begin() + static_cast<std::ptrdiff_t>(best));
  }
  return out;
}

LoadPose load_pose(const RobotParams& table, const ThetaVector& theta_rad) {
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) {
    const double room_rad = table.segment[k / 2].theta_limit_rad - std::fabs(theta_rad[k]);
    if (room_rad < approach_rad(table, k))
      throw std::runtime_error(
          text("angle %zu is %.2f deg from its limit: allowed at least %.2f deg, so that the arm "
               "comes to the pose from both sides",
               k + 1, room_rad / kDegree, approach_rad(table, k) / kDegree));
  }
  const CableLayout layout = cable_layout(table);
  const LoadPose pose = with_approach(table, layout, theta_rad);
  if (!is_borne(table, layout, pose))
    throw std::runtime_error(text("planned tensions leave %g to %g N there: choose another pose",
                                  table.tension.floor_motor_N, table.tension.ceiling_free_N));
  return pose;
}

}  // namespace liana::calibration
