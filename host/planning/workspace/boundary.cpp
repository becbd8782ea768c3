#include "host/planning/workspace/boundary.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace liana::workspace {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRingWidth_rad = kPi / kPolarBins;

using Members = std::vector<const ReachSample*>;  // of one range of directions

std::vector<DirectionBin> empty_bins() {
  std::vector<DirectionBin> bins;
  for (std::int32_t ring = 0; ring < kPolarBins; ++ring) {
    const std::int32_t count = azimuth_bins(ring);
    const double width = 2.0 * kPi / count;
    for (std::int32_t k = 0; k < count; ++k)
      bins.push_back({(ring + 0.5) * kRingWidth_rad, (k + 0.5) * width, kRingWidth_rad, width});
  }
  return bins;
}

// The end of the region along the ray of one pose, sign +1 outwards, -1 inwards.
BoundaryPoint end_of_ray(const RaySearch& search, double sign, const AngleVector& start_rad) {
  BoundaryPoint end;
  end.angle_rad = start_rad;
  push_along_ray(search.arm, search.point, search.origin_in_base_m, sign, end.angle_rad);
  end.point_in_base_m = point_motion(search.arm, search.point, end.angle_rad).point_in_base_m;
  end.distance_m = norm(subtract(end.point_in_base_m, search.origin_in_base_m));
  return end;
}

// Names what holds an end back; nothing does at the origin.
void find_binding(const RaySearch& search, double sign, BoundaryPoint& end) {
  if (end.distance_m <= kPushResolution_m) return;
  const Vec3 outwards = scale(subtract(end.point_in_base_m, search.origin_in_base_m), sign / end.distance_m);
  end.binding = binding_limits(search.arm, search.point, outwards, end.angle_rad);
}

// The end furthest out (sign +1) or in (-1) over the pushes of the first members.
BoundaryPoint furthest_end(const RaySearch& search, double sign, const Members& members) {
  BoundaryPoint best;
  for (std::size_t i = 0; i < std::min(members.size(), kPushStarts); ++i) {
    const BoundaryPoint end = end_of_ray(search, sign, members[i]->angle_rad);
    if (i == 0 || sign * (end.distance_m - best.distance_m) > 0.0) best = end;
  }
  find_binding(search, sign, best);
  return best;
}

struct Ends {
  BoundaryPoint outer, inner;
};

// Outer and inner end from at least one member; `distance` orders them.
template <typename Distance>
Ends find_ends(const RaySearch& search, Members& members, const Distance& distance) {
  std::stable_sort(members.begin(), members.end(), [&](auto* a, auto* b) { return distance(*a) > distance(*b); });
  Ends ends;
  ends.outer = furthest_end(search, 1.0, members);
  std::reverse(members.begin(), members.end());
  ends.inner = furthest_end(search, -1.0, members);
  return ends;
}

// Where the neighbour's end goes further, its pose is taken over to the ray of `end` and pushed from there: starts of a
// bin may all lead to a fold that the neighbour's did not meet.
void learn_from(const RaySearch& search, double sign, const BoundaryPoint& neighbour, BoundaryPoint& end) {
  if (end.distance_m <= kPushResolution_m || sign * (neighbour.distance_m - end.distance_m) <= kPushResolution_m)
    return;
  const Vec3 along_m = scale(subtract(end.point_in_base_m, search.origin_in_base_m),
                             std::max(neighbour.distance_m, kPushResolution_m) / end.distance_m);
  AngleVector angle_rad = neighbour.angle_rad;
  if (!reach_position(search.arm, search.point, add(search.origin_in_base_m, along_m), angle_rad)) return;
  BoundaryPoint found = end_of_ray(search, sign, angle_rad);
  if (sign * (found.distance_m - end.distance_m) <= 0.0) return;
  find_binding(search, sign, found);
  end = found;
}

