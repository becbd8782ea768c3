#include "host/planning/workspace/region.hpp"

#include <Eigen/SVD>
#include <algorithm>

#include "host/base/eigen/thetas.hpp"
#include "host/base/random/random.hpp"

namespace liana::workspace {
namespace {

constexpr double kRankLimit_m_per_rad = 1e-6;
constexpr std::size_t kClimbStarts = 8;  // samples that climb towards each side of the extent
constexpr std::uint64_t kSampleStream = 1;

using Samples = std::vector<ReachSample>;

ReachSample sample_at(const RaySearch& search, const AngleVector& angle_rad) {
  const PointMotion motion = point_motion(search.arm, search.point, angle_rad);
  using AngleJacobian = Eigen::Matrix<double, 3, kMaxAngles>;
  const Eigen::Vector3d travel =
      Eigen::JacobiSVD<AngleJacobian>(eigen::view(motion.column, kMaxAngles)).singularValues();
  const double distance_m = norm(subtract(motion.point_in_base_m, search.origin_in_base_m));
  return {angle_rad, motion.point_in_base_m, distance_m, {travel[0], travel[1], travel[2]}};
}

AngleVector draw(const ReachArm& arm, const RegionRequest& request, std::int32_t index,
                 simulated::RandomStream& random) {
  const double factor = !arm.is_straight_at_0 ? 1.0
                        : index == 0          ? 0.0
                        : index % 2 == 1      ? 1.0
                                              : random.uniform(0.0, 1.0);
  AngleVector angle_rad = request.held_rad;
  for (std::size_t i = 0; i < static_cast<std::size_t>(arm.angle_count); ++i) {
    if (is_free(arm, request.point, i))
      angle_rad[i] = middle_rad(arm.range[i]) + factor * drawn_half_rad(arm.range[i]) * random.uniform(-1.0, 1.0);
  }
  return angle_rad;
}

Samples draw_samples(const RaySearch& search, const RegionRequest& request) {
  simulated::RandomStream random(request.seed, kSampleStream);
  Samples samples;
  samples.reserve(static_cast<std::size_t>(request.samples));
  for (std::int32_t i = 0; i < request.samples; ++i)
    samples.push_back(sample_at(search, draw(search.arm, request, i, random)));
  return samples;
}

// The last point at the root that nothing moves because all angles before it are held.
std::int32_t still_node(const ReachArm& arm, const PointOnArm& point) {
  const auto is_held_until = [&](std::int32_t node) {
    for (std::int32_t i = 0; i < arm.angles_to[static_cast<std::size_t>(node)]; ++i) {
      if (is_free(arm, point, static_cast<std::size_t>(i))) return false;
    }
    return true;
  };
  std::int32_t node = 0;
  while (node + 1 < point.node && is_held_until(node + 1)) ++node;
  return node;
}

double length_between(const ReachArm& arm, std::int32_t from_node, std::int32_t to_node) {
  double length_m = 0.0;
  for (std::int32_t m = from_node + 1; m <= to_node; ++m) length_m += arm.link_m[static_cast<std::size_t>(m)];
  return length_m;
}

std::int32_t dimension_of(const Samples& samples) {
  std::int32_t dimension = 0;
  for (const ReachSample& sample : samples) {
    for (std::int32_t i = dimension; i < 3; ++i) {
      if (sample.travel_m_per_rad[static_cast<std::size_t>(i)] > kRankLimit_m_per_rad) dimension = i + 1;
    }
  }
  return dimension;
}

// Poses as far along `sign` times base axis `axis` as climbing from the best samples leads.
Samples climb_from_best(const RaySearch& search, const Samples& samples, std::size_t axis, double sign) {
  std::vector<const ReachSample*> order;
  for (const ReachSample& sample : samples) order.push_back(&sample);
  const std::size_t starts = std::min(order.size(), kClimbStarts);
  std::partial_sort(
      order.begin(), order.begin() + static_cast<std::ptrdiff_t>(starts), order.end(),
      [&](auto* a, auto* b) { return sign * (a->point_in_base_m[axis] - b->point_in_base_m[axis]) > 0.0; });
  Vec3 direction{};
  direction[axis] = sign;
  Samples found;
  for (std::size_t i = 0; i < starts; ++i) {
    AngleVector angle_rad = order[i]->angle_rad;
    climb(search.arm, search.point, direction, angle_rad);
    found.push_back(sample_at(search, angle_rad));
  }
  return found;
}

// Appends the poses at the six sides to `samples` and returns the extent over all of them.
std::array<Vec3, 2> find_extent(const RaySearch& search, Samples& samples) {
  Samples found;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const Samples side = climb_from_best(search, samples, axis, sign);
      found.insert(found.end(), side.begin(), side.end());
    }
  }
  samples.insert(samples.end(), found.begin(), found.end());
  std::array<Vec3, 2> extent_m{samples.front().point_in_base_m, samples.front().point_in_base_m};
  for (const ReachSample& sample : samples) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      extent_m[0][axis] = std::min(extent_m[0][axis], sample.point_in_base_m[axis]);
      extent_m[1][axis] = std::max(extent_m[1][axis], sample.point_in_base_m[axis]);
    }
  }
  return extent_m;
}

