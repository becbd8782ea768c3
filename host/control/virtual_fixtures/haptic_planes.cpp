#include "host/control/virtual_fixtures/haptic_planes.hpp"

#include <algorithm>
#include <cmath>

#include "firmware_like/math/trig.hpp"

namespace liana::virtual_fixtures {
namespace {

// Numbers of planes: of a workspace's faces, and of each grip's fixtures.
constexpr std::uint32_t kSides = 2;  // planes of a fixture
constexpr std::uint32_t kPerGrip = kSides * config::kMaxFixtures;
constexpr std::uint32_t kGrips = 0x1000;
constexpr std::uint32_t kWorkspace = kPerGrip * kGrips;

// How far off a plane the force begins, of the tip, and how stiff it is there, of the hand.
struct Onset {
  double from_m = 0.0;
  double stiffness_N_m = 0.0;
};
Onset onset(double room_m, const HandMap& map, const FeelTable& feel) {
  const double full_m = std::max(0.0, feel.full_share * room_m / map.scale);  // of the hand
  const double needs_m = feel.full_N / feel.stiffness_N_m;
  if (full_m >= needs_m) return {(full_m - needs_m) * map.scale, feel.stiffness_N_m};
  const double least_m = feel.full_N / feel.max_stiffness_N_m;
  return {0.0, feel.full_N / std::max(full_m, least_m)};
}

// To either side of the frame's plane y = 0, free within `room_m` of it.
std::vector<HapticPlane> both_sides(std::uint32_t number, const Pose& frame, double room_m, const HandMap& map,
                                    const FeelTable& feel) {
  const Vec3 normal = rotate(frame.quaternion, kY);
  const double at_m = dot(normal, frame.position_m);
  return {{number, for_hand(map, normal, at_m - room_m, feel)},
          {number + 1, for_hand(map, scale(normal, -1.0), -at_m - room_m, feel)}};
}

std::vector<HapticPlane> funnel(std::uint32_t number, const config::SceneFixture& axis, const Pose& frame,
                                const HandMap& map, const FeelTable& feel) {
  const double opening = axis.opening_deg * kDegree;
  const Vec3 end = add(frame.position_m, rotate(frame.quaternion, scale(kX, axis.depth_m)));
  std::vector<HapticPlane> out;
  for (const double side : {1.0, -1.0}) {
    const Vec3 across = rotate(frame.quaternion, scale(kZ, side));
    const Vec3 normal = rotate(frame.quaternion, {-std::sin(opening), 0.0, -side * std::cos(opening)});
    out.push_back({number++, for_hand(map, normal, dot(normal, add(end, scale(across, axis.radius_m))), feel)});
  }
  return out;
}

double distance_m(const haptics::Plane& plane, const Vec3& hand_m) {
  return dot(plane.normal, hand_m) - plane.offset_m;
}

}  // namespace

haptics::Plane for_hand(const HandMap& map, const Vec3& normal, double offset_m, const FeelTable& feel) {
  const double at_m = (offset_m - dot(normal, map.tip_anchor_m)) / map.scale + dot(normal, map.hand_anchor_m);
  return {normal, at_m, feel.stiffness_N_m, feel.damping_N_s_m};
}

std::vector<HapticPlane> render_planes(const config::SceneFixture& fixture, std::uint32_t index,
                                       const Pose& frame_in_base, double room_m, double arm_radius_m,
                                       const HandMap& map, const FeelTable& feel) {
  const std::uint32_t number = kSides * index + kPerGrip * (map.grip % kGrips);
  if (fixture.kind == config::FixtureKind::kAxis) return funnel(number, fixture, frame_in_base, map, feel);
  if (fixture.kind == config::FixtureKind::kWalls)
    return both_sides(number, frame_in_base, fixture.half_gap_m - arm_radius_m, map, feel);
  const Onset begins = onset(room_m, map, feel);
  FeelTable stiff = feel;
  stiff.stiffness_N_m = begins.stiffness_N_m;
  return both_sides(number, frame_in_base, begins.from_m, map, stiff);
}

std::vector<HapticPlane> feel_workspace(const Vec3& low_m, const Vec3& high_m, double before_m, const FeelTable& feel) {
  std::vector<HapticPlane> out;
  for (std::size_t k = 0; k < 3; ++k) {
    Vec3 normal{};
    normal[k] = 1.0;
    const auto number = kWorkspace + static_cast<std::uint32_t>(kSides * k);
    out.push_back({number, {normal, low_m[k] + before_m, feel.stiffness_N_m, feel.damping_N_s_m}});
    out.push_back({number + 1, {scale(normal, -1.0), before_m - high_m[k], feel.stiffness_N_m, feel.damping_N_s_m}});
  }
  return out;
}

const PlaneSlots::Told& PlaneSlots::next(const std::vector<HapticPlane>& planes, const Vec3& hand_m) {
  std::vector<HapticPlane> nearest = planes;
  std::stable_sort(nearest.begin(), nearest.end(), [&](const HapticPlane& a, const HapticPlane& b) {
    return distance_m(a.plane, hand_m) < distance_m(b.plane, hand_m);
  });
  if (nearest.size() > kMaxPlanes) nearest.resize(kMaxPlanes);
  const auto take = [&](std::size_t slot, bool is_free) {
    const auto found = std::find_if(nearest.begin(), nearest.end(), [&](const HapticPlane& one) {
      return is_free ? std::find(number_.begin(), number_.end(), one.number) == number_.end()
                     : number_[slot] == one.number;
    });
    if (found == nearest.end()) return false;
    number_[slot] = found->number;
    told_[slot] = found->plane;
    return true;
  };
  for (std::size_t slot = 0; slot < kMaxPlanes; ++slot) {
    if (number_[slot] ? take(slot, false) : take(slot, true)) continue;
    number_[slot].reset();
    told_[slot].stiffness_N_m = told_[slot].damping_N_s_m = 0.0;
  }
  return told_;
}

}  // namespace liana::virtual_fixtures
