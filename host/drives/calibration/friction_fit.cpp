#include "host/drives/calibration/friction_fit.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <stdexcept>

#include "firmware_like/cable/arm/friction_estimator.hpp"
#include "firmware_like/cable/arm/static_load.hpp"

namespace liana::calibration {

using namespace cable;
namespace {

using Index = std::size_t;

constexpr double kMinMotion_s = 10.0;
constexpr double kSample_s = 0.32;   // an equation of every axis in so much time, as the core's noise is meant
constexpr double kPriorMu = 0.1;     // any friction there is
constexpr double kGainShare = 0.01;  // of torque readings, by drive
constexpr double kKnownShare = 0.2;  // of mu, and
constexpr double kKnown = 0.002;     // added to it: a deviation that counts as known
constexpr int kSteps = 6;            // of Gauss-Newton, which settles in three

Eigen::Index at(Index i) { return static_cast<Eigen::Index>(i); }

}  // namespace

// Everything about one instant that does not change with the parameters.
struct FrictionFit::Moment {
  CableGeometry geometry;
  SegmentVector wrap_rad;
  MassMatrix mass_kg_m2;
  ThetaVector static_Nm;
  const Sample& sample;

  // Bend that cable c slides over within segment j until the middle of segment `own`, signed; and what of it may rest.
  double bend_rad(Index j, Index own) const { return wrap_rad[j] * (j < own ? 1.0 : 0.5); }
  double slid_rad(Index c, Index j, Index own) const { return sample.slip.sigma[c][j] * bend_rad(j, own); }
  double resting_rad(Index c, Index j, Index own) const {
    return (1.0 - std::fabs(sample.slip.sigma[c][j])) * bend_rad(j, own);
  }
  // What a cable that ends in segment `end` does in segment j.
  bool slides(Index j, std::int32_t end) const { return (sample.turning & ((2u << end) - 1u)) >> j != 0; }
};

FrictionFit::FrictionFit(const RobotParams& table) : table_(table), layout_(cable_layout(table)) {}

void FrictionFit::add(const ThetaVector& commanded_rad, const CableVector& tension_N, bool moving) {
  update_cable_geometry(table_, layout_, arm_trig(table_, commanded_rad), geometry_);
  if (!begun_) reset_slip(geometry_, slip_);
  if (!begun_) before_rad_ = commanded_rad;
  begun_ = true;
  advance_slip(layout_, geometry_, slip_);
  const double period_s = table_.interval_ticks * table_.tick_s;
  follow_acceleration(table_, commanded_rad, tension_N, period_s, inertia_);
  ThetaVector rate_rad_s{};
  for (Index k = 0; k < static_cast<Index>(table_.theta_count()); ++k)
    rate_rad_s[k] = (commanded_rad[k] - before_rad_[k]) / period_s;
  before_rad_ = commanded_rad;
  if (!moving) return;
  const auto every = static_cast<std::size_t>(std::lround(kSample_s / period_s));
  if (moved_++ % every == 0) samples_.push_back({commanded_rad, slip_, turning_segments(table_, rate_rad_s), inertia_});
}

// The balance about one axis with the parameters as they are, and how it changes with them.
FrictionFit::Equation FrictionFit::equation(const Moment& now, Index axis, const Fit& fit) const {
  const Index own = axis / 2;
  const double inertia_Nm = inertia_torque_Nm(table_, now.mass_kg_m2, now.sample.inertia.accel_rad_s2, axis);
  Equation out{now.static_Nm[axis] + inertia_Nm, kBalanceNoise_Nm * kBalanceNoise_Nm,
               Eigen::VectorXd::Zero(fit.value.size())};
  for (Index c = 0; c < static_cast<Index>(layout_.cable_count); ++c) {
    if (static_cast<Index>(layout_.segment[c]) < own) continue;
    double exponent = 0.0, unsure = 0.0;
    for (Index j = 0; j <= own; ++j) {
      const double mu = fit.value(at(fit.part(j)));
      exponent -= mu * now.slid_rad(c, j, own);
      const bool slides = now.slides(j, layout_.segment[c]);
      unsure += kResting * std::fmax(mu, 0.0) * (slides ? now.resting_rad(c, j, own) : now.bend_rad(j, own));
    }
    const Eigen::Index gain = at(fit.parts + c);
    const double read_Nm = now.geometry.jacobian_m_rad[c][axis] * std::exp(exponent) * now.sample.inertia.tension_N[c];
    const double torque_Nm = read_Nm * (1.0 + fit.value(gain));
    out.torque_Nm += torque_Nm;
    out.row(gain) = read_Nm;
    for (Index j = 0; j <= own; ++j) {
      if (now.slides(j, layout_.segment[c])) out.row(at(fit.part(j))) -= now.slid_rad(c, j, own) * torque_Nm;
    }
    out.variance_Nm2 += unsure * unsure * torque_Nm * torque_Nm;
  }
  return out;
}

// One step of Gauss-Newton.
void FrictionFit::improve(Fit& fit) const {
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(fit.value.size(), fit.value.size());
  for (Eigen::Index i = 0; i < fit.value.size(); ++i) {
    const double prior = i < at(fit.parts) ? kPriorMu : kGainShare;
    normal(i, i) = 1.0 / (prior * prior);
  }
  Eigen::VectorXd right = -normal.diagonal().cwiseProduct(fit.value);
  for (const Sample& sample : samples_) {
    const ArmTrig trig = arm_trig(table_, sample.theta_rad);
    const ArmKinematics arm = forward_kinematics(table_, trig);
    Moment now{cable_geometry(table_, layout_, trig),
               cable_wraps(table_, trig),
               {},
               static_load_Nm(table_, sample.theta_rad, trig, arm),
               sample};
    update_mass_matrix(table_, arm, now.mass_kg_m2);
    for (Index axis = 0; axis < static_cast<Index>(table_.theta_count()); ++axis) {
      const Equation one = equation(now, axis, fit);
      normal += one.row * one.row.transpose() / one.variance_Nm2;
      right -= one.row * (one.torque_Nm / one.variance_Nm2);
    }
  }
  const Eigen::LDLT<Eigen::MatrixXd> solver(normal);
  fit.value += solver.solve(right);
  fit.variance = solver.solve(Eigen::MatrixXd::Identity(normal.rows(), normal.cols())).diagonal();
}

// `parts`: 1 for the whole arm, or one for each segment.
FrictionFit::Fit FrictionFit::fit(Index parts) const {
  Fit out{parts, Eigen::VectorXd::Zero(at(parts + static_cast<Index>(layout_.cable_count))), {}};
  for (int step = 0; step < kSteps; ++step) improve(out);
  return out;
}

FrictionOf FrictionFit::found(const Fit& fit, Index part) {
  const double mu = std::fmax(fit.value(at(part)), 0.0), model = kFrictionModelShare * mu;
  return {mu, std::sqrt(fit.variance(at(part)) + model * model)};
}

Friction FrictionFit::solve() const {
  if (static_cast<double>(samples_.size()) * kSample_s < kMinMotion_s)
    throw std::runtime_error("friction: the arm has moved for less than 10 s: move it longer");
  Friction out{found(fit(1), 0), {}};
  const Fit each = fit(static_cast<Index>(table_.segment_count));
  for (Index j = 0; j < each.parts; ++j) {
    const FrictionOf own = found(each, j);
    out.segment.push_back(own.sd <= kKnownShare * own.mu + kKnown ? std::optional(own) : std::nullopt);
  }
  return out;
}

}  // namespace liana::calibration