void describe_samples(const Samples& samples, Region& region) {
  region.dimension = dimension_of(samples);
  const auto worst = static_cast<std::size_t>(std::max(region.dimension, 1) - 1);
  for (const ReachSample& sample : samples) {
    region.samples.push_back({sample.point_in_base_m, sample.travel_m_per_rad[worst]});
    const double shell = std::min(sample.distance_m / region.length_m * kRadialShells, kRadialShells - 1.0);
    region.shell_share[static_cast<std::size_t>(shell)] += 1.0 / static_cast<double>(samples.size());
  }
}

void describe_distances(const Samples& samples, Region& region) {
  region.nearest_m = region.farthest_m = samples.front().distance_m;
  const auto count = [&](double distance_m) {
    region.nearest_m = std::min(region.nearest_m, distance_m);
    region.farthest_m = std::max(region.farthest_m, distance_m);
  };
  for (const ReachSample& sample : samples) count(sample.distance_m);
  for (const DirectionBin& bin : region.bins) {
    if (bin.samples == 0) continue;
    count(bin.outer.distance_m);
    count(bin.inner.distance_m);
  }
}

void count_binding(const ReachArm& arm, Region& region) {
  double ends = 0.0;
  for (const DirectionBin& bin : region.bins) {
    if (bin.samples == 0) continue;
    ends += 1.0;
    region.outer_stretched_share += bin.outer.binding == 0 ? 1.0 : 0.0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(arm.angle_count); ++i) {
      region.outer_binding_share[i] += bin.outer.binding >> i & 1u ? 1.0 : 0.0;
    }
  }
  if (ends == 0.0) return;
  region.outer_stretched_share /= ends;
  for (double& share : region.outer_binding_share) share /= ends;
}

}  // namespace

Region explore_region(const ReachArm& arm, const RegionRequest& request) {
  Region region;
  const std::int32_t still = still_node(arm, request.point);
  region.origin_in_base_m = arm.motion(still, request.held_rad).point_in_base_m;
  region.length_m = length_between(arm, still, request.point.node);
  const RaySearch search{arm, request.point, region.origin_in_base_m};
  Samples samples = draw_samples(search, request);
  describe_samples(samples, region);
  region.extent_m = find_extent(search, samples);
  region.bins = find_boundary(search, samples);
  for (std::int32_t axis = 0; axis < 3; ++axis)
    region.outline[static_cast<std::size_t>(axis)] = find_outline(search, axis, samples);
  describe_distances(samples, region);
  count_binding(arm, region);
  return region;
}

}  // namespace liana::workspace
