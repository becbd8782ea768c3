// The region that the tip or a point of an arm can reach: sampled, then pushed out to its boundary in every direction
// seen from the base.
//
// Sampling, seeded and in fixed order: evenly spread angles, of an angle whose range holds a turn over one turn. Of an
// arm that is straight at 0, sample 0 has all free angles at 0, and then every other sample is a straighter one (all
// free angles times one common factor 0..1). Directions are seen from the origin: the last point that no free angle
// moves, which is the base unless the arm's root is held. They are binned by the polar angle from base x (15 deg) and
// the azimuth about it (15 deg at the equator, fewer near the poles, symmetric about y and z). In every bin the
// outermost and innermost samples are pushed along their rays (push.hpp) until the solver cannot follow; then bins
// learn from neighbours that got further. Every boundary point is reached by angles within ranges, so the true region
// is never smaller than what is reported; it can be larger where no start led further, and a bin hides what is finer
// than 15 deg. Holes between the inner and the outer boundary are not looked for. Only ranges of angles count: neither
// obstacles nor the arm's own body take anything away.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "host/planning/workspace/boundary.hpp"

namespace liana::workspace {

constexpr std::int32_t kRadialShells = 20;  // of the radial profile
constexpr std::int32_t kMinSamples = 1000;
constexpr std::int32_t kMaxSamples = 1000000;

struct RegionRequest {
  PointOnArm point{};
  AngleVector held_rad{};    // where held angles are
  std::int32_t samples = 0;  // kMinSamples..kMaxSamples
  std::uint64_t seed = 1;
};

// One place that was reached.
struct ReachedPoint {
  Vec3 point_in_base_m{};
  double mobility_m_per_rad =
      0.0;  // travel per radian of the free angles (root sum of squares) in the worst direction of the region
};

struct Region {
  std::vector<ReachedPoint> samples;  // in the order drawn; neither boundary nor extent points are among them
  std::int32_t dimension = 0;         // 0 nothing moves it, 1 line, 2 surface, 3 volume: largest rank of its Jacobian
  std::array<Vec3, 2> extent_m{};     // least and largest x, y, z; each found by climb() from the best samples
  Vec3 origin_in_base_m{};            // where directions and distances are seen from
  double nearest_m = 0.0;             // to the origin, over samples, extent and boundary
  double farthest_m = 0.0;
  std::array<double, kRadialShells> shell_share{};  // of samples, in equal shells from the origin to length_m
  double length_m = 0.0;             // of the links from the origin to the node, laid end to end: nothing is farther
  std::array<Outline, 3> outline{};  // seen along x, y, z
  std::vector<DirectionBin> bins;    // ring by ring from +x
  std::array<double, kMaxAngles> outer_binding_share{};  // of the bins' outer ends, where this limit binds
  double outer_stretched_share = 0.0;                    // where no limit does: stretched out, or folded
};

// Explores the region. Cost: about 4 us a sample and 1 s for the boundary on one core.
Region explore_region(const ReachArm& arm, const RegionRequest& request);

}  // namespace liana::workspace
