#include "plant.hpp"

#include <cmath>

#include "hil/arm/arm_physics.hpp"
#include "hil/math/random.hpp"

namespace liana::closed_loop {
namespace {

constexpr double kPhysicsStep_s = 0.001;
constexpr double kTorqueNoise = 0.003;                   // of the reading, as the bench's drives
constexpr double kStartSpread_rad = 8.7266462599716e-3;  // 0.5 deg (mission, A8)

bench::TrueParameters parameters(const bench::RobotConfig& robot, const PlantSetup& setup) {
  bench::TrueParameters truth = setup.spread ? bench::spread_parameters(robot, setup.physics, setup.seed)
                                             : bench::table_parameters(robot, setup.physics);
  truth.gravity_m_s2 = robot.gravity_m_s2;
  return truth;
}

bench::RobotConfig built(const PlantSetup& setup) {
  const std::string data = CLOSED_LOOP_DATA;
  bench::RobotConfig table = bench::load_robot(setup.robot_file.empty() ? data + "/robot.json" : setup.robot_file);
  if (setup.mounted_m_s2) {
    const Vec3& g_m_s2 = *setup.mounted_m_s2;
    table.gravity_m_s2 = {g_m_s2[0], g_m_s2[1], g_m_s2[2]};
  }
  bench::Random geometry(setup.seed, "closed loop geometry");
  const auto drawn = [&] { return 1.0 + setup.geometry_share * geometry.uniform(-1.0, 1.0); };
  for (bench::SegmentConfig& segment : table.segments) segment.module_length_m *= drawn();
  const double radius = drawn();
  for (bench::SegmentConfig& segment : table.segments) segment.hole_radius_m *= radius;
  return setup.spread ? bench::spread_load(table, setup.seed) : table;
}

bench::SceneConfig scene_of(const PlantSetup& setup) {
  const std::string data = CLOSED_LOOP_DATA;
  return bench::load_scene(data + (setup.robot_file.empty() ? "/scene.json" : "/empty.json"));
}

}  // namespace

struct Plant::Parts {
  bench::RobotConfig robot;
  bench::TrueParameters truth;
  bench::ArmPhysics arm;
  cable::CableVector drum_m;     // unstretched length that each drum holds
  cable::CableVector loose_m{};  // off the drum, beside what it holds
  cable::CableVector scatter_N{};
  std::array<bool, cable::kMaxCables> lost{}, stands{};
  bool noisy;
  bench::Random noise;
  bench::Random fault_noise;

