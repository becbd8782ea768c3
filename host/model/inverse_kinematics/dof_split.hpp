// Dynamic combination of degrees of freedom (requirements A38 to A41): the arm is split into S1, the
// segments before the slit, which are free, and S2, the last ones, which lie in the slit's plane: their pitches are
// held, at 0 or at any other planar target.
//
// Holding itself is the motion stage's (IkGoal::held_mask, HeldProfile). Here is the geometry around it: where S2
// begins (equation 13 of the source), which yaws of S2 leave it a way through the mouth and S1 a chance to carry it,
// and how many segments S2 has to have. Pure functions of plain values. Not for the tick, except planar_segments.
#pragma once

#include <cstdint>

#include "firmware_like/cable/arm/kinematics.hpp"

namespace liana::inverse_kinematics {

using namespace cable;  // this room serves the cable arm only

// S2: the last `segments` segments, with the pose of the tip that they end in.
struct PlanarPart {
  std::int32_t segments = 0;  // 0 (no S2) .. segment_count
  Pose tip_in_base{};
  ThetaVector theta_rad{};  // only S2's are read
};

// The slit as a box that is open to the base. Half extents are of the room for link axes: those of the opening less the
// arm's radius.
struct SlitMouth {
  Pose
      frame_in_base{};  // origin in the middle of the mouth; x into the slit, y normal to its plates, z along its width
  double depth_m = 0.0;       // along x, > 0
  double half_gap_m = 0.0;    // along y, > 0
  double half_width_m = 0.0;  // along z, > 0
};

// Bits of the pitches of the last `segments` segments, for held_mask: 1 gives X5 of five segments, 2 gives X4 and X5.
std::uint32_t planar_pitches(const RobotParams& table, std::int32_t segments) noexcept;

// Pose of S2's root in the base frame, T_M = T_end f_S2^-1(theta_S2) (equation 13): the end that S1 has to reach. Exact
// to rounding; one forward kinematics.
Pose root_of(const RobotParams& table, const PlanarPart& part) noexcept;

// True when S2 may lie as `part` says: its root is no farther from the base than S1 is long (necessary, not sufficient:
// S1 may still fail to turn that way), and every piece of its link axes between x = 0 and x = depth of the mouth is
// inside gap and width. Exact for straight links; one forward kinematics and the links.
bool fits(const RobotParams& table, const PlanarPart& part, const SlitMouth& mouth) noexcept;

// Angles of one yaw for which S2 fits, all other angles and the tip as they are.
struct YawInterval {
  double lowest_rad = 0.0;
  double highest_rad = 0.0;
  bool empty = true;
};

// The interval around the yaw of `segment` (1-based, one of S2's), or around the nearest yaw that fits where that one
// does not; empty when none within the joint limits does, or `segment` is not S2's. Its ends fit and are within 1e-9
// rad of where fitting ends. Looked for in steps of 1/64 of the joint limit: gaps narrower than a step are not seen;
// between two fitting steps a point of S2 leaves the mouth by 0.5 mm at most (links of 0.1 m, S2 up to 1.6 m). At most
// 300 calls of fits().
YawInterval feasible_yaw(const RobotParams& table, const PlanarPart& part, const SlitMouth& mouth,
                         std::int32_t segment) noexcept;

// Whether any yaw of the last segment lets S2 fit with this tip, all other angles as they are: looked for in steps of
// 1/8 of the joint limit, the one given first. One call of fits() where that one does, at most 17.
bool some_yaw_fits(const RobotParams& table, const PlanarPart& part, const SlitMouth& mouth) noexcept;

// When a segment has to be planar.
struct PlanarSwitch {
  // How far before the mouth a segment comes into the plane; negative: how deep its end may be before. The default is
  // late: the shape's centring has the pitch of the next segment almost at 0 by then, and nine variables keep clear of
  // the plates better than eight. At the published press-rod pose segment 3 is 0.21 m deep and free.
  double look_ahead_m = -0.65;
  double hysteresis_m = 0.05;  // >= 0; released only when farther away by this
};

// How many segments have to be planar now: all from the first one with a link that ends farther than -look_ahead_m
// inside the slit (in its depth, and off the opening's sides by no more than |look_ahead_m|) to the last one: 0, 1, 2
// are the source's 10+0, 9+1, 8+2. `before` is the answer of the last call, 0 at first: an arm that goes in and out
// past the same point changes its answer at two places hysteresis_m apart. Cost: one rotation per link at most.
std::int32_t planar_segments(const RobotParams& table, const LinkPoints& links, const SlitMouth& mouth,
                             const PlanarSwitch& when, std::int32_t before) noexcept;

}  // namespace liana::inverse_kinematics
