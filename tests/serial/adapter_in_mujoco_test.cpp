// The adapter against MuJoCo's contacts: three capsules in holes of eight boxes each, a hard stop. Impacts differ by
// the engine's own stiffness; what is held at the end must not.
#include <gtest/gtest.h>

#include <cmath>
#include <iomanip>
#include <sstream>

#include "hil/arm/mujoco_model.hpp"
#include "tests/serial/sliding_plate.hpp"

namespace liana::bench {
namespace {

constexpr double kPinRadius_m = 0.010, kStep_s = 0.0005;

// The plate slides along x, y, z, damped and with the capture spring; z is the depth of the pins' tips.
std::string model_text(const AdapterParams& figures, double mass_kg, double damping_Ns_m) {
  std::ostringstream out;
  out << std::setprecision(12) << "<mujoco><option gravity='0 0 0' timestep='" << kStep_s << "'/><worldbody>";
  out << "<geom type='box' size='0.4 0.4 0.05' pos='0 0 " << figures.stop_m + 0.05 << "'/>";
  std::ostringstream pins;
  for (int pin = 0; pin < 3; ++pin) {
    const double angle = 2.0 * M_PI * pin / 3.0, x = figures.circle_m * std::cos(angle),
                 y = figures.circle_m * std::sin(angle);
    pins << "<geom type='capsule' size='" << kPinRadius_m << "' fromto='" << x << ' ' << y << ' ' << -0.1 << ' ' << x
         << ' ' << y << ' ' << -kPinRadius_m << "'/>";
    for (int wall = 0; wall < 8; ++wall) {
      const double at = 45.0 * wall, away = kPinRadius_m + figures.full_m + 0.01;
      out << "<geom type='box' size='0.01 0.02 0.011' pos='" << x + away * std::cos(at * M_PI / 180.0) << ' '
          << y + away * std::sin(at * M_PI / 180.0) << " 0.011' euler='0 0 " << at << "'/>";
    }
  }
  out << "<body name='plate'><joint type='slide' axis='1 0 0' damping='" << damping_Ns_m
      << "'/><joint type='slide' axis='0 1 0' damping='" << damping_Ns_m
      << "'/><joint type='slide' axis='0 0 1' damping='" << damping_Ns_m << "' stiffness='" << figures.spring_N_m
      << "'/><inertial pos='0 0 0' mass='" << mass_kg << "' diaginertia='80 80 80'/>" << pins.str()
      << "</body></worldbody></mujoco>";
  return out.str();
}

// Mean force of all contacts on the plate over the last quarter of the time.
Vec3 held_in_mujoco_N(const AdapterParams& figures, const Vec3& push_N, double seconds) {
  const MujocoModel engine(model_text(figures, 500.0, 4000.0));
  mjData* const data = engine.data;
  data->qpos[2] = 0.005;
  const mjtNum push[3] = {push_N.x, push_N.y, push_N.z};
  const int steps = static_cast<int>(seconds / kStep_s);
  Vec3 sum;
  for (int step = 0; step < steps; ++step) {
    for (int k = 0; k < 3; ++k) data->qfrc_applied[k] = push[k];
    mj_step(engine.model, data);
    if (step < steps - steps / 4) continue;
    sum = sum + Vec3{data->qfrc_constraint[0], data->qfrc_constraint[1], data->qfrc_constraint[2]};
  }
  return (1.0 / (steps / 4)) * sum;
}

TEST(AdapterInMujoco, StopAndWallsHoldTheSameForces) {
  AdapterParams figures;
  figures.spring_friction_N = 0.0;  // MuJoCo's model has none
  for (const Vec3& push : {Vec3{0, 0, 30.0}, Vec3{6.0, -3.0, 35.0}}) {
    Adapter adapter(figures);
    adapter.break_latch();
    SlidingPlate plate{500.0, 4000.0, {0, 0, 0.005}};
    plate.run(adapter, push, 25.0);
    const Vec3 own = adapter.push(plate.state()).force_N;
    const Vec3 wall = own + Vec3{0, 0, figures.spring_N_m * plate.at_m.z};  // without the spring
    const Vec3 other = held_in_mujoco_N(figures, push, 25.0);
    EXPECT_NEAR(other.x, wall.x, 0.5);
    EXPECT_NEAR(other.y, wall.y, 0.5);
    EXPECT_NEAR(other.z, wall.z, 0.5);
    EXPECT_GT(std::fabs(wall.z), 5.0) << "the stop has something to hold";
  }
}

}  // namespace
}  // namespace liana::bench
