// Bodies beside the way, as near as may just be claimed to be free, and a little nearer: what fits is the arm's radius.
#include <algorithm>
#include <cmath>

#include "host/model/config/convex_shape.hpp"
#include "tests/host/control/verification/corpus_parts.hpp"

namespace liana::verification::corpus {
namespace {

constexpr int kPoses = 250;
constexpr int kHalvings = 24;  // of where on a link; 0.618 of it is left by each

using Axes = std::array<Vec3, 3>;

// A box, round by a radius, or a cylinder with flat ends: where a point stands beside it.
struct Body {
  Vec3 center_m{}, half_m{};
  Axes axes{};
  double round_m = 0.0;
  bool is_cylinder = false;  // along the first axis, of radius half_m[1]

  double from_point_m(const Vec3& point) const {
    const Vec3 way = subtract(point, center_m);
    Vec3 local{dot(way, axes[0]), dot(way, axes[1]), dot(way, axes[2])};
    if (is_cylinder) local = {local[0], std::hypot(local[1], local[2]), 0.0};
    Vec3 beyond{};
    for (std::size_t i = 0; i < 3; ++i)
      beyond[i] = is_cylinder && i == 2 ? 0.0 : std::max(0.0, std::fabs(local[i]) - half_m[i]);
    return norm(beyond) - round_m;
  }

  // The distance of a convex body is a convex function of where one is on a straight line.
  double from_link_m(const Vec3& from, const Vec3& to) const {
    const auto at = [&](double share) { return from_point_m(add(from, scale(subtract(to, from), share))); };
    constexpr double kGolden = 0.6180339887498949;
    double low = 0.0, high = 1.0;
    for (int i = 0; i < kHalvings; ++i) {
      const double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
      (at(a) < at(b) ? high : low) = at(a) < at(b) ? b : a;
    }
    return std::min({at(low), at(0.0), at(1.0)});
  }

  double from_arm_m(const RobotParams& table, const ThetaVector& theta_rad) const {
    const LinkPoints arm = link_points(table, theta_rad);
    double least = 1e9;
    for (std::size_t k = 0; k + 1 < static_cast<std::size_t>(arm.count); ++k) {
      const double link_m = norm(subtract(arm.point_in_base[k + 1], arm.point_in_base[k]));
      if (from_point_m(arm.point_in_base[k]) > least + link_m) continue;
      least = std::min(least, from_link_m(arm.point_in_base[k], arm.point_in_base[k + 1]));
    }
    return least;
  }
};

Axes turned_axes(Random& random) {
  const Vec3 a = random.vector(1.0), b = random.vector(1.0);
  const Vec3 u = scale(a, 1.0 / norm(a));
  const Vec3 across = cross(u, b);
  const Vec3 v = scale(across, 1.0 / norm(across));
  return {u, v, cross(u, v)};
}

constexpr Axes kBaseAxes{Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}};

// Along the base's axes, turned, a foil, a needle.
Body box_of(Random& random, std::size_t kind) {
  Body body;
  body.axes = kind == 0 ? kBaseAxes : turned_axes(random);
  for (double& half_m : body.half_m) half_m = random.uniform(0.01, 0.2);
  if (kind >= 2) body.half_m[1] = 1e-5;
  if (kind == 3) body.half_m[2] = 1e-5;
  return body;
}

// A hull of eight corners, a capsule, a cylinder.
Body convex_of(Random& random, std::size_t kind) {
  Body body = box_of(random, 1);
  if (kind == 1) body.round_m = body.half_m[1], body.half_m[1] = body.half_m[2] = 0.0;
  body.is_cylinder = kind == 2;
  return body;
}

void put_box(config::SceneConfig& scene, const Body& body) {
  scene.boxes.push_back({"body", body.center_m, body.half_m, body.axes});
}

void put_convex(config::SceneConfig& scene, const Body& body) {
  const Vec3 along = scale(body.axes[0], body.half_m[0]);
  const Vec3 from = subtract(body.center_m, along), to = add(body.center_m, along);
  if (body.is_cylinder) return scene.convex.push_back(config::cylinder("body", from, to, body.half_m[1]));
  if (body.round_m > 0.0) return scene.convex.push_back(config::capsule("body", from, to, body.round_m));
  std::vector<Vec3> corners;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 at = body.center_m;
    for (std::size_t i = 0; i < 3; ++i)
      at = add(at, scale(body.axes[i], (corner >> i & 1) != 0 ? body.half_m[i] : -body.half_m[i]));
    corners.push_back(at);
  }
  scene.convex.push_back(config::hull_of("body", corners));
}

// `count` bodies that a way comes near to, each with both sides.
template <class Make, class Put>
std::vector<Command> beside(const char* name, Random random, std::size_t kinds, const Make& make, const Put& put) {
  std::vector<Command> out;
  for (std::size_t i = 0; out.size() < 60 && i < 2000; ++i) {
    Command command{"", patient(), 0.03, {}, random.theta(zhu2022::table(), 6.0), {}, 100.0, Refusal::kNone};
    const ThetaVector change_rad = random.theta(zhu2022::table(), 0.6);
    command.to_rad = along(command.from_rad, command.from_rad, 0.0);
    for (std::size_t k = 0; k < kThetas; ++k) command.to_rad[k] += change_rad[k];
    command.table.limits.theta_accel_rad_s2 = 0.002 * kDegree;  // nothing swings beyond what angles say
    const auto link = static_cast<std::size_t>(random.uniform(8.0, 40.0));
    Body body = make(random, i % kinds);
    body.center_m = add(link_points(command.table, command.to_rad).point_in_base[link], random.vector(0.3));
    const auto gap_m = [&](const ThetaVector& theta_rad) { return body.from_arm_m(command.table, theta_rad); };
    if (gap_m(command.from_rad) < gap_m(command.to_rad)) std::swap(command.from_rad, command.to_rad);
    if (gap_m(command.to_rad) > 0.08 || gap_m(command.to_rad) < 0.01) continue;
    double least_m = 1e9;
    for (int pose = 0; pose <= kPoses; ++pose)
      least_m = std::min(least_m, gap_m(along(command.from_rad, command.to_rad, pose / double{kPoses})));
    const double radius_m = least_m - command.scene.margins.prediction_m;
    // Room for an arm, and the beginning free: who leaves a body may go.
    if (radius_m < 0.01 || radius_m > 0.05 || gap_m(command.from_rad) < least_m + 0.003) continue;
    both_sides(out, [&](bool outside) {
      Command one = command;
      one.name = named(name, i, outside);
      one.link_radius_m = radius_m + (outside ? 0.001 : -0.001);
      put(one.scene, body);
      one.expected = outside ? Refusal::kSceneContact : Refusal::kNone;
      return one;
    });
  }
  return out;
}

}  // namespace

std::vector<Command> boxes(std::uint64_t seed) { return beside("box", Random(100 * seed + 20), 4, box_of, put_box); }

std::vector<Command> convex_bodies(std::uint64_t seed) {
  return beside("convex body", Random(100 * seed + 21), 3, convex_of, put_convex);
}

}  // namespace liana::verification::corpus
