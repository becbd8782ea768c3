#include "host/drives/calibration/tracker_fit.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "firmware_like/cable/arm/cables.hpp"
#include "firmware_like/math/trig.hpp"
#include "host/drives/calibration/hand_eye.hpp"
#include "host/drives/calibration/jig.hpp"
#include "host/drives/calibration/load_model.hpp"
#include "host/drives/calibration/text.hpp"
#include "host/model/config/drive_names.hpp"

namespace liana::calibration {

using namespace cable;
namespace {

using Index = std::size_t;
using Eigen::MatrixXd, Eigen::VectorXd;

constexpr double kLengthNoise_m = 0.03e-3;  // of a cable: what friction changes of its stretch, and a count
constexpr double kFrameRoom = 0.1;          // m and rad: how far frames may be off to begin with
constexpr int kFitSteps = 6;                // of Gauss-Newton
constexpr int kAngleSteps = 3;              // of each pose's angles, in each of them
constexpr double kAngleChange_rad = 1e-6, kChange = 1e-4;  // of differences; the second in prior deviations
constexpr Index kPoseRows = 6;                             // of a marker
constexpr double kScatter = 10.0;                          // times the noise: then something is wrong

Pose moved(const Pose& pose, const VectorXd& by) {
  return {add(pose.position_m, {by(0), by(1), by(2)}), multiply(quaternion_of({by(3), by(4), by(5)}), pose.quaternion)};
}

// From one pose to another: position [m], then rotation [rad].
VectorXd difference(const Pose& from, const Pose& to) {
  const Vec3 by_m = subtract(to.position_m, from.position_m),
             by_rad = rotation_vector(multiply(to.quaternion, conjugate(from.quaternion)));
  VectorXd out(kPoseRows);
  out << by_m[0], by_m[1], by_m[2], by_rad[0], by_rad[1], by_rad[2];
  return out;
}

// What readings of tension and what friction takes may be off by, about each theta. The arm comes to its poses from one
// side, and friction may err alike in all of them: all together count as one.
VectorXd torque_noise_Nm(const RobotParams& table, const StillPose& pose) {
  const LoadEquations one = load_equations(table, {}, pose.theta_rad, pose.tension_N);
  const SegmentVector wrap_rad = cable_wraps(table, arm_trig(table, pose.theta_rad));
  VectorXd noise_Nm = one.reading_Nm;
  double bend_rad = 0.0;
  for (Index k = 0; k < static_cast<Index>(noise_Nm.size()); ++k) {
    if (k % 2 == 0) bend_rad += wrap_rad[k / 2];
    double& each_Nm = noise_Nm(eigen_index(k));
    each_Nm = std::hypot(each_Nm, table.friction_mu * bend_rad * one.rows.row(eigen_index(k)).norm());
  }
  return noise_Nm;
}

// The arm, its tracker and its drives as corrections make them.
struct Guess {
  RobotParams table;
  HandEye tracker;
  CableVector zero_m{}, gain{};
};

class MarkerFit {
 public:
  MarkerFit(const RobotParams& table, const std::vector<FieldValue>& known, const std::vector<StillPose>& poses)
      : table_(table), poses_(poses), fields_(geometry_fields(table)) {
    std::vector<TableField> load = load_fields(table);
    know(known, load);
    has_load_ = !load.empty();
    const auto rest = std::stable_partition(load.begin(), load.end(), [](const TableField& field) {
      return field.field.ends_with("joint_stiffness_Nm_per_rad");
    });
    fields_.insert(fields_.end(), load.begin(), rest);
    kept_ = fields_.size();
    fields_.insert(fields_.end(), rest, load.end());
    for (const StillPose& pose : poses_) {
      angles_.push_back(pose.theta_rad);
      torque_noise_Nm_.push_back(torque_noise_Nm(table_, pose) * std::sqrt(static_cast<double>(poses_.size())));
    }
    start_ = hand_eye(tips(guess(VectorXd::Zero(eigen_index(count())))), markers());
  }

