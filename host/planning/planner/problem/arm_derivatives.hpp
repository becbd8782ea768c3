// The arm with first and second derivatives: points of links, tip attitude, cable lengths. Exact, for the planner's
// Hessians.
//
// A segment's own derivatives come from jets over the closed form (firmware_like/cable/arm/kinematics.hpp). Between
// segments rotations multiply: with w_i the angular velocity that theta i gives everything behind its segment, d2 p /
// di dj = w_i x dp/dj when segment(i) < segment(j), and within one segment R d2 s / di dj + dw_j/di x r + w_j x (w_i x
// r), r from the segment's end to p.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "firmware_like/cable/arm/robot_params.hpp"
#include "firmware_like/math/pose.hpp"
#include "host/planning/planner/problem/jet.hpp"

namespace liana::planner {

using namespace cable;  // this room serves the cable arm only

// Symmetric matrix over the thetas, entry [i][j] for i >= j only.
using ThetaHessian = std::array<std::array<double, kMaxTheta>, kMaxTheta>;

// A point of the arm's axis: share 0..1 of the way from the root of a link (0-based, over all segments) to its end.
struct ArmPoint {
  std::int32_t link = 0;
  double share = 0.0;
};

// Position of a point and its derivatives by the thetas of segments up to its own; the others are zero.
struct PointDerivatives {
  Vec3 position_m{};
  std::array<Vec3, kMaxTheta> by_theta{};
};

class ArmDerivatives {
 public:
  // Evaluates at theta [rad]: one closed form with jets per segment, about 10,000 flops for five segments of eight
  // modules.
  ArmDerivatives(const RobotParams& table, const ThetaVector& theta_rad);

  // A point and its Jacobian.
  PointDerivatives point(const ArmPoint& where) const;
  // Adds to `hessian` the second derivatives of weight . position. `at` is point(where).
  void add_hessian(const ArmPoint& where, const PointDerivatives& at, const Vec3& weight, ThetaHessian& hessian) const;

  // The end of a segment (1..segment_count) as a point of its last link.
  ArmPoint node(std::int32_t segment) const;

  // Tip attitude as unit quaternion, base frame.
  const Quat& tip_quaternion() const { return quaternion_.back(); }
  // d tip_quaternion / d theta.
  std::array<Quat, kMaxTheta> tip_quaternion_by_theta() const;
  // Adds the second derivatives of weight . tip_quaternion.
  void add_quaternion_hessian(const Quat& weight, ThetaHessian& hessian) const;

 private:
  struct Segment {
    std::vector<std::array<Jet, 3>> point;            // local ends of links 0 (root) .. modules
    std::array<Vec3, 2> spin{};                       // angular velocity of the end per angle, base frame
    std::array<std::array<Vec3, 2>, 2> spin_rate{};   // [i][j] = d spin_j / d angle i for the own segment, base frame
    std::array<Vec3, 2> end_rate{};                   // d end / d angle, base frame
    std::array<std::array<Vec3, 2>, 2> end_second{};  // second derivatives of the end, base frame
  };
  struct LocalPoint {
    std::size_t segment;
    std::array<Jet, 3> jet;
  };
  LocalPoint local(const ArmPoint& where) const;

  std::vector<std::int32_t> first_link_;  // of each segment, and the number of links
  std::vector<Segment> segment_;
  std::vector<Quat> quaternion_;  // of each segment's root, and of the tip
  std::vector<Vec3> origin_m_;    // of each segment's root, and of the tip
};

// Lengths of all cables (the path from first disc to anchor: mission, A3) with derivatives. A length is a sum
// over segments, so its second derivatives couple the two angles of one segment only.
struct CableDerivatives {
  std::vector<double> length_m;  // per cable
  std::vector<std::vector<Jet>>
      by_segment_m;  // [cable][segment]: part of the length that depends on the segment's angles
};
CableDerivatives cable_derivatives(const RobotParams& table, const ThetaVector& theta_rad);

}  // namespace liana::planner
