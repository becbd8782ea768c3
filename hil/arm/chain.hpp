// The arm as hinges in MuJoCo, on a slide and a roll where it has a base, seen through the reduced angles: positions,
// inertia, bias forces, contacts.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hil/arm/linkage.hpp"
#include "hil/config/robot_config.hpp"
#include "hil/config/scene_config.hpp"
#include "hil/math/reduced.hpp"
#include "hil/math/vec3.hpp"

namespace liana::bench {

// A link overlapping a shape of the scene.
struct Contact {
  std::size_t link = 0;
  Vec3 point_m;
  Vec3 normal;           // unit, from the shape towards the link
  double depth_m = 0.0;  // > 0
  bool rod = false;      // the shape is the rod
};

// 3 x n: velocity of a point of a link per reduced rate, one row per base axis.
using PointJacobian = std::array<Theta, 3>;

class Chain {
 public:
  // Throws std::runtime_error when MuJoCo refuses the model.
  Chain(const RobotConfig& robot, const SceneConfig& scene, bool with_tendons = false);
  ~Chain();
  Chain(const Chain&) = delete;
  Chain& operator=(const Chain&) = delete;

  // Places all hinges; everything below refers to these angles.
  void place(const Theta& theta_rad);
  // Reduced mass matrix S^T M S [kg.m^2]; upper-left n x n block.
  void inertia(ThetaMatrix& mass);
  // Weight from now on [m/s^2], in the base frame; none at first. Part of bias(), as the springs of the joints are.
  void set_gravity(const Vec3& gravity_m_s2);
  // How the joints of each segment share its bend from now on; all alike at first.
  void set_linkage(const Linkage& linkage);
  // Reduced Coriolis and centrifugal forces, weight and springs [N.m].
  void bias(const Theta& rate_rad_s, Theta& force);
  // The rod is gone from now on.
  void remove_rod();
  // Overlaps of links with the scene.
  const std::vector<Contact>& contacts();

  std::size_t link_count() const { return links_; }
  // Start of a link's axis, links counted without the base; `link` == link_count() is the tip. Base frame, metres.
  Vec3 joint_center_m(std::size_t link) const;
  Pose tip() const;
  void point_jacobian(std::size_t link, const Vec3& point_m, PointJacobian& jacobian) const;

  // MuJoCo's warnings so far (full contact buffer, bad numbers, ...), all kinds together.
  std::uint64_t warnings() const;
  // Lengths of the spatial tendons; only with `with_tendons`.
  std::vector<double> tendon_lengths_m();
  // The unreduced mass matrix, row by row; for checks.
  std::vector<double> full_inertia();
  // Reduced index of a hinge, and its angle per reduced angle: the constant matrix S. Slide and roll of a base come
  // first; the slide's is metres per angle.
  std::size_t theta_of_hinge(std::size_t hinge) const { return theta_of_hinge_[hinge]; }
  double share_of_hinge(std::size_t hinge) const { return share_of_hinge_[hinge]; }

 private:
  struct Engine;
  std::unique_ptr<Engine> engine_;
  std::size_t base_joints_ = 0;
  std::size_t first_body_ = 1;  // of the links; MuJoCo's world is 0
  std::size_t links_ = 0;
  std::size_t thetas_ = 0;
  double tip_offset_m_ = 0.0;
  std::vector<std::size_t> theta_of_hinge_;
  std::vector<double> share_of_hinge_;
  struct Spring {
    double stiffness_Nm_rad = 0.0, rest_rad = 0.0;
  };
  std::vector<Spring> spring_of_hinge_;
  std::vector<Contact> contacts_;
};

}  // namespace liana::bench
