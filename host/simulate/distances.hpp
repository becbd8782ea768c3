// The least distances of a simulated way: arm to scene and arm to itself, certain also between its poses.
#pragma once

#include <span>
#include <vector>

#include "host/simulate/chain.hpp"
#include "host/simulate/motion.hpp"

namespace liana::simulate {

constexpr double kUnseen_m = 5e-4;      // what a least distance may be told too small, so that fewer poses are measured
constexpr double kEnoughSelf_m = 0.05;  // distances of the arm from itself beyond need not be told apart

// The arm's axis at every pose of a way, and how far the arm has gone since the first.
class Way {
 public:
  void clear();
  // The next pose, reached from the one before it with angles that run evenly.
  void add(const ArmModel& model, const Chain& chain, const ThetaVector& theta_rad);

  std::size_t size() const { return gone_m_.size(); }
  std::span<const Vec3> axis(std::size_t pose) const { return {&points_[pose * points_per_pose_], points_per_pose_}; }
  // A bound for every point of the arm, with whatever it does between two poses; never falls.
  std::span<const double> gone_m() const { return gone_m_; }

 private:
  double turned_rad(const ArmModel& model, const ThetaVector& theta_rad) const;

  std::size_t points_per_pose_ = 0;
  std::vector<Vec3> points_;
  std::vector<double> gone_m_;
  ThetaVector theta_rad_{};
};

// The scene's bodies, and where in the arm's base their drawing stands.
struct StandingScene {
  const config::SceneConfig& scene;
  Pose drawing_in_base{};
};

// Distances beyond `enough_m` need not be told apart. About 13,000 instructions a pose that is measured: two poses
// where the arm stays far away, at most all of them. `step_s` is from pose to pose.
Nearest least_to_scene(const ArmModel& model, const StandingScene& standing, const Way& way, double enough_m,
                       double step_s);
Nearest least_to_itself(const ArmModel& model, const Way& way, double step_s);
// At one pose.
double to_scene_m(const ArmModel& model, const StandingScene& standing, const Way& way, std::size_t pose);

}  // namespace liana::simulate
