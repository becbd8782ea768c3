// Dynamics of a chain of revolute joints by the recursive Newton-Euler method (docs/explanation/serial-arm.md).
#pragma once

#include <array>
#include <type_traits>

#include "firmware_like/math/cholesky.hpp"
#include "firmware_like/math/pose.hpp"
#include "firmware_like/serial/mass_table.hpp"
#include "firmware_like/serial/robot_params.hpp"
#include "firmware_like/serial/wrench.hpp"

namespace liana::serial {

// How the joints move; angles |.| <= 1000 rad.
struct JointMotion {
  JointVector joint_rad{};
  JointVector rate_rad_s{};
  JointVector accel_rad_s2{};
};

using MassMatrix = SquareMatrix<kMaxJoints>;

class Dynamics {
 public:
  // Tables that passed the loader; the last link's mass has no payload in it.
  Dynamics(const RobotParams& table, const MassTable& masses) noexcept;

  // A body fixed to the tip, in the tip's frame; replaces the one before. One without mass: none.
  void set_payload(const LinkMass& payload_at_tip) noexcept;

  // `on_tip` is what pushes and turns the tip from outside, in the base frame, about the tip's origin.
  // Torques [N.m] that the links' sides of the gears have to give for this motion: M(q) qdd + h(q, qd) - J^T on_tip,
  // less what gravity [m/s^2, base frame] gives; rotors and friction are before the gears and not in it. Cost: always
  // the same, about 250 operations and one sine a joint.
  JointVector torque_Nm(const JointMotion& motion, const Wrench& on_tip, const Vec3& gravity_m_s2 = {}) const noexcept;

  // M(q) [kg.m2], symmetric and positive definite; rows and columns beyond the last joint are the unit matrix's, so
  // that it can be factored (math/cholesky.hpp). Cost: that of joint_count times torque_Nm.
  MassMatrix mass_matrix(const JointVector& joint_rad) const noexcept;

 private:
  // What of a link does not change: it turns about `axis`, and reaches from the frame before it to its own.
  struct Link {
    double sin_alpha = 0.0;
    double cos_alpha = 1.0;
    double offset_rad = 0.0;
    Vec3 axis{};     // of the joint, in the link's frame
    Vec3 reach_m{};  // origin of the link's frame as seen from the one before, in the link's frame
    LinkMass mass{};
  };
  struct Turn {
    double sin = 0.0;
    double cos = 1.0;
  };
  using Turns = std::array<Turn, kMaxJoints>;

  Turns turns_at(const JointVector& joint_rad) const noexcept;
  JointVector recurse(const Turns& turns, const JointVector& rate_rad_s, const JointVector& accel_rad_s2,
                      const Wrench& on_tip, const Vec3& gravity_m_s2) const noexcept;
  static Vec3 into_link(const Link& link, const Turn& turn, const Vec3& v) noexcept;
  static Vec3 out_of_link(const Link& link, const Turn& turn, const Vec3& v) noexcept;

  std::size_t joints_ = 0;
  std::array<Link, kMaxJoints> link_{};
  LinkMass last_alone_{};  // the last link without payload
};

static_assert(std::is_trivially_copyable_v<Dynamics>);

}  // namespace liana::serial
