#include "host/planning/planner/follow/follow_pose.hpp"

#include <algorithm>
#include <cmath>

#include "host/planning/planner/problem/arm_derivatives.hpp"
#include "host/planning/planner/problem/pose_model.hpp"

namespace liana::planner {
namespace {

using Index = std::size_t;

// Against the square of a link end's distance from the track.
constexpr double kTipWeight = 1e8;
constexpr double kPushWeight = 1e3;     // of missing clearance
constexpr double kDamping_m2 = 0.1;     // of the step; ten times more while a theta would move by more than
constexpr double kStepMost_rad = 0.03;  // this: the tip's path bends, and it has to stay where it is
constexpr double kTipDamping_m2 = 1e4;  // of the last steps, which bring the tip onto its place
constexpr std::int32_t kTipSteps = 8;
constexpr double kRamp_m = 0.1;    // a link end counts fully when it is so far past the curve's beginning
constexpr double kWindow_m = 0.2;  // how far a link end may be from where it can be on the track
constexpr double kMaxDamping_m2 = 1e9;
constexpr double kTipThere_m = 1e-8;
constexpr double kStepSettled_rad = 1e-6;

struct Quadratic {
  eigen::ThetaMatrix hessian;
  eigen::ThetaColumn rhs;  // minus the gradient
  explicit Quadratic(Eigen::Index thetas)
      : hessian(eigen::ThetaMatrix::Zero(thetas, thetas)), rhs(eigen::ThetaColumn::Zero(thetas)) {}

