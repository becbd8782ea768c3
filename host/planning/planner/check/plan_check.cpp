#include "host/planning/planner/check/plan_check.hpp"

#include <algorithm>
#include <cmath>

#include "firmware_like/cable/arm/static_load.hpp"
#include "firmware_like/math/trig.hpp"
#include "host/model/config/drive_names.hpp"
#include "host/planning/planner/check/convex_check.hpp"
#include "host/planning/planner/check/path_search.hpp"
#include "host/planning/planner/check/vectors.hpp"
#include "host/planning/planner/text.hpp"

namespace liana::planner {
namespace {

using Index = std::size_t;
using Vector = std::array<double, 3>;
using Rotation = std::array<Vector, 3>;  // rows

constexpr Rotation kIdentity{Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}};

Vector times(const Rotation& R, const Vector& v) {
  Vector out{};
  for (Index i = 0; i < 3; ++i) out[i] = R[i][0] * v[0] + R[i][1] * v[1] + R[i][2] * v[2];
  return out;
}

Rotation times(const Rotation& A, const Rotation& B) {
  Rotation out{};
  for (Index i = 0; i < 3; ++i) {
    for (Index j = 0; j < 3; ++j) out[i][j] = A[i][0] * B[0][j] + A[i][1] * B[1][j] + A[i][2] * B[2][j];
  }
  return out;
}

// One universal joint: pitch about z and yaw about y, pitch first in odd modules (the DH rows: mission, A1).
Rotation joint_rotation(double pitch_rad, double yaw_rad, bool pitch_first) {
  const double cp = std::cos(pitch_rad), sp = std::sin(pitch_rad), cy = std::cos(yaw_rad), sy = std::sin(yaw_rad);
  const Rotation pitch{Vector{cp, -sp, 0}, Vector{sp, cp, 0}, Vector{0, 0, 1}};
  const Rotation yaw{Vector{cy, 0, sy}, Vector{0, 1, 0}, Vector{-sy, 0, cy}};
  return pitch_first ? times(pitch, yaw) : times(yaw, pitch);
}

// The chain joint by joint.
struct Chain {
  std::vector<Vector> link_end_m{{0, 0, 0}};  // the base first
  Rotation tip = kIdentity;
};

Chain chain_of(const RobotParams& table, const ThetaVector& theta_rad) {
  Chain chain;
  for (Index m = 0; m < static_cast<Index>(table.segment_count); ++m) {
    const SegmentParams& segment = table.segment[m];
    if (feeds(segment)) {
      const double c = std::cos(theta_rad[1]), s = std::sin(theta_rad[1]);
      chain.link_end_m[0][0] = segment.slide_m_rad * theta_rad[0];
      chain.tip = {Vector{1, 0, 0}, Vector{0, c, -s}, Vector{0, s, c}};
    }
    const std::array<Rotation, 2> joint{joint_rotation(theta_rad[2 * m], theta_rad[2 * m + 1], true),
                                        joint_rotation(theta_rad[2 * m], theta_rad[2 * m + 1], false)};
    for (std::int32_t k = 0; k < segment.modules; ++k) {
      chain.tip = times(chain.tip, joint[static_cast<Index>(k % 2)]);
      Vector end = chain.link_end_m.back();
      for (Index i = 0; i < 3; ++i) end[i] += segment.module_length_m * chain.tip[i][0];
      chain.link_end_m.push_back(end);
    }
  }
  return chain;
}

std::array<double, 4> quaternion_of(const Rotation& R) {
  const std::array<double, 4> square{1 + R[0][0] + R[1][1] + R[2][2], 1 + R[0][0] - R[1][1] - R[2][2],
                                     1 - R[0][0] + R[1][1] - R[2][2], 1 - R[0][0] - R[1][1] + R[2][2]};
  const Index k = static_cast<Index>(std::max_element(square.begin(), square.end()) - square.begin());
  const double f = 0.5 / std::sqrt(square[k]);
  const double wx = R[2][1] - R[1][2], wy = R[0][2] - R[2][0], wz = R[1][0] - R[0][1];
  const double xy = R[1][0] + R[0][1], xz = R[2][0] + R[0][2], yz = R[2][1] + R[1][2];
  const std::array<std::array<double, 4>, 4> rows{
      {{square[0], wx, wy, wz}, {wx, square[1], xy, xz}, {wy, xy, square[2], yz}, {wz, xz, yz, square[3]}}};
  return {f * rows[k][0], f * rows[k][1], f * rows[k][2], f * rows[k][3]};
}

// Paths of all cables, hole by hole: across every joint, and straight through the links between.
std::vector<double> cable_lengths_m(const RobotParams& table, const ThetaVector& theta_rad) {
  std::vector<double> lengths;
  for (Index m = 0; m < static_cast<Index>(table.segment_count); ++m) {
    for (Index c = 0; c < static_cast<Index>(table.segment[m].cables); ++c) {
      const double phase = table.segment[m].cable_phase_rad[c], r = table.segment[m].hole_radius_m;
      double length_m = 0.0;
      if (const SegmentParams& base = table.segment[m]; feeds(base))
        length_m = c == 0 ? base.slide_m_rad * theta_rad[0] : base.roll_radius_m * theta_rad[1];
      for (Index j = 0; j <= m; ++j) {
        const double g = table.segment[j].face_offset_m;
        const Vector before{-g, r * std::cos(phase), r * std::sin(phase)}, after{g, before[1], before[2]};
        for (std::int32_t k = 0; k < table.segment[j].modules; ++k) {
          const Rotation joint = joint_rotation(theta_rad[2 * j], theta_rad[2 * j + 1], k % 2 == 0);
          length_m += distance(times(joint, after), before);
          const bool last = k + 1 == table.segment[j].modules;
          if (last && j == m) continue;  // the anchor
          length_m += table.segment[j].module_length_m - (g + (last ? table.segment[j + 1].face_offset_m : g));
        }
      }
      lengths.push_back(length_m);
    }
  }
  return lengths;
}

double point_distance_m(const Vector& p, const config::SceneSphere& sphere) {
  return distance(p, sphere.center_m) - sphere.radius_m;
}

double point_distance_m(const Vector& p, const config::SceneBox& box) {
  double outside2 = 0.0, inside = -1e300;
  for (Index i = 0; i < 3; ++i) {
    double along = 0.0;
    for (Index j = 0; j < 3; ++j) along += box.rotation[i][j] * (p[j] - box.center_m[j]);
    const double face = std::fabs(along) - box.half_extent_m[i];
    if (face > 0.0) outside2 += face * face;
    inside = std::max(inside, face);
  }
  return inside > 0.0 ? std::sqrt(outside2) : inside;
}

// Least distance of a link's axis from an obstacle, or `enough` when it cannot be below that. The distance is convex
// along the link, so a golden-section search finds it.
template <typename Obstacle>
double axis_distance_m(const Vector& from, const Vector& to, const Obstacle& obstacle, double enough) {
  constexpr double kGolden = 0.6180339887498949;
  const auto at = [&](double t) {
    return point_distance_m(
        Vector{from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1]), from[2] + t * (to[2] - from[2])},
        obstacle);
  };
  if (at(0.5) - 0.5 * distance(from, to) >= enough) return enough;
  double low = 0.0, high = 1.0;
  double t1 = 1.0 - kGolden, t2 = kGolden, d1 = at(t1), d2 = at(t2);
  for (int i = 0; i < 30; ++i) {
    if (d1 < d2) {
      high = t2, t2 = t1, d2 = d1, t1 = high - kGolden * (high - low), d1 = at(t1);
    } else {
      low = t1, t1 = t2, d1 = d2, t2 = low + kGolden * (high - low), d2 = at(t2);
    }
  }
  return std::min({d1, d2, at(0.0), at(1.0)});
}