// Every bin learns from the bin before it, then from the one behind it: two ways over all bins, so that what one start
// has found goes all around.
void learn_from_neighbours(const RaySearch& search, std::vector<DirectionBin>& bins) {
  const auto learn = [&](const DirectionBin& from, DirectionBin& to) {
    if (from.samples == 0 || to.samples == 0) return;
    learn_from(search, 1.0, from.outer, to.outer);
    learn_from(search, -1.0, from.inner, to.inner);
  };
  for (std::size_t i = 1; i < bins.size(); ++i) learn(bins[i - 1], bins[i]);
  for (std::size_t i = bins.size() - 1; i > 0; --i) learn(bins[i], bins[i - 1]);
}

}  // namespace

std::int32_t azimuth_bins(std::int32_t ring) {
  return 4 * static_cast<std::int32_t>(std::ceil(6.0 * std::sin((ring + 0.5) * kRingWidth_rad)));
}

std::size_t direction_bin(const Vec3& direction) {
  const double polar = std::atan2(std::hypot(direction[1], direction[2]), direction[0]);
  double azimuth = std::atan2(direction[2], direction[1]);
  if (azimuth < 0.0) azimuth += 2.0 * kPi;
  const std::int32_t ring = std::min(static_cast<std::int32_t>(polar / kRingWidth_rad), kPolarBins - 1);
  std::int32_t index = 0;
  for (std::int32_t i = 0; i < ring; ++i) index += azimuth_bins(i);
  const std::int32_t count = azimuth_bins(ring);
  return static_cast<std::size_t>(index +
                                  std::min(static_cast<std::int32_t>(azimuth / (2.0 * kPi) * count), count - 1));
}

std::vector<DirectionBin> find_boundary(const RaySearch& search, const std::vector<ReachSample>& samples) {
  std::vector<DirectionBin> bins = empty_bins();
  std::vector<Members> members(bins.size());
  for (const ReachSample& sample : samples) {
    if (sample.distance_m <= kPushResolution_m) continue;
    members[direction_bin(subtract(sample.point_in_base_m, search.origin_in_base_m))].push_back(&sample);
  }
  for (std::size_t i = 0; i < bins.size(); ++i) {
    bins[i].samples = static_cast<std::int32_t>(members[i].size());
    if (members[i].empty()) continue;
    const Ends ends = find_ends(search, members[i], [](const ReachSample& sample) { return sample.distance_m; });
    bins[i].outer = ends.outer;
    bins[i].inner = ends.inner;
  }
  learn_from_neighbours(search, bins);
  return bins;
}

Outline find_outline(const RaySearch& search, std::int32_t flat_axis, const std::vector<ReachSample>& samples) {
  const std::size_t right = flat_axis == 0 ? 1 : 0, up = flat_axis == 2 ? 1 : 2;
  RaySearch flat = search;
  flat.point.flat_axis = flat_axis;
  flat.origin_in_base_m[static_cast<std::size_t>(flat_axis)] = 0.0;
  const auto seen = [&](const ReachSample& sample) {
    return subtract(sample.point_in_base_m, search.origin_in_base_m);
  };
  const auto distance = [&](const ReachSample& sample) { return std::hypot(seen(sample)[right], seen(sample)[up]); };
  std::array<Members, kOutlineSectors> members;
  for (const ReachSample& sample : samples) {
    if (distance(sample) <= kPushResolution_m) continue;
    const double turns = std::atan2(seen(sample)[up], seen(sample)[right]) / (2.0 * kPi);
    members[static_cast<std::size_t>((turns + 1.0) * kOutlineSectors) % kOutlineSectors].push_back(&sample);
  }
  Outline outline;
  for (std::size_t i = 0; i < kOutlineSectors; ++i) {
    if (members[i].empty()) continue;
    const auto [outer, inner] = find_ends(flat, members[i], distance);
    outline[i] = {true,
                  {outer.point_in_base_m[right], outer.point_in_base_m[up]},
                  {inner.point_in_base_m[right], inner.point_in_base_m[up]},
                  outer.binding};
  }
  return outline;
}

}  // namespace liana::workspace
