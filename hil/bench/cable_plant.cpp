#include "hil/bench/cable_plant.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "hil/arm/arm_physics.hpp"
#include "hil/arm/kinematic_arm.hpp"
#include "hil/bench/pushes.hpp"

namespace liana::bench {

namespace {

constexpr double kGravity_m_s2 = 9.80665;  // standard gravity, ISO 80000-3
constexpr double kStartSpread_rad = 0.5 / kDegPerRad;

// Drives of a base move no cable: `what` asks for one.
void require_cable(const RobotConfig& robot, std::size_t drive, const std::string& what) {
  if (drive >= robot.base_drives()) return;
  const std::string number = std::to_string(drive + 1);
  throw std::runtime_error(what + " needs a cable, but drive " + number + " (node " + number +
                           ", segment 1) moves the " + (drive == 0 ? "slide" : "roll") +
                           " of the base; name drives of cables, " + std::to_string(robot.base_drives() + 1) + " to " +
                           std::to_string(robot.drive_count()));
}

// And the other way round; the light arm's base feels no force.
void require_base(const RobotConfig& robot, std::size_t drive, const std::string& arm, const std::string& what) {
  if (drive >= robot.base_drives())
    throw std::runtime_error(what + " needs a drive of a base that feeds, but drive " + std::to_string(drive + 1) +
                             " moves a cable" + (robot.base ? "; allowed are 1 and 2" : "; this arm has no such base"));
  if (arm == "light") throw std::runtime_error(what + ": the light arm's base feels no force; give --arm full");
}

void refuse_cables_of_base(const RobotConfig& robot, const BusesConfig& buses, const ModelOptions& options) {
  for (const std::size_t drive : options.cross_wired) require_cable(robot, drive, "--cross-wired");
  for (const LoadCellNodeConfig& node : buses.load_cells)
    for (const std::size_t cable : node.cables)
      require_cable(robot, cable, "bus table: load cell of node " + std::to_string(node.node));
}

TrueParameters parameters_of(const RobotConfig& robot, const ModelOptions& options, std::uint64_t seed) {
  TrueParameters truth =
      options.spread ? spread_parameters(robot, options.physics, seed) : table_parameters(robot, options.physics);
  truth.gravity_m_s2 = robot.gravity_m_s2;
  truth.gravity_m_s2.z -= kGravity_m_s2 * options.gravity_share;
  truth.linkage = uneven_linkage(robot, options.linkage_error, seed);
  return truth;
}

std::unique_ptr<Arm> make_arm(const RobotConfig& robot, const SceneConfig& scene, const ModelOptions& options,
                              std::uint64_t seed, const TrueParameters& truth) {
  const double spread_rad = options.spread && !options.fixture ? kStartSpread_rad : 0.0;
  const Theta start = start_pose(robot, options.start_pose, spread_rad, seed);
  if (options.arm == "light") return std::make_unique<KinematicArm>(robot, truth, start);
  if (options.arm != "full")
    throw std::runtime_error("--arm: \"" + options.arm + "\" is no arm model; allowed are full, light");
  auto arm = std::make_unique<ArmPhysics>(robot, scene, truth, start);
  arm->set_free_step(options.free_step_s);
  arm->set_state(start, Theta{});  // the extremes of slot 0 are those of the laid-out cables
  return arm;
}

}  // namespace

CablePlant::CablePlant(const RobotConfig& robot, const SceneConfig& scene, const BusesConfig& buses,
                       const ModelOptions& options, const std::vector<FaultConfig>& faults, std::uint64_t seed)
    : thetas_(robot.theta_count()),
      links_(robot.link_count()),
      scene_(scene),
      options_(options),
      built_(options.spread ? spread_load(robot, seed) : robot),
      truth_(parameters_of(built_, options, seed)),
      arm_(make_arm(built_, scene, options, seed, truth_)),
      drives_(robot, buses, truth_, arm_->payouts_m(), options.spread, seed, options.cross_wired),
      load_cells_(buses, options.spread, seed),
      tip_before_m_(arm_->tip().position_m) {
  refuse_cables_of_base(robot, buses, options);
  refuse(faults);
  drives_.measure(motor_tensions_N());
}

void CablePlant::refuse(const std::vector<FaultConfig>& faults) const {
  refuse_payload_faults(faults, ", and this is a cable arm");
  for (const FaultConfig& fault : faults) {
    const std::string what = "--faults: kind \"" + fault.name + "\"";
    for (const std::size_t drive : fault.drives) {
      if (fault_of(fault.kind) == FaultOf::kCable && fault.kind != FaultKind::kMotorSaturation)
        require_cable(built_, drive, what);
      if (fault_of(fault.kind) == FaultOf::kBase) require_base(built_, drive, options_.arm, what);
    }
  }
  load_cells_.refuse_faults_of_others(faults);
  check_pushes(faults, links_, options_.arm);
}

CableValues CablePlant::motor_tensions_N() const {
  CableValues tension{};
  for (std::size_t c = 0; c < drives_.size(); ++c) tension[c] = arm_->motor_tension_N(c);
  return tension;
}

void CablePlant::inject(std::uint32_t slot, FaultInjector& injector) {
  injector.step(slot, {arm_->theta_rad(), arm_->rate_rad_s(), depth_m()}, drives_);
  load_cells_.suffer(injector.faults(), [&injector](std::size_t fault) { return injector.is_on(fault); });
  arm_->set_pushes(pushes_at(slot, injector, links_));
  for (std::size_t drive = 0; drive < built_.base_drives(); ++drive)
    arm_->set_jammed(drive, injector.has(FaultKind::kJammed, drive));
}

double CablePlant::fastest_rad_s() const {
  double fastest = 0.0;
  for (std::size_t i = 0; i < thetas_; ++i) fastest = std::max(fastest, std::fabs(arm_->rate_rad_s()[i]));
  return fastest;
}

void CablePlant::exchange(const FrameList& frames, std::uint64_t now_us, FrameList& out) {
  drives_.exchange(frames, now_us, out);
  load_cells_.exchange(frames, now_us, motor_tensions_N(), out);
}

void CablePlant::integrate(double period_s) {
  arm_->begin_slot(period_s);
  const auto steps = static_cast<int>(std::ceil(period_s / arm_->longest_step_s() - 1e-9));
  const double step_s = period_s / steps;
  for (int i = 0; i < steps; ++i) {
    drives_.move(step_s, motor_tensions_N());
    arm_->step(step_s, drives_.payouts_m());
  }
  drives_.measure(motor_tensions_N());
  since_s_ += period_s;
}

std::vector<std::string> CablePlant::truth_columns() const {
  std::vector<std::string> columns;
  for (std::size_t i = 1; i <= thetas_; ++i) columns.push_back("theta_deg_" + std::to_string(i));
  for (const char* name :
       {"tip_x_m", "tip_y_m", "tip_z_m", "tip_qw", "tip_qx", "tip_qy", "tip_qz", "clearance_m", "slit_clearance_m",
        "sphere_clearance_m", "contact_force_N", "rod_force_N", "tension_min_N", "tension_motor_min_N",
        "tension_motor_max_N", "enabled", "tip_speed_m_s", "fastest_deg_s", "slit_depth_m"})
    columns.emplace_back(name);
  return columns;
}

void CablePlant::add_truth(std::vector<double>& row) {
  const LoadRecord loads = arm_->take_record();
  const Clearance gap = arm_->clearance();
  const Pose tip = arm_->tip();
  for (std::size_t i = 0; i < thetas_; ++i) row.push_back(kDegPerRad * arm_->theta_rad()[i]);
  const Vec3& p = tip.position_m;
  const Quat& q = tip.attitude;
  for (const double value :
       {p.x, p.y, p.z, q.w, q.x, q.y, q.z, std::min({gap.slit_m, gap.sphere_m, gap.convex_m}), gap.slit_m, gap.sphere_m,
        loads.contact_N, loads.rod_N, loads.least_tension_N, loads.min_motor_tension_N, loads.max_motor_tension_N,
        static_cast<double>(drives_.enabled()), since_s_ > 0.0 ? norm(p - tip_before_m_) / since_s_ : 0.0,
        kDegPerRad * fastest_rad_s(), depth_m()})
    row.push_back(value);
  tip_before_m_ = p;
  since_s_ = 0.0;
}

void CablePlant::summarise(nlohmann::json& summary) const {
  const ArmCounts counts = arm_->counts();
  summary["arm"] = options_.arm;
  summary["physics"] = options_.physics;
  summary["mujoco_warnings"] = counts.mujoco_warnings;
  summary["slots_near_contact"] = counts.contact_slots;
  summary["friction_sweeps_max"] = counts.max_sweeps;
  summary["true_parameters"] = {{"EA_N", truth_.EA_N},
                                {"mu", truth_.mu},
                                {"hole_radius_error_m", truth_.hole_radius_error_m},
                                {"gravity_m_s2", {truth_.gravity_m_s2.x, truth_.gravity_m_s2.y, truth_.gravity_m_s2.z}},
                                {"linkage_error", options_.linkage_error}};
}

}  // namespace liana::bench
