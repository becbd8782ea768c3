#include "host/planning/planner/start/relax.hpp"

#include <algorithm>
#include <cmath>

#include "firmware_like/cable/motion/servo_ik.hpp"
#include "host/planning/planner/problem/block_system.hpp"
#include "host/planning/planner/problem/plan_problem.hpp"
#include "host/planning/planner/problem/pose_model.hpp"

namespace liana::planner {
namespace {

using Index = std::size_t;

constexpr double kPenalty = 2e4;           // 1/m^2
constexpr double kSampleSpacing_m = 0.05;  // of motion between waypoints
constexpr std::int32_t kMaxSamples = 12;   // per interval

class Relaxation {
 public:
  Relaxation(const Room& room, const PlanRequest& request, const Path& path)
      : room_(room), request_(request), n_(eigen::theta_count(room.table())) {
    wanted_m_ = request.margin_m + kRelaxReach_m;
    const std::int32_t count = static_cast<std::int32_t>(path.size());
    free_.assign(path.size(), 0);
    for (std::int32_t w = 1; w + 1 < count; ++w) {
      free_[Index(w)] = (1u << n_) - 1u;
      for (const HeldPhase& phase : request.held) {
        if (is_held(phase, w, count)) free_[Index(w)] &= ~(1u << phase.theta);
      }
    }
  }

  // The samples of an interval: how many depends on how far the arm moves there.
  std::int32_t samples(const Path& path, Index w) const {
    return std::clamp(static_cast<std::int32_t>(std::ceil(room_.motion_m(path[w], path[w + 1]) / kSampleSpacing_m)), 1,
                      kMaxSamples);
  }

  double cost(const Path& path) const {
    double smooth = 0.0, push = 0.0, nodes = 0.0;
    for (Index w = 0; w + 1 < path.size(); ++w) {
      smooth += (eigen::view(path[w + 1], n_) - eigen::view(path[w], n_)).squaredNorm();
      const std::int32_t count = samples(path, w);
      for (std::int32_t s = 1; s <= count; ++s) {
        push += push_model(room_, between(path[w], path[w + 1], double(s) / count), wanted_m_, false).cost / count;
      }
      if (!request_.control_points.empty()) nodes += node_model(path[w + 1]).cost / double(path.size() - 1);
    }
    return 0.5 * double(path.size() - 1) * smooth + 0.5 * kPenalty * push + nodes;
  }

  // Newton step of the model with `damping` on its diagonal.
  bool step(const Path& path, double damping, Path& moved) const {
    BlockSystem system(path.size(), n_);
    const double stiffness = double(path.size() - 1);
    for (Index w = 0; w + 1 < path.size(); ++w) {
      add_smooth(system, w, stiffness * (eigen::view(path[w + 1], n_) - eigen::view(path[w], n_)), stiffness);
      const std::int32_t count = samples(path, w);
      for (std::int32_t s = 1; s <= count; ++s) {
        const double share = double(s) / count;
        const PoseModel model = push_model(room_, between(path[w], path[w + 1], share), wanted_m_, true);
        if (model.cost > 0.0) add_push(system, w, share, model, 0.5 * kPenalty / count);
      }
      if (!request_.control_points.empty()) add_push(system, w, 1.0, node_model(path[w + 1]), 1.0 / stiffness);
    }
    for (Index w = 0; w < path.size(); ++w) fix(system, w, damping);
    if (!solve(system)) return false;
    moved = path;
    for (Index w = 0; w < path.size(); ++w) {
      for (Eigen::Index k = 0; k < n_; ++k) {
        const double limit = room_.table().segment[Index(k) / 2].theta_limit_rad;
        if (is_free(w, k)) moved[w][Index(k)] = std::clamp(path[w][Index(k)] + system.rhs[w][k], -limit, limit);
      }
    }
    return true;
  }

 private:
  bool is_free(Index w, Eigen::Index k) const { return ((free_[w] >> k) & 1u) != 0; }

