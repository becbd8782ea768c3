#include "hil/arm/contact_forces.hpp"

#include <algorithm>
#include <cmath>

namespace liana::bench {

namespace {

constexpr double kStickSpeed_m_s = 1e-3;  // Coulomb friction is viscous below this

Theta along(const PointJacobian& jacobian, const Vec3& direction, std::size_t thetas) {
  Theta row{};
  for (std::size_t i = 0; i < thetas; ++i)
    row[i] = direction.x * jacobian[0][i] + direction.y * jacobian[1][i] + direction.z * jacobian[2][i];
  return row;
}

void add_outer(ThetaMatrix& matrix, double scale, const Theta& row, std::size_t thetas) {
  for (std::size_t a = 0; a < thetas; ++a)
    for (std::size_t b = 0; b < thetas; ++b) matrix[a][b] += scale * row[a] * row[b];
}

Vec3 velocity_of(const PointJacobian& jacobian, const Theta& rate, std::size_t thetas) {
  Vec3 v;
  for (std::size_t i = 0; i < thetas; ++i) v = v + rate[i] * Vec3{jacobian[0][i], jacobian[1][i], jacobian[2][i]};
  return v;
}

}  // namespace

void add_push(const Push& push, const Chain& chain, std::size_t thetas, ContactLoad& load) {
  PointJacobian jacobian;
  chain.point_jacobian(std::min(push.link, chain.link_count() - 1), chain.joint_center_m(push.link), jacobian);
  const Theta torque = along(jacobian, push.force_N, thetas);
  for (std::size_t i = 0; i < thetas; ++i) load.force[i] += torque[i];
}

void add_contact(const ContactConfig& law, const Chain& chain, const Contact& contact, const Theta& rate_rad_s,
                 std::size_t thetas, double step_s, ContactLoad& load) {
  PointJacobian jacobian;
  chain.point_jacobian(contact.link, contact.point_m, jacobian);
  const Vec3 velocity = velocity_of(jacobian, rate_rad_s, thetas);
  const double leaving = dot(velocity, contact.normal);
  const double normal_N = law.stiffness_N_per_m * contact.depth_m - law.damping_Ns_per_m * leaving;
  if (normal_N <= 0.0) return;
  const Theta normal = along(jacobian, contact.normal, thetas);
  for (std::size_t i = 0; i < thetas; ++i) load.force[i] += law.stiffness_N_per_m * contact.depth_m * normal[i];
  add_outer(load.damping, law.damping_Ns_per_m + step_s * law.stiffness_N_per_m, normal, thetas);

  const Vec3 sliding = velocity - leaving * contact.normal;
  const double speed = norm(sliding);
  const double viscous = law.friction * normal_N / std::max(speed, kStickSpeed_m_s);
  const Vec3 helper = std::fabs(contact.normal.x) < 0.8 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
  const Vec3 raw = cross(contact.normal, helper);
  const Vec3 tangent = (1.0 / norm(raw)) * raw;
  add_outer(load.damping, viscous, along(jacobian, tangent, thetas), thetas);
  add_outer(load.damping, viscous, along(jacobian, cross(contact.normal, tangent), thetas), thetas);
  load.largest_N = std::max(load.largest_N, std::hypot(normal_N, viscous * speed));
}

Vec3 rod_force_N(const RodConfig& rod, const Vec3& tip_m) {
  const Vec3 from_center = tip_m - rod.pose.position_m;
  if (dot(from_center, from_center) >= rod.radius_m * rod.radius_m) return {};
  const Vec3 axis = rotate(rod.pose.attitude, {1.0, 0.0, 0.0});
  const double inserted = dot(from_center, axis);
  const double across_squared = dot(from_center, from_center) - inserted * inserted;
  const double depth = inserted + std::sqrt(std::max(0.0, rod.radius_m * rod.radius_m - across_squared));
  return (-rod.stiffness_N_per_m * depth) * axis;
}

void add_rod(const RodConfig& rod, const Chain& chain, std::size_t thetas, ContactLoad& load) {
  const Vec3 tip = chain.tip().position_m;
  const Vec3 push = rod_force_N(rod, tip);
  load.rod_N = norm(push);
  if (load.rod_N == 0.0) return;
  PointJacobian jacobian;
  chain.point_jacobian(chain.link_count() - 1, tip, jacobian);
  const Theta torque = along(jacobian, push, thetas);
  for (std::size_t i = 0; i < thetas; ++i) load.force[i] += torque[i];
}

}  // namespace liana::bench