  TrackerResult solve() {
    VectorXd value = VectorXd::Zero(eigen_index(count()));
    TrackerResult out;
    out.before = error(guess(value));
    for (int step = 0; step < kFitSteps; ++step) value += sum(value).step(value);
    const PriorFit last = sum(value);
    static_cast<FieldsFound&>(out) =
        last.found({fields_.begin(), fields_.begin() + static_cast<std::ptrdiff_t>(kept_)}, value);
    const Guess found = guess(value);
    out.zero_m = found.zero_m;
    out.after = error(found);
    add_problems(last.scatter(kept_ + 2 * kPoseRows), out);
    return out;
  }

 private:
  // The corrections, in their order: fields, tracker to base, marker to tip, zeros, torque gains.
  Index tracker() const { return fields_.size(); }
  Index zeros() const { return tracker() + 2 * kPoseRows; }
  Index gains() const { return zeros() + cables_; }
  Index count() const { return gains() + (has_load_ ? cables_ : 0); }

  Guess guess(const VectorXd& value) const {
    Guess out{table_, start_};
    const auto part = [&](Index begin, Index size) { return value.segment(eigen_index(begin), eigen_index(size)); };
    for (Index f = 0; f < fields_.size(); ++f)
      *fields_[f].slot(out.table, fields_[f].index) =
          fields_[f].known_value + fields_[f].known_sd * value(eigen_index(f));
    out.tracker.base_in_tracker = moved(start_.base_in_tracker, kFrameRoom * part(tracker(), kPoseRows));
    out.tracker.marker_in_tip = moved(start_.marker_in_tip, kFrameRoom * part(tracker() + kPoseRows, kPoseRows));
    for (Index c = 0; c < cables_; ++c) {
      out.zero_m[c] = kPriorZero_m * value(eigen_index(zeros() + c));
      if (has_load_) out.gain[c] = kPriorTorqueGain * value(eigen_index(gains() + c));
    }
    return out;
  }

  std::vector<Pose> markers() const {
    std::vector<Pose> out;
    for (const StillPose& pose : poses_) out.push_back(pose.marker_in_tracker);
    return out;
  }

  // What is left of the readings of one pose, in units of their noise: cables, marker, torques.
  VectorXd left(const Guess& guess, Index p, const ThetaVector& theta_rad) const {
    const StillPose& pose = poses_[p];
    VectorXd out(eigen_index(cables_ + kPoseRows + (has_load_ ? thetas_ : 0)));
    CableVector tension_N = pose.tension_N;
    for (Index c = 0; c < cables_; ++c) tension_N[c] *= 1.0 + guess.gain[c];
    const CableVector expected_m = beyond_zero_m(guess.table, theta_rad, tension_N);
    for (Index c = 0; c < cables_; ++c)
      out(eigen_index(c)) = (pose.position_m[c] + guess.zero_m[c] - expected_m[c]) / kLengthNoise_m;
    const Pose tip = tip_pose(guess.table, arm_trig(guess.table, theta_rad));
    const VectorXd off = difference(guess.tracker.marker_in_tracker(tip), pose.marker_in_tracker);
    out.segment(eigen_index(cables_), 3) = off.head(3) / kTrackerNoise_m;
    out.segment(eigen_index(cables_ + 3), 3) = off.tail(3) / kTrackerNoise_rad;
    if (has_load_)
      out.tail(eigen_index(thetas_)) =
          load_equations(guess.table, {}, theta_rad, tension_N).left_Nm.cwiseQuotient(torque_noise_Nm_[p]);
    return out;
  }

  // The angles at which the first `rows` readings of one pose fit best; returns how the readings change with them.
  MatrixXd settle(const Guess& guess, Index p, Index rows, ThetaVector& theta_rad) const {
    MatrixXd change;
    for (int step = 0; step <= kAngleSteps; ++step) {
      const VectorXd here = left(guess, p, theta_rad);
      change.resize(here.size(), eigen_index(thetas_));
      for (Index k = 0; k < thetas_; ++k) {
        ThetaVector beside_rad = theta_rad;
        beside_rad[k] += kAngleChange_rad;
        change.col(eigen_index(k)) = (left(guess, p, beside_rad) - here) / kAngleChange_rad;
      }
      if (step == kAngleSteps) break;
      const VectorXd by_rad =
          change.topRows(eigen_index(rows)).colPivHouseholderQr().solve(here.head(eigen_index(rows)));
      for (Index k = 0; k < thetas_; ++k) theta_rad[k] -= by_rad(eigen_index(k));
    }
    return change;
  }

