// Where slit, plates and rod really stand in the arm's base, and by how much the arm's cables are longer than measured:
// both from what the tip camera sees, by one Kalman filter.
//
// The state is a rigid shift of slit and rod against the drawing (3 metres, 3 radians: about the slit frame's origin,
// in the base's axes) and two errors of each cable's length: one that stays (zero, stretch, friction that nobody
// declared) and one that comes and goes (friction that turns with motion). Errors of lengths, not of angles: a zero
// that is off stays off by as much when the arm moves. What a picture says of all together is exact; what it says of
// each is as good as the arm has moved, and the covariance knows it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "host/control/clearance_bound/length_errors.hpp"
#include "host/control/clearance_bound/measured_arm.hpp"
#include "host/model/config/config.hpp"

namespace liana::clearance_bound {

// One picture of the tip camera: frames as seen from the tip; nothing where out of sight.
struct Picture {
  std::uint64_t tick = 0;  // at capture
  std::optional<Pose> slit_in_tip, rod_in_tip;
};

// How much is known before anything is seen, and how fast it gets old: standard deviations.
struct RegistrationPriors {
  double shift_m = 0.005;     // of each axis: a scene 10 mm beside its drawing is two of them
  double turn_rad = 0.0087;   // the same: 1 degree
  double lasting_m = 25e-6;   // of each cable: zero within 0.05 mm, stretch within 5 %
  double lasting_s = 300.0;   // within this time it forgets most of what it was
  double friction_mu = 0.03;  // capstan coefficient beside the one that was told: worn and undeclared is two of them
  double friction_s = 2.0;    // within this time what it does to lengths forgets most of what it was
};

class Registration {
 public:
  // The unknowns: six of the shift, then the lasting error of each cable, then the passing ones.
  static constexpr int kMost = 6 + 2 * kMaxCables;
  using State = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMost, 1>;
  using Covariance = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMost, kMost>;

  // A scene without a slit or a rod has none that is seen. Nothing is allocated after this.
  Registration(const RobotParams& table, const config::SceneConfig& scene, const RegistrationPriors& priors = {});

  // Time passes, and the arm is at `theta_rad` now: what was seen gets old.
  void advance(double dt_s, const ThetaVector& theta_rad);
  // Mean square of how far `picture` is from what is expected, in standard deviations (1 is as expected), with the
  // angles measured at its capture.
  double surprise(const Picture& picture, const MeasuredArm& measured) const;
  // Takes it in.
  void take(const Picture& picture, const MeasuredArm& measured);

  // Where a point of slit, plates or rod is that is drawn at `drawn_m`, and back.
  Vec3 registered(const Vec3& drawn_m) const;
  Vec3 drawn(const Vec3& registered_m) const;
  Pose registered(const Pose& drawn) const;
  // The shift itself: metres at the slit frame's origin and rotation vector, base axes.
  Vec3 shift_m() const { return {state_[0], state_[1], state_[2]}; }
  Vec3 turn_rad() const { return {state_[3], state_[4], state_[5]}; }
  // By how much cables are longer than measured, both errors together.
  CableVector length_error_m() const;
  // Variance of `shift` . shift + `turn` . turn + the sum of `length`[cable] * (both its errors).
  double variance(const Vec3& shift, const Vec3& turn, const CableVector& length) const;
  const Vec3& pivot_m() const { return slit_.position_m; }

 private:
  // Six equations about one frame that is seen: residual = rows * (truth - state) + noise.
  struct Equations {
    Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, kMost> rows;
    Eigen::Matrix<double, 6, 1> residual;
  };
  void forget(Eigen::Index first, const CableVector& sigma_m, double kept);
  Equations equations(const Pose& drawn, const Pose& seen_in_tip, const ArmKinematics& arm,
                      const AnglesOfLengths& angles) const;
  double update(const Picture& picture, const MeasuredArm& measured, State& state, Covariance& covariance) const;

  RobotParams table_;
  CableLayout layout_;
  RegistrationPriors priors_;
  bool has_slit_, has_rod_;
  Pose slit_, rod_;  // as drawn
  double noise_m2_, noise_rad2_;
  State state_;
  Covariance covariance_;
};

}  // namespace liana::clearance_bound