  // Weighted distances of nodes from their targets at one pose; each as the parabola that touches it here and has its
  // value at the target.
  PoseModel node_model(const ThetaVector& theta) const {
    PoseModel model(n_);
    const ArmDerivatives arm(room_.table(), theta);
    for (const ControlPoint& target : request_.control_points) {
      const PointDerivatives node = arm.point(arm.node(target.node));
      const auto J = eigen::view(node.by_theta, n_);
      const Eigen::Vector3d away = eigen::view(node.position_m) - eigen::view(target.position_m);
      const double distance_m = std::sqrt(away.squaredNorm() + kRound_m * kRound_m),
                   weight = target.weight / distance_m;
      model.cost += target.weight * distance_m;
      model.gradient.noalias() += weight * J.transpose() * away;
      model.hessian.noalias() += weight * J.transpose() * J;
    }
    return model;
  }

  static void add_smooth(BlockSystem& system, Index w, const eigen::ThetaColumn& slope, double stiffness) {
    system.rhs[w] += slope;
    system.rhs[w + 1] -= slope;
    system.own[w].diagonal().array() += stiffness;
    system.own[w + 1].diagonal().array() += stiffness;
    system.next[w].diagonal().array() -= stiffness;
  }

  static void add_push(BlockSystem& system, Index w, double share, const PoseModel& model, double factor) {
    const double before = 1.0 - share;
    system.rhs[w] -= factor * before * model.gradient;
    system.rhs[w + 1] -= factor * share * model.gradient;
    system.own[w] += factor * before * before * model.hessian;
    system.own[w + 1] += factor * share * share * model.hessian;
    system.next[w] += factor * share * before * model.hessian;
  }

  // What is not free does not move.
  void fix(BlockSystem& system, Index w, double damping) const {
    system.own[w].diagonal().array() += damping;
    for (Eigen::Index k = 0; k < n_; ++k) {
      if (is_free(w, k)) continue;
      eigen::fix_theta(k, 0.0, system.own[w], system.rhs[w]);
      system.next[w].col(k).setZero();
      if (w > 0) system.next[w - 1].row(k).setZero();
    }
  }

