#include "host/model/inverse_kinematics/dof_split.hpp"

#include <cmath>

#include "firmware_like/math/scalar.hpp"

namespace liana::inverse_kinematics {
namespace {

using Index = std::size_t;

constexpr std::int32_t kYawSteps = 64;  // from 0 to the joint limit
constexpr std::int32_t kHalvings = 24;  // of a step: 20 deg / 64 / 2^24 = 3e-10 rad

Vec3 place(const Pose& frame, const Vec3& point) noexcept {
  return add(frame.position_m, rotate(frame.quaternion, point));
}

// Segments before S2.
std::int32_t segments_before(const RobotParams& table, std::int32_t planar) noexcept {
  return table.segment_count - planar;
}

std::int32_t joints_before(const RobotParams& table, std::int32_t segments) noexcept {
  std::int32_t joints = 0;
  for (std::int32_t m = 0; m < segments; ++m) joints += table.segment[static_cast<Index>(m)].modules;
  return joints;
}

double arc_length_m(const RobotParams& table, std::int32_t segments) noexcept {
  double length = 0.0;
  for (std::int32_t m = 0; m < segments; ++m) {
    length += table.segment[static_cast<Index>(m)].modules * table.segment[static_cast<Index>(m)].module_length_m;
  }
  return length;
}

bool in_opening(const SlitMouth& mouth, const Vec3& p) noexcept {
  return std::fabs(p[1]) <= mouth.half_gap_m && std::fabs(p[2]) <= mouth.half_width_m;
}

// A link from a to b in the mouth's frame. Its piece between the planes x = 0 and x = depth is straight, so the ends of
// the piece decide.
bool link_passes(const SlitMouth& mouth, const Vec3& a, const Vec3& b) noexcept {
  double from = 0.0, to = 1.0;
  const double run = b[0] - a[0];
  if (std::fabs(run) < 1e-12) {
    if (a[0] < 0.0 || a[0] > mouth.depth_m) return true;
  } else {
    const double at_mouth = -a[0] / run, at_end = (mouth.depth_m - a[0]) / run;
    from = larger(from, smaller(at_mouth, at_end));
    to = smaller(to, larger(at_mouth, at_end));
    if (from > to) return true;
  }
  const Vec3 link = subtract(b, a);
  return in_opening(mouth, add(a, scale(link, from))) && in_opening(mouth, add(a, scale(link, to)));
}

// Past the mouth or nearer than look_ahead_m before it, not beyond the slit's end, and not beside it.
bool is_near(const SlitMouth& mouth, const Vec3& p, double look_ahead_m) noexcept {
  const double beside_m = std::fabs(look_ahead_m);
  return p[0] >= -look_ahead_m && p[0] <= mouth.depth_m && std::fabs(p[1]) <= mouth.half_gap_m + beside_m &&
         std::fabs(p[2]) <= mouth.half_width_m + beside_m;
}

// Segments from the first with a link that ends near the slit to the last.
std::int32_t segments_near(const RobotParams& table, const LinkPoints& links, const SlitMouth& mouth,
                           double look_ahead_m) noexcept {
  const Pose base_in_mouth = inverse(mouth.frame_in_base);
  std::int32_t point = 1;
  for (std::int32_t m = 0; m < table.segment_count; ++m) {
    for (std::int32_t i = 0; i < table.segment[static_cast<Index>(m)].modules; ++i, ++point) {
      const Vec3 end = place(base_in_mouth, links.point_in_base[static_cast<Index>(point)]);
      if (is_near(mouth, end, look_ahead_m)) return table.segment_count - m;
    }
  }
  return 0;
}

// The yaw of one segment, tried at other values.
struct YawTrial {
  const RobotParams& table;
  const SlitMouth& mouth;
  PlanarPart part;
  Index yaw;

