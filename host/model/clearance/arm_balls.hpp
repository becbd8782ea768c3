// Balls around groups of links: what cannot be near is not measured.
#pragma once

#include <array>
#include <cstdint>

#include "host/model/clearance/clearance.hpp"

namespace liana::clearance {

// Distances that differ by less are one when it comes to leaving something out: far above what sums of the scene's
// numbers (up to 100 m) round by.
constexpr double kRounding_m = 1e-9;

struct Ball {
  Vec3 center_m{};
  double radius_m = 0.0;
};

// An arm as a row of balls, each around kGroup links with their surfaces (more of them when there are more than 32
// groups). Cost: about 25 instructions a point.
class ArmBalls {
 public:
  static constexpr std::int32_t kGroup = 4;

  ArmBalls(AxisPoints points, double radius_m) noexcept;

  std::int32_t links() const { return links_; }
  std::int32_t count() const { return count_; }
  const Ball& ball(std::int32_t group) const { return ball_[static_cast<std::size_t>(group)]; }
  // Links first(g) .. first(g + 1) - 1 are in the ball of group g.
  std::int32_t first(std::int32_t group) const { return group * size_ < links_ ? group * size_ : links_; }
  // False when a point is no number or beyond 1e6 m: then nothing can be said of the arm.
  bool sound() const { return sound_; }

 private:
  static constexpr std::int32_t kMaxGroups = 32;

  std::array<Ball, kMaxGroups> ball_;
  std::int32_t links_ = 0, count_ = 0, size_ = kGroup;
  bool sound_ = true;
};

// No point of the ball is nearer to the obstacle's surface than this, but for a rounding; exact where the ball is
// outside.
double min_possible_m(const Ball& ball, const config::SceneSphere& sphere) noexcept;
double min_possible_m(const Ball& ball, const config::SceneBox& box) noexcept;
// Of the box around the body, which is all that is looked at here.
double min_possible_m(const Ball& ball, const config::SceneConvex& body) noexcept;

// The same for a link. To a sphere no bound is cheaper than the distance, so there is none; to a box it is the largest
// gap between a pair of its faces' planes and the link, exact where the link is beyond a face.
inline double min_possible_m(const Capsule&, const config::SceneSphere&) noexcept { return -kNoObstacle_m; }
double min_possible_m(const Capsule& link, const config::SceneBox& box) noexcept;
double min_possible_m(const Capsule& link, const config::SceneConvex& body) noexcept;

}  // namespace liana::clearance
