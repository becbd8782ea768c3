// The boundary of a region that was sampled: by direction in space, and as an outline in the three views. See
// region.hpp for how sound it is.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "host/planning/workspace/push.hpp"

namespace liana::workspace {

constexpr std::int32_t kPolarBins = 12;      // rings of 15 deg
constexpr std::size_t kOutlineSectors = 72;  // of 5 deg
constexpr std::size_t kPushStarts = 6;       // samples of each bin or sector that are pushed outwards, and inwards

// One pose that was drawn.
struct ReachSample {
  AngleVector angle_rad{};
  Vec3 point_in_base_m{};
  double distance_m = 0.0;                   // from the origin
  std::array<double, 3> travel_m_per_rad{};  // singular values of the point's Jacobian, falling
};

// What is searched: the point, and where rays start.
struct RaySearch {
  const ReachArm& arm;
  PointOnArm point{};
  Vec3 origin_in_base_m{};
};

// An end of the region along a ray from the origin.
struct BoundaryPoint {
  double distance_m = 0.0;  // from the origin
  Vec3 point_in_base_m{};
  AngleVector angle_rad{};    // reaches it
  std::uint32_t binding = 0;  // binding_limits(): bit i = angle i; 0 = stretched or folded
};

// One range of directions from the origin.
struct DirectionBin {
  double polar_rad = 0.0;    // middle, from base x
  double azimuth_rad = 0.0;  // middle, about base x, from y towards z; 0..2 pi
  double polar_width_rad = 0.0;
  double azimuth_width_rad = 0.0;
  std::int32_t samples = 0;  // 0: no sample points this way, and the boundary is empty
  BoundaryPoint outer{};
  BoundaryPoint inner{};  // distance_m under kPushResolution_m: reaches down to the origin
};

// The region as seen along one base axis: its ends in every sector of 5 deg about the origin, from the first other axis
// towards the second. Ends are found like the boundary's, with the depth of the view left free; a sector that no sample
// is seen in has none.
struct OutlineSector {
  bool seen = false;
  std::array<double, 2> outer_m{};  // along the two axes of the view, in the order x, y, z
  std::array<double, 2> inner_m{};
  std::uint32_t outer_binding = 0;  // binding_limits() of the outer end: bit i = angle i
};
using Outline = std::array<OutlineSector, kOutlineSectors>;

// Number of azimuth bins of a ring, a multiple of 4.
std::int32_t azimuth_bins(std::int32_t ring);

// Index of the bin that a direction (any length over 0) belongs to.
std::size_t direction_bin(const Vec3& direction);

// All bins, ring by ring from +x, with the ends found from the samples that lie in them.
std::vector<DirectionBin> find_boundary(const RaySearch& search, const std::vector<ReachSample>& samples);

// The outline seen along base axis `flat_axis`.
Outline find_outline(const RaySearch& search, std::int32_t flat_axis, const std::vector<ReachSample>& samples);

}  // namespace liana::workspace
