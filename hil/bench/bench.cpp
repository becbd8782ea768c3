#include "hil/bench/bench.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "hil/arm/arm_physics.hpp"
#include "hil/arm/light_arm.hpp"
#include "hil/bus/wall_clock.hpp"

namespace liana::bench {

namespace {

constexpr double kDegPerRad = 180.0 / 3.14159265358979323846;
constexpr double kStartSpread_rad = 0.5 / kDegPerRad;

TrueParameters parameters_of(const BenchOptions& options) {
  return options.spread ? spread_parameters(options.robot, options.physics, options.seed)
                        : table_parameters(options.robot, options.physics);
}

std::unique_ptr<Arm> make_arm(const BenchOptions& options, const TrueParameters& truth) {
  const Theta start = start_pose(options.robot, options.start_pose,
                                 options.spread && !options.fixture ? kStartSpread_rad : 0.0, options.seed);
  if (options.arm == "light") return std::make_unique<LightArm>(options.robot, truth, start);
  if (options.arm != "full")
    throw std::runtime_error("--arm: \"" + options.arm + "\" is no arm model; allowed are full, light");
  auto arm = std::make_unique<ArmPhysics>(options.robot, options.scene, truth, start);
  arm->set_state(start, Theta{});  // the extremes of slot 0 are those of the laid-out cables
  return arm;
}

}  // namespace

Bench::Bench(const BenchOptions& options)
    : options_(options),
      truth_(parameters_of(options)),
      arm_(make_arm(options, truth_)),
      drives_(options.robot, options.buses, truth_, arm_->payouts_m(), options.spread, options.seed,
              options.cross_wired),
      injector_(options.faults),
      camera_(options.scene.camera, options.scene.slit_frame, options.scene.rod.pose, options.seed),
      link_(options.api_socket),
      log_(options.truth_path, options.robot.theta_count()),
      syncs_(options.buses.names.size(), 0),
      received_(options.buses.names.size(), 0),
      sent_(options.buses.names.size(), 0) {
  drives_.measure(motor_tensions_N());
}

CableValues Bench::motor_tensions_N() const {
  CableValues tension{};
  for (std::size_t c = 0; c < drives_.size(); ++c) tension[c] = arm_->motor_tension_N(c);
  return tension;
}

// State at the start of a slot goes to truth and camera before anything in the slot happens.
void Bench::begin_slot(std::uint32_t slot, double now_s) {
  injector_.step(slot, arm_->theta_rad(), arm_->rate_rad_s(), drives_);
  record(slot);
  camera_.look(now_s, arm_->tip());
  while (const auto view = camera_.deliver(now_s)) link_.send(camera_message(*view));
  begun_ = slot + 1;
}

void Bench::record(std::uint32_t slot) {
  const LoadRecord loads = arm_->take_record();
  const Clearance gap = arm_->clearance();
  const Pose tip = arm_->tip();
  std::vector<double> row{static_cast<double>(slot)};
  for (std::size_t i = 0; i < options_.robot.theta_count(); ++i) row.push_back(kDegPerRad * arm_->theta_rad()[i]);
  const Vec3& p = tip.position_m;
  const Quat& q = tip.attitude;
  for (const double value :
       {p.x, p.y, p.z, q.w, q.x, q.y, q.z, std::min(gap.slit_m, gap.sphere_m), gap.slit_m, gap.sphere_m,
        loads.contact_N, loads.rod_N, loads.least_tension_N, loads.least_motor_tension_N, loads.most_motor_tension_N,
        static_cast<double>(drives_.enabled())})
    row.push_back(value);
  log_.write(row);
}

void Bench::integrate_slot(double period_s) {
  const auto steps = static_cast<int>(std::ceil(period_s / arm_->longest_step_s() - 1e-9));
  const double step_s = period_s / steps;
  const std::uint64_t start_us = wall_clock_us();
  arm_->begin_slot(period_s);
  for (int i = 0; i < steps; ++i) {
    drives_.move(step_s, motor_tensions_N());
    arm_->step(step_s, drives_.payouts_m());
  }
  drives_.measure(motor_tensions_N());
  ++integrated_;
  physics_us_ += wall_clock_us() - start_us;
}

void Bench::catch_up(std::uint32_t slots, double period_s) {
  while (integrated_ < slots) {
    if (begun_ == integrated_) begin_slot(integrated_, integrated_ * period_s);
    integrate_slot(period_s);
  }
}

// Real time: a SYNC on every bus ends a slot; one that is missing on a bus ends it with the next SYNC of the others.
// Without any SYNC slots go on by the clock, one per wake-up: a bench that was stopped makes up for nothing.
std::uint32_t Bench::count_syncs(const FrameList& frames, std::uint64_t now_us, std::uint32_t period_us) {
  const std::vector<std::uint32_t> before = syncs_;
  for (const CanFrame& frame : frames)
    if (frame.id == 0x080) ++syncs_[frame.bus];
  const std::uint64_t patience_us = period_us + period_us / 2;
  if (syncs_ != before) {
    last_slot_us_ = now_us;
  } else if (now_us > last_slot_us_ + patience_us) {
    std::fill(syncs_.begin(), syncs_.end(), integrated_ + 1);
    last_slot_us_ = std::max(last_slot_us_ + period_us, now_us - patience_us);
  }
  const std::uint32_t most = *std::max_element(syncs_.begin(), syncs_.end());
  const std::uint32_t least = *std::min_element(syncs_.begin(), syncs_.end());
  if (least == most) return most;
  if (most - least > 1) std::fill(syncs_.begin(), syncs_.end(), most);
  return most - 1;
}

void Bench::run(Bus& bus) {
  const double period_s = 1e-6 * bus.period_us();
  Wake wake;
  FrameList out;
  bool first = true;
  while (bus.wait(wake)) {
    // lianad has said HELLO by now, so its API listens; later this is tried only when a picture is due.
    if (first) link_.connect(2000);
    first = false;
    wake.frames.erase(std::remove_if(wake.frames.begin(), wake.frames.end(),
                                     [&](const CanFrame& f) { return f.bus >= received_.size(); }),
                      wake.frames.end());
    for (const CanFrame& frame : wake.frames) ++received_[frame.bus];
    const std::uint32_t slot = bus.lockstep() ? wake.slot : integrated_;
    catch_up(slot, period_s);
    if (begun_ == slot) begin_slot(slot, slot * period_s);
    out.clear();
    drives_.exchange(wake.frames, wake.now_us, out);
    for (const CanFrame& frame : out) ++sent_[frame.bus];
    bus.send(out);
    catch_up(bus.lockstep() ? slot + 1 : count_syncs(wake.frames, wake.now_us, bus.period_us()), period_s);
  }
  run_on(wake.now_us, bus.period_us());
  log_.flush();
  write_summary(bus);
}

// The wires are dead, the drives are not: truth shows how they stop the arm. What they send reaches nobody.
void Bench::run_on(std::uint64_t now_us, std::uint32_t period_us) {
  const double period_s = 1e-6 * period_us;
  const auto slots = static_cast<std::uint32_t>(std::lround(options_.run_on_s / period_s));
  FrameList unheard;
  for (std::uint32_t i = 0; i < slots; ++i) {
    now_us += period_us;
    if (begun_ == integrated_) record(begun_++);
    drives_.exchange({}, now_us, unheard);
    integrate_slot(period_s);
  }
}

void Bench::write_summary(const Bus& bus) const {
  if (options_.summary_path.empty()) return;
  nlohmann::json drives = nlohmann::json::array();
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    const DriveCounts c = drives_.drive(i).counts();
    drives.push_back({{"node", drives_.drive(i).node()},
                      {"received", c.received},
                      {"sent", c.sent},
                      {"syncs", c.syncs},
                      {"rpdos", c.rpdos},
                      {"emergencies", c.emergencies},
                      {"quick_stops", c.quick_stops},
                      {"sdo_aborts", c.sdo_aborts},
                      {"statusword", drives_.drive(i).statusword()}});
  }
  nlohmann::json buses = nlohmann::json::array();
  for (std::size_t b = 0; b < received_.size(); ++b)
    buses.push_back({{"name", options_.buses.names[b]}, {"received", received_[b]}, {"sent", sent_[b]}});
  nlohmann::json faults = nlohmann::json::array();
  for (std::size_t i = 0; i < injector_.faults().size(); ++i) {
    const auto& [begun, ended] = injector_.courses()[i];
    const FaultConfig& fault = injector_.faults()[i];
    faults.push_back(
        {{"kind", fault.name}, {"drives", fault.drives}, {"begun_slot", nullptr}, {"ended_slot", nullptr}});
    if (begun) faults.back()["begun_slot"] = *begun;
    if (ended) faults.back()["ended_slot"] = *ended;
  }
  const ArmCounts counts = arm_->counts();
  const nlohmann::json summary{
      {"slots", integrated_},
      {"seed", options_.seed},
      {"arm", options_.arm},
      {"physics", options_.physics},
      {"drives", drives},
      {"faults", faults},
      {"buses", buses},
      {"frames_refused", bus.refused()},
      {"mujoco_warnings", counts.mujoco_warnings},
      {"slots_near_contact", counts.contact_slots},
      {"friction_sweeps_max", counts.most_sweeps},
      {"camera_sent", link_.sent()},
      {"camera_lost", link_.lost()},
      {"true_parameters", {{"EA_N", truth_.EA_N}, {"mu", truth_.mu}, {"hole_radius_m", truth_.hole_radius_m}}},
      {"measured", {{"physics_us_per_slot", integrated_ == 0 ? 0.0 : static_cast<double>(physics_us_) / integrated_}}}};
  std::ofstream file(options_.summary_path);
  file << summary.dump(1) << '\n';
  if (!file) throw std::runtime_error("--summary: " + options_.summary_path + " cannot be written; check the folder");
}

}  // namespace liana::bench
