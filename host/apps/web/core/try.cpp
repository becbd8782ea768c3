#include "host/apps/web/core/try.hpp"

#include <memory>
#include <string>

#include "firmware_like/math/trig.hpp"
#include "host/apps/web/core/try_arm.hpp"

namespace {

using liana::web::TryArm;

constexpr const char* kStart = "panel_edge";
constexpr int kHomingIntervals = 10;  // 50 ticks; homing takes 25 (cable::kHomingTicks)

std::string room;
std::unique_ptr<TryArm> arm;

std::uint32_t answer(std::string text) {
  room = std::move(text);
  return static_cast<std::uint32_t>(room.size());
}

std::string line(std::size_t& at) {
  const std::size_t end = room.find('\n', at);
  const std::string text = room.substr(at, end - at);
  at = end + 1;
  return text;
}

}  // namespace

extern "C" {

char* liana_try_room(std::uint32_t bytes) {
  room.resize(bytes);
  return room.data();
}

void liana_try_begin() {
  std::size_t at = 0;
  const auto buses = liana::config::parse_buses(line(at), "this page's buses");
  const auto robot = liana::config::parse_robot(line(at), "this page's robot", "ideal", buses);
  const auto scene = liana::config::parse_scene(line(at), "this page's scene");
  liana::cable::ThetaVector start_rad{};
  const auto& start_deg = robot.named_poses_deg.at(kStart);
  for (std::size_t i = 0; i < start_deg.size(); ++i) start_rad[i] = start_deg[i] * liana::kDegree;
  arm = std::make_unique<TryArm>(robot, scene, start_rad);
  for (int i = 0; i < kHomingIntervals; ++i) arm->interval(liana::Request::kNone, std::nullopt);
}

void liana_try_interval(std::uint32_t request, std::uint32_t wanted, double x, double y, double z, double qw, double qx,
                        double qy, double qz) {
  std::optional<liana::Pose> target;
  if (wanted != 0) target = liana::Pose{{x, y, z}, liana::normalize({qw, qx, qy, qz})};
  arm->interval(static_cast<liana::Request>(request), target);
}

std::uint32_t liana_try_state() { return answer(arm->state()); }
std::uint32_t liana_try_hash() { return answer(arm->hash()); }
const char* liana_try_place() { return room.data(); }
}