double axis_distance_m(const Vector& from, const Vector& to, const config::SceneConvex& body, double enough) {
  return convex_distance_m(from, to, body, enough);
}

struct Nearest {
  double clearance_m = kNothingNear_m;
  std::string obstacle;
  std::int32_t link = 0;
};

template <typename Obstacle>
void look_at(const Chain& chain, double radius_m, const std::vector<Obstacle>& obstacles, Nearest& nearest) {
  for (const Obstacle& obstacle : obstacles) {
    for (Index link = 1; link < chain.link_end_m.size(); ++link) {
      const double d =
          axis_distance_m(chain.link_end_m[link - 1], chain.link_end_m[link], obstacle, nearest.clearance_m + radius_m);
      if (d - radius_m < nearest.clearance_m) nearest = {d - radius_m, obstacle.name, static_cast<std::int32_t>(link)};
    }
  }
}

Nearest nearest_at(const config::RobotConfig& robot, const config::SceneConfig& scene, const ThetaVector& theta_rad) {
  Nearest nearest;
  const Chain chain = chain_of(robot.table, theta_rad);
  look_at(chain, robot.module_radius_m, scene.spheres, nearest);
  look_at(chain, robot.module_radius_m, scene.boxes, nearest);
  look_at(chain, robot.module_radius_m, scene.convex, nearest);
  return nearest;
}

void check_clearance(const config::RobotConfig& robot, const config::SceneConfig& scene,
                     const std::vector<ThetaVector>& path, PlanCheck& out) {
  out.min_clearance_m = kNothingNear_m;
  if (scene.spheres.empty() && scene.boxes.empty() && scene.convex.empty()) return;
  Nearest nearest;
  const auto look = [&](const ThetaVector& theta_rad) {
    const Nearest here = nearest_at(robot, scene, theta_rad);
    if (here.clearance_m < nearest.clearance_m) nearest = here;
    return here.clearance_m;
  };
  PathSearch search(robot.table, look, 1.0, kNothingNear_m);
  search.along(path);
  out.min_clearance_m = nearest.clearance_m;
  out.nearest = nearest.obstacle;
  out.nearest_link = nearest.link;
  out.poses = search.poses();
}

