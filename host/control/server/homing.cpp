#include "host/control/server/homing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "host/drives/calibration/jig.hpp"
#include "host/model/config/drive_names.hpp"

namespace liana::server {
namespace {

using Index = std::size_t;

// The cables of a segment and the part of their lengths that no angles of it explain.
struct Contradiction {
  Index segment = 0;
  Index first = 0, cables = 0;
  double largest_m = 0.0;
};

std::vector<Contradiction> contradictions(const cable::RobotParams& table, const cable::EstimatorState& estimator) {
  std::vector<Contradiction> out;
  Index first = 0;
  for (Index m = 0; m < static_cast<Index>(table.segment_count); ++m) {
    Contradiction of{m, first, static_cast<Index>(table.segment[m].cables)};
    for (Index c = first; c < first + of.cables; ++c)
      of.largest_m = std::fmax(of.largest_m, std::fabs(estimator.residual_m[c]));
    first += of.cables;
    if (!(of.largest_m < cable::kHomingResidual_m)) out.push_back(of);
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Contradiction& a, const Contradiction& b) { return a.largest_m > b.largest_m; });
  return out;
}

std::string text_of(const Contradiction& found) {
  char text[100];
  std::snprintf(text, sizeof text, "%zu to %zu (segment %zu) contradict each other by %.1f mm", found.first + 1,
                found.first + found.cables, found.segment + 1, 1e3 * found.largest_m);
  return text;
}

NotHomed why_lengths_do_not_fit(const cable::RobotParams& table, const cable::EstimatorState& estimator) {
  std::string out;
  for (const Contradiction& found : contradictions(table, estimator))
    out += (out.empty() ? "cables " : ", cables ") + text_of(found);
  if (out.empty())
    return {NotHomedReason::kNotSettled,
            "the angles that the cables' lengths say have not settled: wait, or look for a drum that turns"};
  char allowed[40];
  std::snprintf(allowed, sizeof allowed, "; allowed %.1f mm: ", 1e3 * cable::kHomingResidual_m);
  return {
      NotHomedReason::kLengthsContradict,
      out + allowed + "look for cables on each other's drums, slack ones and wrong zeros, then run liana calibrate"};
}

}  // namespace

double paid_out_m(const cable::DriveParams& drive, const DriveFeedback& feedback) {
  return drive.direction * (static_cast<double>(feedback.position_counts) - drive.zero_counts) * drive.metres_per_count;
}

double reported_tension_N(const cable::DriveParams& drive, const DriveFeedback& feedback) {
  return feedback.torque_permille * drive.newtons_per_permille;
}

cable::CableVector paid_out_m(const cable::RobotParams& table, const cable::Inputs& inputs) {
  cable::CableVector out{};
  for (Index i = 0; i < static_cast<Index>(table.cable_count()); ++i)
    out[i] = paid_out_m(table.drive[i], inputs.drive[i]);
  return out;
}

cable::CableVector reported_tension_N(const cable::RobotParams& table, const cable::Inputs& inputs) {
  cable::CableVector out{};
  for (Index i = static_cast<Index>(table.feed_count()); i < static_cast<Index>(table.cable_count()); ++i)
    out[i] = reported_tension_N(table.drive[i], inputs.drive[i]);
  return out;
}

Homing::Homing(const config::RobotConfig& robot, const std::string& in_pose) : robot_(robot), in_pose_(in_pose) {
  if (!in_pose.empty()) calibration::check_tells_apart(robot, in_pose);
}

void Homing::remember(std::span<const double> joint_rad) {
  cable::ThetaVector theta_rad{};
  std::copy_n(joint_rad.begin(), std::min(joint_rad.size(), theta_rad.size()), theta_rad.begin());
  cable::CableVector tension_N;
  tension_N.fill(robot_.table.tension.plan_N);
  left_m_ = calibration::beyond_zero_m(robot_.table, theta_rad, tension_N);
}

// Drives that stand whole turns of their encoders from where they were left.
std::string Homing::lost_turns(const cable::CableVector& now_m) const {
  std::string out;
  const config::DriveNames names(robot_);
  for (Index i = 0; left_m_ && i < static_cast<Index>(robot_.table.cable_count()); ++i) {
    const std::string turns = calibration::whole_turns(robot_, i, now_m[i] - (*left_m_)[i]);
    if (!turns.empty()) out += (out.empty() ? "" : ", ") + names.drive(i) + " " + turns;
  }
  if (out.empty()) return "";
  return "; from where the arm was left, its encoder has lost or gained whole turns: " + out +
         ": does it count turns without power? Set its place with the maker's tool, or run liana calibrate";
}

void Homing::look(const realtime::ArmTickStatus<cable::CableArm>& report, const cable::EstimatorState& estimator) {
  const cable::RobotParams& table = robot_.table;
  for (Index i = 0; i < static_cast<Index>(table.cable_count()); ++i) {
    if (report.inputs.drive[i].feedback_age_ticks == 0xFFFF) return;
  }
  const cable::CableVector now_m = paid_out_m(table, report.inputs);
  not_homed_ = {NotHomedReason::kHomed, ""};
  if (!in_pose_.empty()) {
    const std::string why =
        calibration::contradiction(robot_, in_pose_, now_m, reported_tension_N(table, report.inputs));
    if (!why.empty()) not_homed_ = {NotHomedReason::kOtherPose, why};
    if (why.empty() && report.outputs.homed != 0) in_pose_.clear();
  }
  if (not_homed_.is_homed() && report.outputs.homed == 0) {
    not_homed_ = why_lengths_do_not_fit(table, estimator);
    not_homed_.text += lost_turns(now_m);
  }
  if (not_homed_.is_homed()) left_m_ = now_m;
}

}  // namespace liana::server