  const Room& room_;
  const PlanRequest& request_;
  Eigen::Index n_;
  double wanted_m_;
  std::vector<std::uint32_t> free_;
};

}  // namespace

Path relax(const Room& room, const PlanRequest& request, Path path) {
  if (path.size() < 3) return path;
  const Relaxation relaxation(room, request, path);
  double cost = relaxation.cost(path), damping = 1.0;
  for (std::int32_t i = 0; i < kRelaxIterations && damping < 1e8; ++i) {
    Path moved;
    const double moved_cost = relaxation.step(path, damping, moved) ? relaxation.cost(moved) : 1e300;
    if (!(moved_cost < cost)) {
      damping *= 8.0;
      continue;
    }
    const bool settled = cost - moved_cost < 1e-3 * cost;
    path = std::move(moved);
    cost = moved_cost;
    damping = std::max(1e-3, 0.25 * damping);
    if (settled) break;
  }
  return path;
}

PathLook look_along(const Room& room, const Path& path, double spacing_m) {
  PathLook worst;
  for (Index w = 0; w + 1 < path.size(); ++w) {
    const std::int32_t count =
        static_cast<std::int32_t>(std::ceil(room.motion_m(path[w], path[w + 1]) / spacing_m)) + 1;
    for (std::int32_t s = 0; s <= count; ++s) {
      const double share = static_cast<double>(s) / count;
      const clearance::ArmClearance here = room.look(between(path[w], path[w + 1], share));
      if (here.nearest.distance_m < worst.distance_m) {
        worst = {here.nearest.distance_m, static_cast<std::int32_t>(w), share, here.link, here.obstacle};
      }
    }
  }
  return worst;
}

Path resample(const Room& room, const Path& path, std::int32_t count) {
  struct Piece {
    double from, to;  // places along the path: corner index and share
  };
  const auto at = [&](double place) {
    const Index i = std::min(static_cast<Index>(place), path.size() - 2);
    return between(path[i], path[i + 1], place - static_cast<double>(i));
  };
  // Where the path is farthest from the straight piece, and by how much; its middle when it has no corner there.
  const auto worst_of = [&](const Piece& piece, double& turn_m) {
    const ThetaVector a = at(piece.from), b = at(piece.to);
    double worst = 0.5 * (piece.from + piece.to);
    turn_m = 0.01 * room.motion_m(a, b);
    for (double corner = std::floor(piece.from) + 1.0; corner < piece.to; corner += 1.0) {
      const ThetaVector c = at(corner);
      const double whole = room.motion_m(a, c) + room.motion_m(c, b);
      const double aside = whole > 0.0 ? room.motion_m(c, between(a, b, room.motion_m(a, c) / whole)) : 0.0;
      if (aside + 0.01 * whole > turn_m) turn_m = aside + 0.01 * whole, worst = corner;
    }
    return worst;
  };
  if (path.size() < 2) return path;
  std::vector<double> places{0.0, static_cast<double>(path.size() - 1)};
  while (static_cast<std::int32_t>(places.size()) < count) {
    double most = -1.0, where = 0.0;
    for (Index i = 0; i + 1 < places.size(); ++i) {
      double turn_m = 0.0;
      const double worst = worst_of({places[i], places[i + 1]}, turn_m);
      if (turn_m > most) most = turn_m, where = worst;
    }
    places.insert(std::upper_bound(places.begin(), places.end(), where), where);
  }
  Path out;
  for (const double place : places) out.push_back(at(place));
  return out;
}

namespace {

// Gauss-Newton equations of the tip's error at one pose; what the aim holds does not move.
struct TipEquations {
  eigen::ThetaMatrix A;
  eigen::ThetaColumn b;
};

TipEquations tip_equations(const Room& room, const PoseAim& aim, const ThetaVector& theta) {
  constexpr double kTipWeight = 1e4, kTurnWeight = 1e4, kNearWeight = 0.1, kDamping = 1.0;
  const Eigen::Index n = eigen::theta_count(room.table());
  const ArmKinematics arm = forward_kinematics(room.table(), theta);
  const auto error = pose_error(aim.tip_in_base, arm.tip_in_base);
  const Vec3 way{error[0], error[1], error[2]};
  Vec3 turn{error[3], error[4], error[5]};
  const auto linear = eigen::view(arm.tip_jacobian.linear, n);
  eigen::SpaceColumns turning = eigen::view(arm.tip_jacobian.angular, n);
  if (aim.direction_only) {
    const Vec3 x_axis = rotate(arm.tip_in_base.quaternion, {1, 0, 0});
    turn = cross(x_axis, rotate(aim.tip_in_base.quaternion, {1, 0, 0}));
    turning -= eigen::view(x_axis) * (eigen::view(x_axis).transpose() * turning).eval();
  }
  const PoseModel push = push_model(room, theta, aim.clearance_m, true);
  TipEquations out;
  out.A =
      kTipWeight * linear.transpose() * linear + kTurnWeight * turning.transpose() * turning + kPenalty * push.hessian;
  out.A.diagonal().array() += kNearWeight + kDamping;
  out.b = kTipWeight * linear.transpose() * eigen::view(way) + kTurnWeight * turning.transpose() * eigen::view(turn) -
          kPenalty * push.gradient + kNearWeight * (eigen::view(aim.near_rad, n) - eigen::view(theta, n));
  for (Eigen::Index k = 0; k < n; ++k) {
    if (((aim.held_mask >> k) & 1u) != 0) eigen::fix_theta(k, 0.0, out.A, out.b);
  }
  return out;
}

}  // namespace

SettledPose settle(const Room& room, const PoseAim& aim, ThetaVector theta, std::int32_t iterations) {
  for (std::int32_t i = 0; i < iterations; ++i) {
    const TipEquations equations = tip_equations(room, aim, theta);
    const Eigen::LLT<eigen::ThetaMatrix> factor(equations.A);
    if (factor.info() != Eigen::Success) break;
    const eigen::ThetaColumn step = factor.solve(equations.b);
    for (Eigen::Index k = 0; k < step.size(); ++k) {
      const double limit = room.table().segment[Index(k) / 2].theta_limit_rad;
      theta[Index(k)] = std::clamp(theta[Index(k)] + std::clamp(step[k], -0.1, 0.1), -limit, limit);
    }
  }
  const auto error = pose_error(aim.tip_in_base, forward_kinematics(room.table(), theta).tip_in_base);
  return {theta, norm({error[0], error[1], error[2]}), room.look(theta).nearest.distance_m};
}

}  // namespace liana::planner