  // Adds weight |J dtheta + error|^2 / 2, of the error's part across `along` when that is a unit vector. `bend` times
  // as much in the second derivative: 1 where the weight is constant.
  void add(const Eigen::Ref<const Eigen::Matrix3Xd>& J, const Vec3& error, const Vec3& along, double weight,
           double bend = 1.0) {
    const eigen::SpaceColumns across = J - eigen::view(along) * (eigen::view(along).transpose() * J).eval();
    rhs.noalias() -= weight * across.transpose() * eigen::view(error);
    hessian.noalias() += bend * weight * across.transpose() * J;
  }
};

// The least of a quadratic within the limits: thetas that would pass theirs are set onto them, and the rest is solved
// again.
ThetaVector bounded_step(const RobotParams& table, Quadratic q, double damping, const ThetaVector& theta,
                         std::uint32_t held_mask) {
  const Eigen::Index n = eigen::theta_count(table);
  q.hessian.diagonal().array() += damping;
  for (Eigen::Index k = 0; k < n; ++k) {
    if (((held_mask >> k) & 1u) != 0) eigen::fix_theta(k, 0.0, q.hessian, q.rhs);
  }
  for (Eigen::Index pass = 0; pass <= n; ++pass) {
    const Eigen::LLT<eigen::ThetaMatrix> factor(q.hessian);
    if (factor.info() != Eigen::Success) return {};
    ThetaVector step{};
    eigen::view(step, n) = factor.solve(q.rhs);
    bool within = true;
    for (Index k = 0; k < Index(n); ++k) {
      const double limit = table.segment[k / 2].theta_limit_rad, to = std::clamp(theta[k] + step[k], -limit, limit);
      if (std::fabs(theta[k] + step[k] - to) < 1e-12) continue;
      eigen::fix_theta(static_cast<Eigen::Index>(k), to - theta[k], q.hessian, q.rhs);
      within = false;
    }
    if (within) return step;
  }
  return {};
}

double largest(const ThetaVector& step) {
  double most = 0.0;
  for (const double change : step) most = std::max(most, std::fabs(change));
  return most;
}

double body_weight(const FollowAim& aim, double behind_m) {
  return std::clamp((aim.along_m - behind_m) / kRamp_m, aim.start_line, 1.0);
}

// What a distance counts more than its square says: a body all along which is off by little is wanted, not one that is
// off by much in one place.
double more_when_far(const FollowAim& aim, const Vec3& off) {
  return aim.far_m > 0.0 ? 1.0 + dot(off, off) / (aim.far_m * aim.far_m) : 1.0;
}

// Nearest on the track to a link end so far behind the tip along the arm: between where it was at the start and where
// it is when it has moved with the tip.
CurvePlace body_place(const FollowTrack& track, double along_m, double behind_m, const Vec3& link_end_m) {
  return track.nearest(link_end_m, -behind_m - kWindow_m, std::min(along_m, along_m - behind_m + kWindow_m));
}

Quadratic model(const Room& room, const FollowTrack& track, const FollowAim& aim, const ThetaVector& theta) {
  const RobotParams& table = room.table();
  const Eigen::Index n = eigen::theta_count(table);
  const ArmDerivatives arm(table, theta);
  const ArmPoint tip_point = arm.node(table.segment_count);
  const PointDerivatives tip = arm.point(tip_point);
  const CurvePlace place = track.curve().at(aim.along_m);
  Quadratic q(n);
  q.add(eigen::view(tip.by_theta, n), subtract(tip.position_m, place.position_m), {}, kTipWeight);
  double behind_m = 0.0;
  Index m = Index(table.segment_count) - 1;
  std::int32_t modules = table.segment[m].modules;
  for (std::int32_t end = tip_point.link - 1; end >= 0; --end) {
    const double length_m = table.segment[m].module_length_m;
    behind_m += length_m;
    if (--modules == 0 && m > 0) modules = table.segment[--m].modules;
    const PointDerivatives here = arm.point({end, 1.0});
    if (end == tip_point.link - 1) {  // the tip's direction
      const eigen::SpaceColumns turning = (eigen::view(tip.by_theta, n) - eigen::view(here.by_theta, n)) / length_m;
      const Vec3 link = scale(subtract(tip.position_m, here.position_m), 1.0 / length_m);
      const double facing =
          std::max(0.0, dot(link, place.tangent));  // a tip that would have to turn round goes sideways or backwards
      q.add(turning, subtract(link, place.tangent), {},
            aim.body * aim.direction_m2 * facing * std::min(1.0, aim.along_m / kRamp_m));
    }
    if (aim.body == 0.0) break;
    const CurvePlace on = body_place(track, aim.along_m, behind_m, here.position_m);
    const Vec3 off = subtract(here.position_m, on.position_m);
    const double more = more_when_far(aim, off);  // grows with the square: three times its growth is the bend
    q.add(eigen::view(here.by_theta, n), off, on.tangent, aim.body * body_weight(aim, behind_m) * more,
          3.0 - 2.0 / more);
  }
  const PoseModel push = push_model(room, theta, aim.clearance_m, true);
  q.rhs += aim.draw * (eigen::view(aim.drawn_to_rad, n) - eigen::view(theta, n)) - kPushWeight * push.gradient;
  q.hessian += kPushWeight * push.hessian;
  q.hessian.diagonal().array() += aim.draw;
  return q;
}

}  // namespace

double misfit_m2(const Room& room, const FollowTrack& track, const FollowAim& aim, const ThetaVector& theta_rad) {
  const LinkPoints points = link_points(room.table(), theta_rad);
  double sum_m2 = 0.0, behind_m = 0.0;
  for (Index i = Index(points.count) - 1; i-- > 1;) {
    const Vec3& here = points.point_in_base[i];
    behind_m += norm(subtract(points.point_in_base[i + 1], here));
    const Vec3 off = subtract(here, body_place(track, aim.along_m, behind_m, here).position_m);
    sum_m2 += body_weight(aim, behind_m) * dot(off, off);
  }
  return sum_m2;
}

double tip_off_m(const Room& room, const Curve& curve, double along_m, const ThetaVector& theta_rad) {
  const LinkPoints points = link_points(room.table(), theta_rad);
  return norm(subtract(points.point_in_base[Index(points.count) - 1], curve.at(along_m).position_m));
}

ThetaVector follow_pose(const Room& room, const FollowTrack& track, const FollowAim& aim, ThetaVector theta,
                        std::int32_t iterations) {
  for (std::int32_t i = 0; i < iterations + kTipSteps; ++i) {
    const bool tip_only = i >= iterations;
    if (tip_only && tip_off_m(room, track.curve(), aim.along_m, theta) < kTipThere_m) break;
    const Quadratic q = model(room, track, aim, theta);
    ThetaVector step{};
    for (double damping = tip_only ? kTipDamping_m2 : kDamping_m2; damping < kMaxDamping_m2; damping *= 10.0) {
      step = bounded_step(room.table(), q, damping, theta, aim.held_mask);
      if (tip_only || largest(step) < kStepMost_rad) break;
    }
    for (Index k = 0; k < theta.size(); ++k) theta[k] += step[k];
    if (!tip_only && largest(step) < kStepSettled_rad) i = iterations - 1;
  }
  return theta;
}

}  // namespace liana::planner
