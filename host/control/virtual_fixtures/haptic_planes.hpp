// What a hand feels of fixtures and of its own workspace: planes in the device's frame, with stiffness and damping, to
// be rendered at the device's own rate (docs/explanation/virtual-fixtures.md). Never a force.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "host/control/virtual_fixtures/moving_plane.hpp"
#include "host/control/virtual_fixtures/placed.hpp"

namespace liana::virtual_fixtures {

constexpr std::size_t kMaxPlanes = 6;  // that a device is told

struct FeelTable {
  double stiffness_N_m = 1500.0;
  double damping_N_s_m = 10.0;
  double max_stiffness_N_m = 3000.0;
  double full_N = 6.0;       // felt in full where the plane's room is used up to
  double full_share = 0.75;  // this
};

// Where hand and tip stood when the operator engaged, and the tip's way for one of the hand (> 0): the device's frame
// is parallel to the base frame.
struct HandMap {
  Vec3 hand_anchor_m{}, tip_anchor_m{};
  double scale = 1.0;
  std::uint32_t grip = 0;  // counts grips: planes of another one are other planes, which have moved with the anchors
};

// A plane that keeps its number from interval to interval, whatever moves it.
struct HapticPlane {
  std::uint32_t number = 0;
  haptics::Plane plane{};
};

// Free where normal . tip >= offset_m, base frame, as a plane for the hand.
haptics::Plane for_hand(const HandMap& map, const Vec3& normal, double offset_m, const FeelTable& feel);

// The fixture at `index` of the scene as it is felt, standing at `frame_in_base`. A plane: to either side the force
// begins so far off it that it is full_N at full_share of `room_m`, the smaller of the verified clearance and of what
// the pitch budget leaves the tip; where that is less than full_N takes at the stiffness, it begins in the plane and
// is stiffer, up to max_stiffness_N_m. Walls: at +-(half gap - arm's radius). An axis: the two sides of its funnel.
std::vector<HapticPlane> render_planes(const config::SceneFixture& fixture, std::uint32_t index,
                                       const Pose& frame_in_base, double room_m, double arm_radius_m,
                                       const HandMap& map, const FeelTable& feel = {});

// The faces of a device's workspace, felt `before_m` before its stops.
std::vector<HapticPlane> feel_workspace(const Vec3& low_m, const Vec3& high_m, double before_m,
                                        const FeelTable& feel = {});

// Which planes a device is told: of all the kMaxPlanes that the hand is nearest to, each in one slot as long as it is
// told. A slot is told "no stiffness" for an interval before another plane takes it, so that a device that moves each
// of its planes evenly never sweeps one through the hand.
class PlaneSlots {
 public:
  using Told = std::array<haptics::Plane, kMaxPlanes>;  // stiffness 0: none
  // Once per interval, with the hand's place in the device's frame.
  const Told& next(const std::vector<HapticPlane>& planes, const Vec3& hand_m);

 private:
  std::array<std::optional<std::uint32_t>, kMaxPlanes> number_{};
  Told told_{};
};

}  // namespace liana::virtual_fixtures
