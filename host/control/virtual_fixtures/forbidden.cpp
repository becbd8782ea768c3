#include "host/control/virtual_fixtures/forbidden.hpp"

namespace liana::virtual_fixtures {

std::optional<Beyond> beyond_walls(const config::SceneFixture& fixture, double arm_radius_m,
                                   const Pose& drawing_in_base, const Vec3& tip_in_base) {
  if (fixture.kind != config::FixtureKind::kWalls) return {};
  const Vec3 tip = in_frame(frame_in_base(fixture, drawing_in_base), tip_in_base);
  if (!is_along(fixture, tip)) return {};
  const double off_m = std::fabs(tip[1]);
  return Beyond{off_m - (fixture.half_gap_m - arm_radius_m), off_m <= fixture.half_gap_m};
}

}  // namespace liana::virtual_fixtures