  // All readings at these corrections, freed from the angles of their poses.
  PriorFit sum(const VectorXd& value) {
    PriorFit out(count());
    const Guess here = guess(value);
    std::vector<Guess> beside;
    for (Index i = 0; i < count(); ++i) {
      VectorXd changed = value;
      changed(eigen_index(i)) += kChange;
      beside.push_back(guess(changed));
    }
    for (Index p = 0; p < poses_.size(); ++p) {
      const Index all = cables_ + kPoseRows + (has_load_ ? thetas_ : 0);
      const Eigen::HouseholderQR<MatrixXd> angles(settle(here, p, all, angles_[p]));
      const VectorXd now = left(here, p, angles_[p]);
      MatrixXd rows(now.size(), eigen_index(count()));
      for (Index i = 0; i < count(); ++i) rows.col(eigen_index(i)) = (left(beside[i], p, angles_[p]) - now) / kChange;
      const Eigen::Index free = eigen_index(all - thetas_);
      const MatrixXd turned = angles.householderQ().transpose();
      out.add((turned * rows).bottomRows(free), (turned * now).tail(free));
    }
    if (has_load_) {
      MatrixXd amount = MatrixXd::Zero(1, eigen_index(count()));
      const VectorXd row = gravity_row(table_, fields_, 0);
      for (Index f = 0; f < fields_.size(); ++f) amount(0, eigen_index(f)) = row(eigen_index(f)) * fields_[f].known_sd;
      out.add(amount, amount * value);
    }
    return out;
  }

  // By the cables alone.
  std::vector<Pose> tips(const Guess& guess) const {
    std::vector<Pose> out;
    for (Index p = 0; p < poses_.size(); ++p) {
      ThetaVector theta_rad = poses_[p].theta_rad;
      settle(guess, p, cables_, theta_rad);
      out.push_back(tip_pose(guess.table, arm_trig(guess.table, theta_rad)));
    }
    return out;
  }

  TrackerError error(const Guess& guess) const {
    const std::vector<Pose> tip = tips(guess);
    const HandEye best = hand_eye(tip, markers());
    VectorXd squares = VectorXd::Zero(kPoseRows);
    for (Index p = 0; p < poses_.size(); ++p)
      squares += difference(best.marker_in_tracker(tip[p]), poses_[p].marker_in_tracker).array().square().matrix();
    squares /= static_cast<double>(poses_.size());
    return {std::sqrt(squares.head(3).sum()), std::sqrt(squares.tail(3).sum())};
  }

  void add_problems(double scatter, TrackerResult& out) const {
    const config::DriveNames names(table_);
    for (Index c = 0; c < cables_; ++c) {
      if (std::fabs(out.zero_m[c]) <= kPlausibleDeviations * kPriorZero_m) continue;
      out.problems.push_back(names.drive(c) +
                             text(": its zero is %+.2f mm off: allowed %.2f mm: calibrate in jigs again",
                                  1e3 * out.zero_m[c], 1e3 * kPlausibleDeviations * kPriorZero_m));
    }
    if (scatter > kScatter)
      out.problems.push_back(text(
          "readings scatter by %.0f times their noise (tip %.1f mm, %.2f deg): allowed %.0f times: see whether the "
          "marker is rigid on the tip and the run was made with this calibration",
          scatter, 1e3 * out.after.tip_m, out.after.tip_rad / kDegree, kScatter));
  }

  RobotParams table_;
  const std::vector<StillPose>& poses_;
  std::vector<TableField> fields_;  // those that are kept first
  Index kept_ = 0;
  Index cables_ = static_cast<Index>(table_.cable_count()), thetas_ = static_cast<Index>(table_.theta_count());
  bool has_load_ = false;
  std::vector<ThetaVector> angles_;  // of each pose, as found so far
  std::vector<VectorXd> torque_noise_Nm_;
  HandEye start_;
};

}  // namespace

TrackerResult tracker_fit(const RobotParams& table, const std::vector<FieldValue>& known,
                          const std::vector<StillPose>& poses) {
  if (poses.size() < kMinTrackerPoses)
    throw std::runtime_error(
        text("%zu poses at rest: allowed at least %zu: let the arm stand in more", poses.size(), kMinTrackerPoses));
  return MarkerFit(table, known, poses).solve();
}

}  // namespace liana::calibration
