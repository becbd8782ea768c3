#include "hil/serial/serial_plant.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "hil/serial/link_axis.hpp"

namespace liana::bench {

namespace {

constexpr double kLongestStep_s = 0.001;  // of the position servos; their time constant is some tens of it
constexpr double kStribeck_rad_s = 1e-3;  // below this rate Coulomb friction fades
}  // namespace

void refuse_for_serial(const std::vector<FaultConfig>& faults) {
  refuse_faults(faults, {FaultOf::kCable, FaultOf::kBase, FaultOf::kBody},
                "happens to cables, base or body of a cable arm, and this is a serial one; allowed are the drives' own "
                "faults");
}

void refuse_for_serial(const ModelOptions& options) {
  if (options.gravity_share != 0.0 || options.linkage_error != 0.0)
    throw std::runtime_error("--gravity, --linkage-error: a serial arm's bench has neither; leave them out");
  if (!options.cross_wired.empty())
    throw std::runtime_error("--cross-wired: a serial arm has no cables to swap; leave it out");
}

SerialPlant::SerialPlant(const SerialRobotConfig& robot, const SceneConfig& scene, const BusesConfig& buses,
                         const ModelOptions& options, const std::vector<FaultConfig>& faults, std::uint64_t seed)
    : scene_(scene),
      arm_(true_arm(robot, options.start_pose, options.spread, options.fixture, seed)),
      chain_(arm_.robot),
      drives_(arm_, buses, options.spread, seed),
      torque_Nm_(robot.joints.size(), 0.0) {
  refuse_for_serial(options);
  refuse(faults);
  chain_.place(drives_.joint_rad());
  drives_.measure(torque_Nm_);
}

void SerialPlant::refuse(const std::vector<FaultConfig>& faults) const {
  refuse_for_serial(faults);
  refuse_payload_faults(faults, ": it needs torque drives and a scene with payload and adapter");
}

void SerialPlant::inject(std::uint32_t slot, FaultInjector& injector) {
  injector.step(slot, {drives_.joint_rad(), drives_.rate_rad_s()}, drives_);
}

double SerialPlant::fastest_rad_s() const {
  double fastest = 0.0;
  for (const double rate : drives_.rate_rad_s()) fastest = std::max(fastest, std::fabs(rate));
  return fastest;
}

void SerialPlant::exchange(const FrameList& frames, std::uint64_t now_us, FrameList& out) {
  drives_.exchange(frames, now_us, out);
}

double SerialPlant::friction_Nm(double rate_rad_s) const {
  return arm_.robot.coulomb_Nm * std::tanh(rate_rad_s / kStribeck_rad_s) + arm_.robot.viscous_Nms_per_rad * rate_rad_s;
}

void SerialPlant::integrate(double period_s) {
  const auto steps = static_cast<int>(std::ceil(period_s / kLongestStep_s - 1e-9));
  const std::vector<double> before = drives_.rate_rad_s();
  for (int i = 0; i < steps; ++i) drives_.move(period_s / steps);
  const std::vector<double> rate = drives_.rate_rad_s();
  std::vector<double> accel(rate.size());
  for (std::size_t i = 0; i < rate.size(); ++i) accel[i] = (rate[i] - before[i]) / period_s;
  chain_.place(drives_.joint_rad());
  torque_Nm_ = chain_.torque_Nm(rate, accel);
  for (std::size_t i = 0; i < rate.size(); ++i) torque_Nm_[i] += friction_Nm(rate[i]);
  drives_.measure(torque_Nm_);
}

std::vector<std::string> SerialPlant::truth_columns() const {
  std::vector<std::string> columns;
  for (std::size_t i = 1; i <= drives_.size(); ++i) columns.push_back("joint_deg_" + std::to_string(i));
  for (const char* name : {"tip_x_m", "tip_y_m", "tip_z_m", "tip_qw", "tip_qx", "tip_qy", "tip_qz"})
    columns.emplace_back(name);
  for (std::size_t i = 1; i <= drives_.size(); ++i) columns.push_back("torque_Nm_" + std::to_string(i));
  columns.emplace_back("enabled");
  if (has_bodies(scene_)) columns.emplace_back("clearance_m");
  return columns;
}

void SerialPlant::add_truth(std::vector<double>& row) {
  for (const double joint : drives_.joint_rad()) row.push_back(kDegPerRad * joint);
  const Pose pose = tip();
  const Vec3& p = pose.position_m;
  const Quat& q = pose.attitude;
  row.insert(row.end(), {p.x, p.y, p.z, q.w, q.x, q.y, q.z});
  row.insert(row.end(), torque_Nm_.begin(), torque_Nm_.end());
  row.push_back(static_cast<double>(drives_.enabled()));
  if (has_bodies(scene_)) row.push_back(clearance_m(chain_.axis_m(), scene_, arm_.robot.link_radius_m));
}

void SerialPlant::summarise(nlohmann::json& summary) const {
  nlohmann::json zeros = nlohmann::json::array();
  for (const double offset : arm_.zero_offset_rad) zeros.push_back(kDegPerRad * offset);
  summary["arm"] = "serial";
  summary["true_parameters"] = {{"zero_offset_deg", zeros}};
}

}  // namespace liana::bench
