#include "hil/payload/torque_plant.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "hil/payload/payload_equipment.hpp"
#include "hil/payload/payload_faults.hpp"
#include "hil/payload/true_payload.hpp"
#include "hil/serial/serial_plant.hpp"

namespace liana::bench {

namespace {

constexpr double kBeforeSocket_m = 0.1;  // farther beside the axis the pins have no depth

// Where the arm that carries is while the payload is fetched; nothing where it is locked for good.
std::optional<std::vector<double>> fetch_rad(const SerialRobotConfig& robot, const SceneConfig& scene) {
  if (!robot.base || !scene.payload || scene.payload->on_arm || scene.payload->fetch_pose.empty()) return std::nullopt;
  const auto& poses = robot.base->robot.named_poses_rad;
  const auto found = poses.find(scene.payload->fetch_pose);
  if (found == poses.end())
    throw std::runtime_error("scene: payload.fetch_pose: \"" + scene.payload->fetch_pose +
                             "\" is no named pose of the arm that carries: name one of its named_poses_deg");
  if (robot.base->carry_s <= 0.0)
    throw std::runtime_error(
        "robot: base.carry_s: is missing: the scene fetches its payload at another pose; say how "
        "long the arm that carries takes from there");
  return found->second;
}

SerialRobotConfig as_it_begins(const SerialRobotConfig& robot, const SceneConfig& scene) {
  const auto from_rad = fetch_rad(robot, scene);
  if (!from_rad) return robot;
  SerialRobotConfig out = robot;
  auto base = std::make_shared<LockedBaseConfig>(*robot.base);
  base->joint_rad = *from_rad;
  out.base = base;
  return out;
}

TrueArm drawn_arm(const SerialRobotConfig& robot, const ModelOptions& options, std::uint64_t seed) {
  TrueArm arm = true_arm(robot, options.start_pose, options.spread, options.fixture, seed);
  if (options.spread) arm.robot = true_joints(arm.robot, seed);
  return arm;
}

// Sensor and adapter are on the second bus, with the drives next to the tip; on the only one where there is one.
std::uint8_t bus_of_nodes(const BusesConfig& buses) { return buses.names.size() > 1 ? 1 : 0; }

}  // namespace

TorquePlant::TorquePlant(const SerialRobotConfig& robot, const SceneConfig& scene, const BusesConfig& buses,
                         const ModelOptions& options, const std::vector<FaultConfig>& faults, std::uint64_t seed)
    : scene_(scene),
      spread_(options.spread),
      arm_(drawn_arm(as_it_begins(robot, scene), options, seed)),
      chain_(arm_.robot, arm_.start_rad),
      base_at_rest_(chain_.base().pose),
      drives_(arm_, buses, options.spread, seed),
      rotors_(robot.joints.size()),
      sensor_(bus_of_nodes(buses), options.spread, seed),
      adapter_node_(bus_of_nodes(buses)) {
  refuse_for_serial(options);
  refuse(faults);
  if (const auto from_rad = fetch_rad(robot, scene))
    way_ = CarryTravel{*from_rad, robot.base->joint_rad, robot.base->carry_s};
  if (scene.payload) make_site(scene, seed);
  drives_.measure(chain_);
}

void TorquePlant::refuse(const std::vector<FaultConfig>& faults) const {
  refuse_for_serial(faults);
  if (!scene_.payload) refuse_payload_faults(faults, "; the scene has none");
}

// A payload that begins on the arm is before the adapter as the table has it, whatever else the arm truly is: the
// adapter stands there.
void TorquePlant::make_site(const SceneConfig& scene, std::uint64_t seed) {
  PayloadConfig payload = spread_ ? true_payload(*scene.payload, seed) : *scene.payload;
  const Pose plate{{0.0, 0.0, payload.length_m}, {}};
  Pose socket = compose(way_ ? chain_.base_when_at(way_->to_rad) : base_at_rest_, scene.adapter->pose);
  if (payload.on_arm) {
    const Pose socket_in_plate = relative(compose(payload.pose, plate), scene.adapter->pose);
    const Pose beside = spread_ ? start_offset(payload, seed) : Pose{};
    socket = compose(compose(compose(chain_.tip().pose, plate), beside), socket_in_plate);
  }
  payload.pose = compose(base_at_rest_, payload.pose);
  site_.emplace(payload, socket, spread_ ? true_adapter(seed) : AdapterParams{});
  if (payload.on_arm) chain_.carry(site_->take(chain_.tip().pose));
}

std::unique_ptr<TipEquipment> TorquePlant::make_equipment(const SceneConfig& scene, std::uint64_t seed) {
  if (!site_) return nullptr;
  return std::make_unique<PayloadEquipment>(scene.camera, *this, spread_, seed);
}

void TorquePlant::take_payload() { chain_.carry(site_->take(chain_.tip().pose)); }

void TorquePlant::let_go_of_payload() {
  site_->let_go(chain_.tip().pose);
  chain_.carry({});
}

void TorquePlant::carry_base(double share) {
  way_->share = share;
  std::vector<double> told_rad = way_->to_rad;
  for (std::size_t i = 0; i < told_rad.size(); ++i)
    told_rad[i] = way_->from_rad[i] + share * (way_->to_rad[i] - way_->from_rad[i]);
  chain_.lead_base(told_rad);
  base_at_rest_ = chain_.base_when_at(told_rad);
}

std::vector<double> TorquePlant::joints_rad() const {
  std::vector<double> joints(chain_.joints());
  for (std::size_t i = 0; i < joints.size(); ++i) joints[i] = chain_.joint_rad(i);
  return joints;
}

void TorquePlant::inject(std::uint32_t slot, FaultInjector& injector) {
  std::vector<double> rates(chain_.joints());
  for (std::size_t i = 0; i < rates.size(); ++i) rates[i] = chain_.joint_rate_rad_s(i);
  const std::vector<double> joints = joints_rad();
  TrueMotion motion{joints, rates};
  if (site_) {
    const Vec3 plate = site_->plate_in_socket(chain_.tip().pose).position_m;
    if (site_->holder() == Holder::kArm && std::hypot(plate.x, plate.y) < kBeforeSocket_m) motion.depth_m = plate.z;
    motion.contact_N = norm(contact_N_);
    motion.captured = site_->adapter().captured();
    motion.carried = way_ ? way_->share : 0.0;
  }
  injector.step(slot, motion, drives_);
  sensor_.suffer(wrist_defects(injector));
  if (!site_) return;
  adapter_node_.suffer(capture_defects(injector));
  spoil_adapter(injector, site_->adapter());
  const Vec3 moved = base_step_m(injector, slot);
  if (norm(moved) > 0.0) site_->shift(rotate(base_at_rest_.attitude, -1.0 * moved));
}

double TorquePlant::fastest_rad_s() const {
  double fastest = 0.0;
  for (std::size_t i = 0; i < chain_.joints(); ++i) fastest = std::max(fastest, std::fabs(chain_.joint_rate_rad_s(i)));
  return fastest;
}

void TorquePlant::exchange(const FrameList& frames, std::uint64_t now_us, FrameList& out) {
  drives_.exchange(frames, now_us, out);
  sensor_.exchange(frames, now_us, wrist_load_, out);
  if (site_) adapter_node_.exchange(frames, now_us, site_->adapter(), out);
}

TipLoad TorquePlant::meet(const TipState& tip) {
  if (!site_) return {};
  const Vec3& force = contact_N_ = site_->adapter_load(tip).force_N;
  contact_peak_N_ = std::max(contact_peak_N_, norm(force));
  peaks_.contact_N = std::max(peaks_.contact_N, norm(force));
  peaks_.lateral_N = std::max(peaks_.lateral_N, std::hypot(force.x, force.y));
  return site_->push(tip);
}

void TorquePlant::step_physics(double step_s) {
  chain_.step(step_s, rotors_, [this](const TipState& tip) { return meet(tip); });
  for (std::size_t i = 0; i < chain_.joints(); ++i)
    peaks_.joint_Nm = std::max(peaks_.joint_Nm, std::fabs(chain_.gear_Nm(i)));
  elapsed_s_ += step_s;
  if (!site_) return;
  site_->step(step_s, chain_.tip());
  for (const double depth_m : site_->adapter().depth_m())
    if (site_->holder() == Holder::kArm) peaks_.insertion_m = std::max(peaks_.insertion_m, depth_m);
  if (site_->adapter().captured() && !captured_s_) captured_s_ = elapsed_s_;
}

void TorquePlant::integrate(double period_s) {
  const auto loops = std::max(1, static_cast<int>(std::lround(period_s / TorqueDrives::kLoop_s)));
  const auto steps = static_cast<int>(std::ceil(period_s / loops / FlexibleChain::kStep_s - 1e-9));
  TipLoad sum;
  for (int loop = 0; loop < loops; ++loop) {
    drives_.act(chain_, rotors_);
    for (int i = 0; i < steps; ++i) {
      step_physics(period_s / loops / steps);
      sum.force_N = sum.force_N + chain_.wrist().force_N;
      sum.torque_Nm = sum.torque_Nm + chain_.wrist().torque_Nm;
    }
  }
  const double share = 1.0 / (loops * steps);
  wrist_load_ = {share * sum.force_N, share * sum.torque_Nm};
  if (!way_ || way_->share == 0.0 || way_->share == 1.0) peaks_.base_m = std::max(peaks_.base_m, base_deflection_m());
  drives_.measure(chain_);
}

double TorquePlant::base_deflection_m() const { return norm(chain_.base().pose.position_m - base_at_rest_.position_m); }

}  // namespace liana::bench