  Parts(const bench::RobotConfig& table, const PlantSetup& setup)
      : robot(table),
        truth(parameters(table, setup)),
        arm(table, scene_of(setup), truth,
            bench::start_pose(table, setup.start_pose, setup.spread ? kStartSpread_rad : 0.0, setup.seed)),
        drum_m(arm.payouts_m()),
        noisy(setup.spread),
        noise(setup.seed, "closed loop torque noise"),
        fault_noise(setup.seed, "closed loop fault noise") {
    for (std::size_t c = 0; c < robot.drive_count(); ++c) truth.zero_offset_m[c] -= setup.zero_m[c];
  }
};

Plant::Plant(const PlantSetup& setup) : parts_(std::make_unique<Parts>(built(setup), setup)) {}
Plant::~Plant() = default;

cable::CableVector Plant::measured_payout_m() const {
  cable::CableVector payout{};
  for (std::size_t c = 0; c < parts_->robot.drive_count(); ++c)
    payout[c] = parts_->drum_m[c] - parts_->truth.zero_offset_m[c];
  return payout;
}

cable::CableVector Plant::measured_tension_N() {
  cable::CableVector tension{};
  for (std::size_t c = 0; c < parts_->robot.drive_count(); ++c) {
    const double noise = parts_->noisy ? parts_->noise.gaussian(kTorqueNoise) : 0.0;
    tension[c] = parts_->arm.motor_tension_N(c) * parts_->truth.torque_gain[c] * (1.0 + noise);
    if (parts_->scatter_N[c] > 0.0) tension[c] += parts_->fault_noise.gaussian(parts_->scatter_N[c]);
    if (parts_->lost[c]) tension[c] = 0.0;
  }
  return tension;
}

void Plant::advance(double tick_s, const cable::CableVector& target_m, bool powered) {
  const double share = powered ? -std::expm1(-kPhysicsStep_s / parts_->robot.servo_time_constant_s) : 0.0;
  parts_->arm.begin_slot(tick_s);
  const long steps = std::lround(tick_s / kPhysicsStep_s);
  for (long i = 0; i < steps; ++i) {
    for (std::size_t c = 0; c < parts_->robot.drive_count(); ++c) {
      if (parts_->stands[c]) continue;
      const double target = target_m[c] + parts_->truth.zero_offset_m[c];
      parts_->drum_m[c] += share * (target - parts_->drum_m[c]);
    }
    cable::CableVector payout_m = parts_->drum_m;
    for (std::size_t c = 0; c < parts_->robot.drive_count(); ++c) payout_m[c] += parts_->loose_m[c];
    parts_->arm.step(kPhysicsStep_s, payout_m);
  }
}

const cable::ThetaVector& Plant::theta_rad() const { return parts_->arm.theta_rad(); }
const cable::ThetaVector& Plant::rate_rad_s() const { return parts_->arm.rate_rad_s(); }
double Plant::friction_mu() const { return parts_->truth.mu; }
double Plant::module_length_m(std::size_t segment) const { return parts_->robot.segments[segment].module_length_m; }

Pose Plant::tip_in_base() const {
  const bench::Pose tip = parts_->arm.tip();
  return {{tip.position_m.x, tip.position_m.y, tip.position_m.z},
          {tip.attitude.w, tip.attitude.x, tip.attitude.y, tip.attitude.z}};
}

double Plant::kinetic_energy_J() {
  bench::ThetaMatrix mass;
  parts_->arm.chain().inertia(mass);
  const cable::ThetaVector& rate = rate_rad_s();
  double energy = 0.0;
  for (std::size_t a = 0; a < parts_->robot.theta_count(); ++a)
    for (std::size_t b = 0; b < parts_->robot.theta_count(); ++b) energy += 0.5 * mass[a][b] * rate[a] * rate[b];
  return energy;
}

double Plant::slit_clearance_m() const { return parts_->arm.clearance().slit_m; }
double Plant::sphere_clearance_m() const { return parts_->arm.clearance().sphere_m; }

Load Plant::take_load() {
  const bench::LoadRecord record = parts_->arm.take_record();
  return {record.contact_N, record.least_tension_N, record.min_motor_tension_N, record.max_motor_tension_N};
}

void Plant::loosen(std::size_t cable, double length_m) { parts_->loose_m[cable] += length_m; }
void Plant::jump_encoder(std::size_t cable, double length_m) { parts_->truth.zero_offset_m[cable] -= length_m; }
void Plant::scatter(std::size_t cable, double deviation_N) { parts_->scatter_N[cable] = deviation_N; }

void Plant::lose_reading(std::size_t cable) { parts_->lost[cable] = true; }
void Plant::find_reading(std::size_t cable) { parts_->lost[cable] = false; }

void Plant::stand_still(std::size_t cable) { parts_->stands[cable] = true; }

void Plant::kick(const cable::ThetaVector& rate_rad_s) { parts_->arm.set_state(parts_->arm.theta_rad(), rate_rad_s); }
void Plant::push(std::size_t link, const Vec3& force_N) {
  parts_->arm.set_pushes({{link, {force_N[0], force_N[1], force_N[2]}}});
}
void Plant::set_joint_damping(double viscous_Nms_per_rad) { parts_->arm.set_joint_damping(viscous_Nms_per_rad); }

}  // namespace liana::closed_loop
