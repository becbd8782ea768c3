#include "host/control/clearance_bound/registration.hpp"

#include <cmath>

#include "firmware_like/math/trig.hpp"
#include "host/base/eigen/thetas.hpp"

namespace liana::clearance_bound {
namespace {

using Index = Eigen::Index;
using eigen::view;

// Beside the camera's own noise: what the arm moves between the measurement and the picture, and bends between nodes.
constexpr double kModel_m = 0.5e-3;
constexpr double kModel_rad = 0.02 * kDegree;
constexpr double kMotion_s = 0.03;  // of what moves: friction's part in the measured angles jumps where motion turns

struct TipMotion {
  Vec3 speed_m_s{}, turn_rad_s{};
};

TipMotion tip_motion(const ArmKinematics& arm, const MeasuredArm& measured, std::size_t thetas) {
  TipMotion motion;
  for (std::size_t i = 0; i < thetas; ++i) {
    motion.speed_m_s = add(motion.speed_m_s, scale(arm.tip_jacobian.linear[i], measured.rate_rad_s[i]));
    motion.turn_rad_s = add(motion.turn_rad_s, scale(arm.tip_jacobian.angular[i], measured.rate_rad_s[i]));
  }
  return motion;
}

Pose pose_of(const config::ScenePose& pose) { return {pose.position_m, pose.quaternion_wxyz}; }

double square(double x) { return x * x; }

Eigen::Matrix3d cross_matrix(const Vec3& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v[2], v[1], v[2], 0.0, -v[0], -v[1], v[0], 0.0;
  return m;
}

}  // namespace

Registration::Registration(const RobotParams& table, const config::SceneConfig& scene, const RegistrationPriors& priors)
    : table_(table),
      layout_(cable_layout(table)),
      priors_(priors),
      has_slit_(scene.slit.has_value()),
      has_rod_(scene.rod.has_value()),
      slit_(scene.slit ? pose_of(scene.slit->frame) : Pose{}),
      rod_(scene.rod ? pose_of(scene.rod->pose) : Pose{}),
      noise_m2_(square(kModel_m)),
      noise_rad2_(square(kModel_rad)),
      state_(State::Zero(6 + 2 * table.cable_count())),
      covariance_(Covariance::Zero(state_.size(), state_.size())) {
  if (scene.camera) {
    noise_m2_ += square(scene.camera->noise_m);
    noise_rad2_ += square(scene.camera->noise_deg * kDegree);
  }
  covariance_.diagonal().head<3>().setConstant(square(priors.shift_m));
  covariance_.diagonal().segment<3>(3).setConstant(square(priors.turn_rad));
  covariance_.diagonal().segment(6, table.cable_count()).setConstant(square(priors.lasting_m));
}

// Length errors wander within what is known of them beforehand (a Gauss-Markov process); the scene stands still.
void Registration::advance(double dt_s, const ThetaVector& theta_rad) {
  CableVector lasting_m;
  lasting_m.fill(priors_.lasting_m);
  forget(6, lasting_m, std::exp(-dt_s / priors_.lasting_s));
  const CableVector friction_m =
      lengths_of_friction(table_, layout_, theta_rad, priors_.friction_mu, table_.tension.plan_N);
  forget(6 + table_.cable_count(), friction_m, std::exp(-dt_s / priors_.friction_s));
}

void Registration::forget(Index first, const CableVector& sigma_m, double kept) {
  const Index cables = table_.cable_count();
  state_.segment(first, cables) *= kept;
  covariance_.middleRows(first, cables) *= kept;
  covariance_.middleCols(first, cables) *= kept;
  for (Index c = 0; c < cables; ++c)
    covariance_(first + c, first + c) += (1.0 - kept * kept) * square(sigma_m[static_cast<std::size_t>(c)]);
}

CableVector Registration::length_error_m() const {
  CableVector out{};
  const Index cables = table_.cable_count();
  for (Index c = 0; c < cables; ++c) out[static_cast<std::size_t>(c)] = state_[6 + c] + state_[6 + cables + c];
  return out;
}

double Registration::variance(const Vec3& shift, const Vec3& turn, const CableVector& length) const {
  const Index cables = table_.cable_count();
  State slope(state_.size());
  slope << view(shift), view(turn), Eigen::Map<const Eigen::VectorXd>(length.data(), cables),
      Eigen::Map<const Eigen::VectorXd>(length.data(), cables);
  return std::fmax(0.0, slope.dot(covariance_ * slope));
}

Vec3 Registration::registered(const Vec3& drawn_m) const {
  return add(add(slit_.position_m, shift_m()), rotate(quaternion_of(turn_rad()), subtract(drawn_m, slit_.position_m)));
}

Vec3 Registration::drawn(const Vec3& registered_m) const {
  const Vec3 from_origin = subtract(registered_m, add(slit_.position_m, shift_m()));
  return add(slit_.position_m, rotate(conjugate(quaternion_of(turn_rad())), from_origin));
}

Pose Registration::registered(const Pose& drawn) const {
  return {registered(drawn.position_m), normalize(multiply(quaternion_of(turn_rad()), drawn.quaternion))};
}

// What is seen, put into the base through the arm as it is believed to be, against where it is believed to stand.
Registration::Equations Registration::equations(const Pose& drawn, const Pose& seen_in_tip, const ArmKinematics& arm,
                                                const AnglesOfLengths& angles) const {
  const Pose seen = compose(arm.tip_in_base, seen_in_tip), believed = registered(drawn);
  const Vec3 from_tip = subtract(believed.position_m, arm.tip_in_base.position_m);
  Equations out;
  out.rows.setZero(6, state_.size());
  out.rows.topLeftCorner<3, 3>().setIdentity();
  out.rows.block<3, 3>(0, 3) = -cross_matrix(subtract(believed.position_m, add(slit_.position_m, shift_m())));
  out.rows.block<3, 3>(3, 3).setIdentity();
  for (Index c = 0; c < table_.cable_count(); ++c) {
    Vec3 moved{}, turned{};
    for (std::size_t i = 0; i < static_cast<std::size_t>(table_.theta_count()); ++i) {
      const double share = angles[static_cast<std::size_t>(c)][i];
      moved = add(moved, scale(arm.tip_jacobian.linear[i], share));
      turned = add(turned, scale(arm.tip_jacobian.angular[i], share));
    }
    moved = add(moved, cross(turned, from_tip));
    out.rows.block<3, 1>(0, 6 + c) = -view(moved);
    out.rows.block<3, 1>(3, 6 + c) = -view(turned);
  }
  out.rows.rightCols(table_.cable_count()) = out.rows.middleCols(6, table_.cable_count());
  out.residual.head<3>() = view(subtract(seen.position_m, believed.position_m));
  out.residual.tail<3>() = view(rotation_vector(normalize(multiply(seen.quaternion, conjugate(believed.quaternion)))));
  return out;
}

// One scalar equation after the other: their noise is independent, and nothing has to be inverted.
double Registration::update(const Picture& picture, const MeasuredArm& measured, State& state,
                            Covariance& covariance) const {
  const AnglesOfLengths angles = angles_of_lengths(table_, layout_, measured.theta_rad);
  const ArmKinematics arm =
      forward_kinematics(table_, changed(angles, measured.theta_rad, length_error_m(), table_.cable_count()));
  const TipMotion motion = tip_motion(arm, measured, static_cast<std::size_t>(table_.theta_count()));
  const double noise_rad2 = noise_rad2_ + square(kMotion_s) * dot(motion.turn_rad_s, motion.turn_rad_s);
  double sum = 0.0;
  int count = 0;
  State change = State::Zero(state.size());
  const auto take = [&](const Pose& drawn, const Pose& seen) {
    const Vec3 from_tip = subtract(drawn.position_m, arm.tip_in_base.position_m);
    const Vec3 slip_m_s = add(motion.speed_m_s, cross(motion.turn_rad_s, from_tip));
    const double noise_m2 = noise_m2_ + square(kMotion_s) * dot(slip_m_s, slip_m_s);
    const Equations e = equations(drawn, seen, arm, angles);
    for (Index row = 0; row < 6; ++row) {
      const State gain = covariance * e.rows.row(row).transpose();
      const double variance = e.rows.row(row).dot(gain) + (row < 3 ? noise_m2 : noise_rad2);
      const double off = e.residual[row] - e.rows.row(row).dot(change);
      change += gain * (off / variance);
      covariance -= gain * gain.transpose() / variance;
      sum += off * off / variance;
      ++count;
    }
  };
  if (has_slit_ && picture.slit_in_tip) take(slit_, *picture.slit_in_tip);
  if (has_rod_ && picture.rod_in_tip) take(rod_, *picture.rod_in_tip);
  state += change;
  return count > 0 ? sum / count : 0.0;
}

double Registration::surprise(const Picture& picture, const MeasuredArm& measured) const {
  State state = state_;
  Covariance covariance = covariance_;
  return update(picture, measured, state, covariance);
}

void Registration::take(const Picture& picture, const MeasuredArm& measured) {
  State state = state_;
  Covariance covariance = covariance_;
  update(picture, measured, state, covariance);
  state_ = state;
  covariance_ = 0.5 * (covariance + covariance.transpose());  // rounding must not make it lopsided
}

}  // namespace liana::clearance_bound
