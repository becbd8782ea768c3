// What the links of a serial arm weigh: plain numbers, checked once by the loader, constant afterwards.
#pragma once

#include <array>
#include <type_traits>

#include "firmware_like/math/pose.hpp"
#include "firmware_like/serial/joint_vector.hpp"

namespace liana::serial {

// Element of a symmetric inertia tensor in LinkMass::inertia_kgm2. Products are the tensor's own elements: their sign
// is that of -sum(x y m).
enum InertiaElement : std::size_t { kXx, kYy, kZz, kXy, kXz, kYz, kInertiaElements };

// A rigid body in a frame that the context names.
struct LinkMass {
  double mass_kg = 0.0;
  Vec3 center_m{};                                      // of mass
  std::array<double, kInertiaElements> inertia_kgm2{};  // about the centre of mass, along the frame's axes
};

// Per link, in the DH frame at its end, the one that turns with it.
struct MassTable {
  std::array<LinkMass, kMaxJoints> link{};
};

static_assert(std::is_trivially_copyable_v<MassTable>);

constexpr double kMaxMass_kg = 1e5;
constexpr double kMaxCenter_m = 20.0;
constexpr double kMaxInertia_kgm2 = 1e6;

// True for what a body can be: finite, within these bounds, an inertia that is positive definite and of which no moment
// is larger than the other two together; without mass, anything finite.
bool is_body(const LinkMass& body) noexcept;

// Both bodies as one, in the frame that both are given in; a body without mass adds nothing.
LinkMass joined(const LinkMass& a, const LinkMass& b) noexcept;

// The body in the frame that `frame_in_outer` is given in.
LinkMass moved(const LinkMass& body, const Pose& frame_in_outer) noexcept;

// The inertia tensor times a vector.
Vec3 inertia_times(const LinkMass& body, const Vec3& v) noexcept;

}  // namespace liana::serial