void check_angles(const RobotParams& table, const std::vector<ThetaVector>& path, PlanCheck& out) {
  for (Index w = 0; w < path.size(); ++w) {
    for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) {
      const double size = std::fabs(path[w][k]);
      out.max_joint_deg = std::max(out.max_joint_deg, size / kDegree);
      out.over_limit_deg = std::max(out.over_limit_deg, (size - table.segment[k / 2].theta_limit_rad) / kDegree);
      if (w > 0) out.max_step_deg = std::max(out.max_step_deg, std::fabs(path[w][k] - path[w - 1][k]) / kDegree);
    }
  }
}

void check_cables(const RobotParams& table, const std::vector<ThetaVector>& path, PlanCheck& out) {
  std::vector<double> before = cable_lengths_m(table, path.front());
  for (Index w = 1; w < path.size(); ++w) {
    const std::vector<double> now = cable_lengths_m(table, path[w]);
    double step_s = 0.0;
    for (Index c = 0; c < now.size(); ++c) {
      const double change_m = std::fabs(now[c] - before[c]);
      out.max_cable_step_m = std::max(out.max_cable_step_m, change_m);
      step_s = std::max(step_s, change_m / table.limits.cable_speed_m_s);
    }
    for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) {
      step_s = std::max(step_s, std::fabs(path[w][k] - path[w - 1][k]) / table.limits.theta_rate_rad_s);
    }
    out.duration_s += step_s;
    before = now;
  }
}

}  // namespace

// The tension plan is the core's own: what is asked is whether the arm's controller can hold these poses.
void check_tension(const RobotParams& table, const std::vector<ThetaVector>& path_rad, PlanCheck& out) {
  const CableLayout layout = cable_layout(table);
  out.min_tension_N = 1e300;
  for (const ThetaVector& theta_rad : path_rad) {
    const TensionPlan plan = plan_at_rest(table, layout, theta_rad);
    for (std::int32_t c = table.feed_count(); c < table.cable_count(); ++c) {
      const double tension_N = plan.motor_N[static_cast<Index>(c)];
      if (tension_N < out.min_tension_N) out.min_tension_N = tension_N, out.min_tension_cable = c;
      if (tension_N > out.max_tension_N) out.max_tension_N = tension_N, out.max_tension_cable = c;
    }
  }
}

std::string tension_refusal(const RobotParams& table, const PlanCheck& check, double ceiling_N) {
  const double floor_N = table.tension.floor_motor_N;
  const bool is_low = check.min_tension_N < floor_N;
  if (!is_low && check.max_tension_N <= ceiling_N) return {};
  const config::DriveNames names(table);
  return text("%s would be pulled with %.1f N; allowed are %.1f to %.1f N: ask for another pose%s",
              names.cable(static_cast<Index>(is_low ? check.min_tension_cable : check.max_tension_cable)).c_str(),
              is_low ? check.min_tension_N : check.max_tension_N, floor_N, ceiling_N,
              is_low ? ": it would be slack" : ", or let it carry less");
}

CheckedTip plain_tip(const RobotParams& table, const ThetaVector& theta_rad) {
  const Chain chain = chain_of(table, theta_rad);
  return {chain.link_end_m.back(), quaternion_of(chain.tip)};
}

std::vector<std::array<double, 3>> plain_axis(const RobotParams& table, const ThetaVector& theta_rad) {
  return chain_of(table, theta_rad).link_end_m;
}

PlanCheck check_plan(const config::RobotConfig& robot, const config::SceneConfig& scene,
                     const std::vector<ThetaVector>& waypoints_rad, const CheckedTip& goal) {
  PlanCheck out;
  check_clearance(robot, scene, waypoints_rad, out);
  out.self = self_clearance_along(robot, waypoints_rad);
  check_angles(robot.table, waypoints_rad, out);
  check_cables(robot.table, waypoints_rad, out);
  check_tension(robot.table, waypoints_rad, out);
  const CheckedTip tip = plain_tip(robot.table, waypoints_rad.back());
  out.tip_error_m = distance(tip.position_m, goal.position_m);
  double cosine = 0.0;
  for (Index i = 0; i < 4; ++i) cosine += tip.quaternion_wxyz[i] * goal.quaternion_wxyz[i];
  double gap2 = 0.0;  // |q -+ goal|^2, exact also for small angles
  for (Index i = 0; i < 4; ++i)
    gap2 += std::pow(tip.quaternion_wxyz[i] - (cosine < 0.0 ? -1.0 : 1.0) * goal.quaternion_wxyz[i], 2);
  out.tip_attitude_error_rad = 4.0 * std::asin(std::min(1.0, 0.5 * std::sqrt(gap2)));
  return out;
}

}  // namespace liana::planner
