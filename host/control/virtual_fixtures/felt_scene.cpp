#include "host/control/virtual_fixtures/felt_scene.hpp"

namespace liana::virtual_fixtures {
namespace {

// Where a fixture stands for commands, and nothing where it is not felt.
std::optional<Pose> felt_at(const Guidance& guidance, const config::SceneFixture& fixture, const Vec3& tip_command_m) {
  if (!guidance.is_chosen(fixture.name)) return std::nullopt;
  if (fixture.kind == config::FixtureKind::kPlane)
    return guidance.plane_name() == fixture.name ? std::optional(guidance.plane()->frame_in_base) : std::nullopt;
  Pose frame = frame_in_base(fixture, guidance.sight().drawing_in_base);
  frame.position_m = subtract(frame.position_m, guidance.sight().off_m);
  return is_along(fixture, in_frame(frame, tip_command_m)) ? std::optional(frame) : std::nullopt;
}

}  // namespace

std::vector<HapticPlane> feel_scene(const Guidance& guidance, const Vec3& tip_command_m, double room_m,
                                    double arm_radius_m, const HandMap& map, const FeelTable& feel) {
  std::vector<HapticPlane> out;
  const std::vector<config::SceneFixture>& fixtures = guidance.fixtures();
  for (std::uint32_t i = 0; i < fixtures.size(); ++i) {
    const std::optional<Pose> frame = felt_at(guidance, fixtures[i], tip_command_m);
    if (!frame) continue;
    const auto planes = render_planes(fixtures[i], i, *frame, room_m, arm_radius_m, map, feel);
    out.insert(out.end(), planes.begin(), planes.end());
  }
  return out;
}

}  // namespace liana::virtual_fixtures
