// Penalty forces of contacts, with the part that must be implicit to be stable at 1 kHz.
#pragma once

#include "hil/arm/chain.hpp"
#include "hil/arm/push.hpp"
#include "hil/config/scene_config.hpp"
#include "hil/math/reduced.hpp"

namespace liana::bench {

// What contacts add to one step: (M + step * damping) v_new = M v + step * force.
struct ContactLoad {
  Theta force{};           // explicit generalised force [N.m]
  ThetaMatrix damping{};   // [N.m.s/rad]; already holds step * stiffness
  double largest_N = 0.0;  // largest single contact, any body with anything except tip on rod
  double rod_N = 0.0;      // rod on tip
};

void add_push(const Push& push, const Chain& chain, std::size_t thetas, ContactLoad& load);

// Adds spring, damper and regularised Coulomb friction of one contact of a link.
void add_contact(const ContactConfig& law, const Chain& chain, const Contact& contact, const Theta& rate_rad_s,
                 std::size_t thetas, double step_s, ContactLoad& load);

// Force of the rod on the tip point, base frame [N]: stiffness times the depth below the rod's surface measured along
// the rod's x axis, pushing back along -x, the way the tip came. Zero outside the sphere.
Vec3 rod_force_N(const RodConfig& rod, const Vec3& tip_m);

// Adds the rod's push on the tip.
void add_rod(const RodConfig& rod, const Chain& chain, std::size_t thetas, ContactLoad& load);

}  // namespace liana::bench
