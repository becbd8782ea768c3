// The least distances of a simulated way: arm to scene and arm to itself, certain also between its poses.
#pragma once

#include <span>
#include <vector>

#include "host/model/clearance/along_motion.hpp"
#include "host/model/clearance/clearance.hpp"
#include "host/model/simulation/motion.hpp"

namespace liana::simulation {

constexpr double kUnseen_m = 5e-4;      // what a least distance may be told too small, so that fewer poses are measured
constexpr double kEnoughSelf_m = 0.05;  // distances of the arm from itself beyond need not be told apart

// The arm's axis at every pose of a way, and how far the arm has gone since the first.
class Way {
 public:
  // A new way of an arm of this length.
  void begin(double length_m);
  // The next pose, reached from the one before it with angles that run evenly and turn by `turned_rad` together.
  void add(clearance::AxisPoints axis_m, double turned_rad);

  std::size_t size() const { return gone_m_.size(); }
  std::span<const Vec3> axis(std::size_t pose) const { return {&points_[pose * points_per_pose_], points_per_pose_}; }
  // A bound for every point of the arm, with whatever it does between two poses; never falls.
  std::span<const double> gone_m() const { return gone_m_; }

 private:
  double length_m_ = 0.0;
  std::size_t points_per_pose_ = 0;
  std::vector<Vec3> points_;
  std::vector<double> gone_m_;
};

// Capsules of one radius between points of a way's axis, one after the other; a piece has the number of its first
// point.
struct Pieces {
  double radius_m;
  std::size_t first_point, points;
};

// The scene's bodies, and where in the arm's base their drawing stands.
struct StandingScene {
  const config::SceneConfig& scene;
  Pose drawing_in_base{};
};

// Distances of an arm to the scene, `link` being a piece; those beyond `enough_m` need not be told apart. About 13,000
// instructions a pose that is measured: two poses where the arm stays far away, at most all of them; once more
// for each body where the arm could touch one at the start. `step_s` is from pose to pose.
void measure_to_scene(std::span<const Pieces> arm, const StandingScene& standing, const Way& way, double enough_m,
                      double step_s, Distances& out);

// The same of an arm from itself; `look(pose)` finds the least at one pose (clearance::SelfClearance).
template <class Look>
void measure_to_itself(const Way& way, double step_s, Look look, Distances& out) {
  const auto along = clearance::min_along({way.gone_m(), 2.0, kEnoughSelf_m, kUnseen_m}, look);
  out.self = {along.at_least_m, along.nearest.link, along.nearest.other, along.pose * step_s};
  out.self_at_start_m = out.self_at_end_m = out.self.distance_m;
  if (out.self.distance_m > 0.0) return;
  out.self_at_start_m = look(0).distance_m();
  out.self_at_end_m = look(static_cast<std::int32_t>(way.size()) - 1).distance_m();
}

}  // namespace liana::simulation
