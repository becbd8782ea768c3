// What ways of moving have to know of a kind of arm: ArmTraits<Arm>, one small struct each (cable_kind.hpp,
// serial_kind.hpp). Everything else about moving is the same for all arms.
#pragma once

#include <concepts>
#include <cstddef>
#include <optional>
#include <variant>

#include "firmware_like/controller_io.hpp"
#include "firmware_like/math/pose.hpp"
#include "firmware_like/operator_input/tip_filter.hpp"

namespace liana::arbiter {

// Bounds of the tip's motion [m, rad, s].
struct TipBounds {
  FilterBounds linear{};
  FilterBounds angular{};
};

struct JointRange {
  double low_rad = 0.0;
  double high_rad = 0.0;
};

// Specialised for every arm that the host serves.
template <class Arm>
struct ArmTraits;

template <class Arm>
using Joints = typename ArmTraits<Arm>::Joints;

// What a specialisation offers. `Wishes` is what may be asked for besides a tip goal and stays in force until it is
// changed.
template <class Arm>
concept SupportedArm = requires(const typename Arm::Table& table, const Joints<Arm>& joint_rad,
                                const liana::Outputs<Arm>& now, const typename ArmTraits<Arm>::Wishes& wishes,
                                typename Arm::Setpoint& setpoint, std::size_t joint) {
  { ArmTraits<Arm>::joint_count(table) } -> std::same_as<std::size_t>;
  { ArmTraits<Arm>::rate_rad_s(table, joint) } -> std::same_as<double>;  // limit of a joint
  // Acceleration of a joint that planned moves use.
  { ArmTraits<Arm>::move_accel_rad_s2(table, joint) } -> std::same_as<double>;
  { ArmTraits<Arm>::range_rad(table, joint) } -> std::same_as<JointRange>;
  { ArmTraits<Arm>::kJointName } -> std::convertible_to<const char*>;  // for messages
  // What to do instead where a straight way is refused, for messages.
  { ArmTraits<Arm>::kOtherWay } -> std::convertible_to<const char*>;
  // Greatest distance [m] of any node, or joint, and the tip between two poses.
  { ArmTraits<Arm>::apart_m(table, joint_rad, joint_rad) } -> std::same_as<double>;
  // Shortest time [s] that drives need from one pose to the other, where they have limits besides those of the joints.
  { ArmTraits<Arm>::drive_time_s(table, joint_rad, joint_rad) } -> std::same_as<double>;
  { ArmTraits<Arm>::tip_bounds(table) } -> std::same_as<TipBounds>;
  { ArmTraits<Arm>::tip_at(table, joint_rad) } -> std::same_as<Pose>;
  // Where the command stands.
  { ArmTraits<Arm>::command_rad(now) } -> std::same_as<const Joints<Arm>&>;
  // Where the joints were measured to be.
  { ArmTraits<Arm>::measured_rad(now) } -> std::same_as<const Joints<Arm>&>;
  { ArmTraits<Arm>::add_wishes(wishes, setpoint) } -> std::same_as<void>;
  // Whether all that is wished has come to be (flag: the tip stands at its goal).
  { ArmTraits<Arm>::has_arrived(wishes, now, bool{}) } -> std::same_as<bool>;
};

// What a way of moving asks for in a command interval: a tip pose or joints; neither: the arm comes to rest on its
// path.
template <class Arm>
using Goal = std::variant<std::monostate, Pose, Joints<Arm>>;

// A way of moving, begun by its constructor. Once per command interval `next` is asked, and `is_over` after it.
// `refused` follows when verification refuses what was asked for: true, the way goes on nevertheless. While a planned
// one is under way, other requests are busy.
template <class W, class Arm>
concept MotionGenerator = requires(W way, const W& seen, const liana::Outputs<Arm>& now) {
  { way.next(now) } -> std::same_as<Goal<Arm>>;
  { seen.is_over() } -> std::same_as<bool>;
  { way.refused() } -> std::same_as<bool>;
  { W::kIsPlanned } -> std::convertible_to<bool>;
};

// Joints between two poses, share 0..1.
template <class Vector>
Vector between(const Vector& a, const Vector& b, double share) {
  Vector joints{};
  for (std::size_t i = 0; i < joints.size(); ++i) joints[i] = a[i] + share * (b[i] - a[i]);
  return joints;
}

// Duration of a command interval [s].
template <class Table>
double interval_s(const Table& table) {
  return table.tick_s * table.interval_ticks;
}

}  // namespace liana::arbiter
