#include "hil/payload/true_payload.hpp"

#include <cmath>

#include "hil/math/random.hpp"

namespace liana::bench {

SerialRobotConfig true_joints(const SerialRobotConfig& robot, std::uint64_t seed) {
  SerialRobotConfig out = robot;
  Random friction(seed, "joint friction"), gears(seed, "gear stiffness"), base(seed, "base stiffness");
  out.coulomb_Nm *= friction.uniform(0.5, 1.9);
  const double gear_share = gears.uniform(0.7, 1.3), base_share = base.uniform(0.8, 1.2);
  for (double& stiffness : out.stiffness_Nm_rad) stiffness *= gear_share;
  if (!out.base) return out;
  auto softer = std::make_shared<LockedBaseConfig>(*out.base);
  for (double& stiffness : softer->robot.stiffness_Nm_rad) stiffness *= base_share;
  out.base = softer;
  return out;
}

PayloadConfig true_payload(const PayloadConfig& payload, std::uint64_t seed) {
  PayloadConfig out = payload;
  const double share = Random(seed, "payload mass").uniform(0.6, 2.0);
  out.body.mass_kg *= share;
  for (double& inertia : out.body.inertia_kgm2) inertia *= share;
  return out;
}

AdapterParams true_adapter(std::uint64_t seed) {
  AdapterParams figures;
  Random pins(seed, "adapter");
  figures.friction = pins.uniform(0.05, 0.3);
  figures.stiffness_N_m = 1e4 * std::pow(20.0, pins.uniform(0.0, 1.0));
  figures.spring_N_m *= pins.uniform(0.8, 1.15);
  return figures;
}

Pose start_offset(const PayloadConfig& payload, std::uint64_t seed) {
  Random offset(seed, "start before the adapter");
  const double most_m = payload.start_lateral_m;
  const Vec3 shift{offset.uniform(-most_m, most_m), offset.uniform(-most_m, most_m), 0.0};
  const Vec3 axis{offset.gaussian(1.0), offset.gaussian(1.0), offset.gaussian(1.0)};
  const double tilt_rad = offset.uniform(0.0, payload.start_tilt_rad);
  return {shift, from_rotation_vector((tilt_rad / norm(axis)) * axis)};
}

}  // namespace liana::bench