  bool fits_at(double yaw_rad) noexcept {
    part.theta_rad[yaw] = yaw_rad;
    return fits(table, part, mouth);
  }
  // Where fitting ends, from a yaw that fits in steps towards and up to `limit`.
  double edge(double fitting, double step, double limit) noexcept {
    double beyond = fitting;
    for (std::int32_t i = 0; i < 2 * kYawSteps + 1 && fitting != limit; ++i) {
      beyond = clamp(fitting + step, -std::fabs(limit), std::fabs(limit));
      if (!fits_at(beyond)) break;
      fitting = beyond;
    }
    for (std::int32_t i = 0; i < kHalvings && fitting != beyond; ++i) {
      const double middle = 0.5 * (fitting + beyond);
      (fits_at(middle) ? fitting : beyond) = middle;
    }
    return fitting;
  }
};

}  // namespace

std::uint32_t planar_pitches(const RobotParams& table, std::int32_t segments) noexcept {
  std::uint32_t mask = 0;
  for (std::int32_t m = segments_before(table, segments); m < table.segment_count; ++m) mask |= 1u << (2 * m);
  return mask;
}

Pose root_of(const RobotParams& table, const PlanarPart& part) noexcept {
  const ArmKinematics arm = forward_kinematics(table, part.theta_rad);
  const Pose& root = arm.node_in_base[static_cast<Index>(segments_before(table, part.segments))];
  return compose(part.tip_in_base, compose(inverse(arm.tip_in_base), root));
}

bool fits(const RobotParams& table, const PlanarPart& part, const SlitMouth& mouth) noexcept {
  const LinkPoints links = link_points(table, part.theta_rad);
  const std::int32_t first = joints_before(table, segments_before(table, part.segments));
  const Pose tip = forward_kinematics(table, part.theta_rad).tip_in_base;
  const Pose to_base = compose(part.tip_in_base, inverse(tip));  // from where the angles alone would put the arm
  const Pose to_mouth = compose(inverse(mouth.frame_in_base), to_base);
  const Vec3 root_in_base = place(to_base, links.point_in_base[static_cast<Index>(first)]);
  if (norm(root_in_base) > arc_length_m(table, segments_before(table, part.segments))) return false;
  for (std::int32_t i = first + 1; i < links.count; ++i) {
    const Vec3 from = place(to_mouth, links.point_in_base[static_cast<Index>(i - 1)]);
    if (!link_passes(mouth, from, place(to_mouth, links.point_in_base[static_cast<Index>(i)]))) return false;
  }
  return true;
}

YawInterval feasible_yaw(const RobotParams& table, const PlanarPart& part, const SlitMouth& mouth,
                         std::int32_t segment) noexcept {
  if (segment <= segments_before(table, part.segments) || segment > table.segment_count) return {};
  YawTrial trial{table, mouth, part, static_cast<Index>(2 * segment - 1)};
  const double limit = table.segment[static_cast<Index>(segment - 1)].theta_limit_rad;
  const double step = limit / kYawSteps;
  const double given = clamp(part.theta_rad[trial.yaw], -limit, limit);
  for (std::int32_t i = 0; i <= 2 * kYawSteps; ++i) {  // nearest first, the larger of two
    for (const double offset : {step * i, -step * i}) {
      const double start = clamp(given + offset, -limit, limit);
      if (trial.fits_at(start)) return {trial.edge(start, -step, -limit), trial.edge(start, step, limit), false};
    }
  }
  return {};
}

bool some_yaw_fits(const RobotParams& table, const PlanarPart& part, const SlitMouth& mouth) noexcept {
  constexpr std::int32_t kSteps = 8;
  YawTrial trial{table, mouth, part, static_cast<Index>(2 * table.segment_count - 1)};
  const double limit = table.segment[static_cast<Index>(table.segment_count - 1)].theta_limit_rad;
  const double given = part.theta_rad[trial.yaw];
  if (trial.fits_at(given)) return true;
  for (std::int32_t i = 1; i <= 2 * kSteps; ++i) {  // nearest first, to both sides in turn
    const double away = limit / kSteps * ((i + 1) / 2);
    const double yaw = i % 2 == 1 ? given + away : given - away;
    if (std::fabs(yaw) <= limit && trial.fits_at(yaw)) return true;
  }
  return false;
}

std::int32_t planar_segments(const RobotParams& table, const LinkPoints& links, const SlitMouth& mouth,
                             const PlanarSwitch& when, std::int32_t before) noexcept {
  const std::int32_t at_least = segments_near(table, links, mouth, when.look_ahead_m);
  const std::int32_t at_most = segments_near(table, links, mouth, when.look_ahead_m + when.hysteresis_m);
  return before < at_least ? at_least : (before > at_most ? at_most : before);
}

}  // namespace liana::inverse_kinematics
