#include "host/model/config/serial_mass.hpp"

#include <cmath>

#include "firmware_like/math/trig.hpp"

namespace liana::config {
namespace {

using serial::LinkMass;

constexpr Range kMass_kg{0.01, 1e5};
constexpr double kBoomRadius_m = 0.05;  // where the table does not say

LinkMass sphere(double mass_kg, double radius_m, const Vec3& center_m) {
  const double I = 0.4 * mass_kg * radius_m * radius_m;
  return {mass_kg, center_m, {I, I, I, 0.0, 0.0, 0.0}};
}

// A solid cylinder along x, from -length to 0.
LinkMass rod(double mass_kg, double radius_m, double length_m) {
  const double along = 0.5 * mass_kg * radius_m * radius_m;
  const double across = mass_kg * (3.0 * radius_m * radius_m + length_m * length_m) / 12.0;
  return {mass_kg, {-0.5 * length_m, 0.0, 0.0}, {along, across, across, 0.0, 0.0, 0.0}};
}

// Where the joint is, as seen from the frame at the link's end.
Vec3 joint_in_link(const serial::DhRow& row) {
  const SinCos alpha = sin_cos(row.alpha_rad);
  return {-row.a_m, -row.d_m * alpha.sin, -row.d_m * alpha.cos};
}

serial::MassTable drawn(const Field& mass, const serial::RobotParams& robot) {
  mass.only({"module_kg", "module_radius_m", "boom_kg", "boom_radius_m", "end_effector_kg"});
  const double module_kg = mass.at("module_kg").number(kMass_kg), boom_kg = mass.at("boom_kg").number(kMass_kg);
  const double module_radius_m = mass.at("module_radius_m").number({0.01, 5});
  const bool says_radius = mass.json().contains("boom_radius_m");
  const double boom_radius_m = says_radius ? mass.at("boom_radius_m").number({0.001, 5}) : kBoomRadius_m;
  serial::MassTable out;
  for (std::size_t i = 0; i < robot.joints(); ++i) {
    const serial::DhRow& row = robot.joint[i].dh;
    out.link[i] = sphere(module_kg, module_radius_m, joint_in_link(row));
    if (row.a_m != 0.0) out.link[i] = joined(out.link[i], rod(boom_kg, boom_radius_m, row.a_m));
  }
  LinkMass& last = out.link[robot.joints() - 1];
  last = joined(last, sphere(mass.at("end_effector_kg").number(kMass_kg), module_radius_m, {}));
  return out;
}

// The second moments of mass, sum(x x m) and so on, are half the trace less the inertia; no body has negative ones.
bool is_of_a_body(const LinkMass& link) {
  using enum serial::InertiaElement;
  const auto& I = link.inertia_kgm2;
  const double half = 0.5 * (I[kXx] + I[kYy] + I[kZz]);
  const double x = half - I[kXx], y = half - I[kYy], z = half - I[kZz];
  const double xy = x * y - I[kXy] * I[kXy], xz = x * z - I[kXz] * I[kXz], yz = y * z - I[kYz] * I[kYz];
  const double all = x * yz - I[kXy] * (I[kXy] * z + I[kXz] * I[kYz]) - I[kXz] * (I[kXz] * y + I[kXy] * I[kYz]);
  const double none = 1e-9 * half;  // of a plate or a rod, but for rounding
  return x >= -none && y >= -none && z >= -none && xy >= -none * half && xz >= -none * half && yz >= -none * half &&
         all >= -none * half * half;
}

LinkMass read_link(const Field& field) {
  field.only({"mass_kg", "center_m", "inertia_kgm2"});
  LinkMass link;
  link.mass_kg = field.at("mass_kg").number(kMass_kg);
  link.center_m = field.at("center_m").numbers<3>({-20, 20});
  const Field inertia = field.at("inertia_kgm2");
  link.inertia_kgm2 = inertia.numbers<serial::kInertiaElements>({-1e6, 1e6});
  for (std::size_t i = 0; i < 3; ++i) inertia.element(i).number({1e-9, 1e6});
  if (!is_of_a_body(link))
    inertia.refuse("xx, yy, zz, xy, xz, yz of a body: none of the principal moments larger than the other two together",
                   "take it about the centre of mass, along the axes of the frame at the link's end; products with "
                   "the sign they have in the tensor");
  return link;
}

}  // namespace

serial::MassTable read_masses(const Field& table, const serial::RobotParams& robot) {
  const Field joints = table.at("joints");
  const bool by_link = joints.element(0).json().contains("link");
  for (std::size_t i = 0; i < robot.joints(); ++i) {
    if (joints.element(i).json().contains("link") != by_link)
      joints.element(i).refuse("link at every joint or at none", "add it here, or leave it out elsewhere");
  }
  if (!by_link) return drawn(table.at("mass"), robot);
  if (table.json().contains("mass"))
    table.at("mass").refuse("mass, or link at every joint", "leave one of them out: each says what the links weigh");
  serial::MassTable out;
  for (std::size_t i = 0; i < robot.joints(); ++i) out.link[i] = read_link(joints.element(i).at("link"));
  return out;
}

}  // namespace liana::config
