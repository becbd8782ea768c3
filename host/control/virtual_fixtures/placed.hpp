// Where a scene's fixture stands, and what of the tip is in it.
#pragma once

#include <cmath>

#include "firmware_like/math/pose.hpp"
#include "host/model/config/config.hpp"

namespace liana::virtual_fixtures {

inline constexpr Vec3 kX{1.0, 0.0, 0.0}, kY{0.0, 1.0, 0.0}, kZ{0.0, 0.0, 1.0};

// What is known beside the drawing and the command (docs/explanation/verification.md); zeros: nothing.
struct Sight {
  Pose drawing_in_base{};  // where the frame stands that the scene is drawn in
  Vec3 off_m{};            // the tip as it is believed to be less as it is commanded, base frame
  Vec3 off_rad{};          // and turned by this rotation vector
};

// The fixture's frame, base frame, where the scene stands.
inline Pose frame_in_base(const config::SceneFixture& fixture, const Pose& drawing_in_base) {
  return compose(drawing_in_base, {fixture.frame.position_m, fixture.frame.quaternion_wxyz});
}

// A point in the frame's coordinates.
inline Vec3 in_frame(const Pose& frame_in_base, const Vec3& point_in_base) {
  return rotate(conjugate(frame_in_base.quaternion), subtract(point_in_base, frame_in_base.position_m));
}

// A point, in its frame's coordinates, lies in the fixture's length and width, grown by `more_m`.
inline bool is_along(const config::SceneFixture& fixture, const Vec3& point, double more_m = 0.0) {
  return point[0] >= -more_m && point[0] <= fixture.depth_m + more_m &&
         std::fabs(point[2]) <= fixture.half_width_m + more_m;
}

}  // namespace liana::virtual_fixtures
