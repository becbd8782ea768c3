#include "hil/bench/bench.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "hil/bench/cable_plant.hpp"
#include "hil/bench/rod_equipment.hpp"
#include "hil/bus/wall_clock.hpp"
#include "hil/payload/torque_plant.hpp"
#include "hil/serial/serial_plant.hpp"

namespace liana::bench {

namespace {

constexpr double kRest_rad_s = 0.1 * 3.14159265358979323846 / 180.0;
constexpr double kRested_s = 0.5;  // in a row: at the ends of a swing the arm stands, too

std::unique_ptr<Plant> make_plant(const BenchOptions& options, const SceneConfig& scene) {
  if (options.serial_robot && options.serial_robot->is_torque_controlled)
    return std::make_unique<TorquePlant>(*options.serial_robot, scene, options.buses, options, options.faults,
                                         options.seed);
  if (scene.payload)
    throw std::runtime_error("the scene has a payload: its robot needs torque drives (drives.mode = \"torque\")");
  if (options.serial_robot)
    return std::make_unique<SerialPlant>(*options.serial_robot, scene, options.buses, options, options.faults,
                                         options.seed);
  return std::make_unique<CablePlant>(options.robot, scene, options.buses, options, options.faults, options.seed);
}

std::unique_ptr<TipEquipment> make_equipment(const SceneConfig& scene, Plant& plant, std::uint64_t seed) {
  if (auto own = plant.make_equipment(scene, seed)) return own;
  return std::make_unique<RodEquipment>(scene, plant, seed);
}

std::vector<std::string> columns_of(const Plant& plant) {
  std::vector<std::string> columns{"slot"};
  for (std::string& name : plant.truth_columns()) columns.push_back(std::move(name));
  return columns;
}

}  // namespace

Bench::Bench(const BenchOptions& options)
    : options_(options),
      scene_(displaced(options.scene, options.scene_offset, options.seed)),
      plant_(make_plant(options, scene_)),
      injector_(options.faults),
      practice_(options.practice_socket),
      equipment_(make_equipment(scene_, *plant_, options.seed)),
      camera_link_(options.api_socket, {"camera", ""}),
      tool_link_(options.api_socket, {"tool", "tool"}),
      log_(options.truth_path, columns_of(*plant_)),
      syncs_(options.buses.names.size(), 0),
      received_(options.buses.names.size(), 0),
      sent_(options.buses.names.size(), 0) {}

// State at the start of a slot goes to truth and camera before anything in the slot happens.
void Bench::begin_slot(std::uint32_t slot, double now_s) {
  practice_.serve(slot, *plant_, injector_);
  plant_->inject(slot, injector_);
  record(slot);
  equipment_->suffer(camera_defects(), tool_defects());
  equipment_->look(now_s);
  while (const auto picture = equipment_->picture(now_s)) {
    camera_link_.send(*picture);
    camera_link_.receive([](const std::string&) {});  // answers to those before
  }
  use_tool(now_s);
  begun_ = slot + 1;
}

ToolDefects Bench::tool_defects() const {
  ToolDefects defects;
  for (std::size_t i = 0; i < injector_.faults().size(); ++i) {
    if (!injector_.is_on(i)) continue;
    if (injector_.faults()[i].kind == FaultKind::kToolJams) defects.jams = true;
    if (injector_.faults()[i].kind == FaultKind::kToolSilent) defects.silent = true;
  }
  return defects;
}

void Bench::use_tool(double now_s) {
  tool_link_.receive([this](const std::string& message) {
    if (const auto command = tool_command(message)) equipment_->ask(*command);
  });
  if (const auto report = equipment_->act(now_s)) tool_link_.send(tool_message(*report));
}

CameraDefects Bench::camera_defects() const {
  CameraDefects defects;
  for (std::size_t i = 0; i < injector_.faults().size(); ++i) {
    if (!injector_.is_on(i)) continue;
    const FaultConfig& fault = injector_.faults()[i];
    if (fault.kind == FaultKind::kCameraDropped) defects.dropped = true;
    if (fault.kind == FaultKind::kCameraFrozen) defects.frozen = true;
    if (fault.kind == FaultKind::kTargetLost) defects.lost = true;
    if (fault.kind == FaultKind::kCameraMirrored) defects.mirrored = true;
    if (fault.kind == FaultKind::kCameraLate) defects.late_s += fault.parameters.seconds;
    if (fault.kind == FaultKind::kCameraJump) defects.jump_m += fault.parameters.length_m;
  }
  return defects;
}

void Bench::record(std::uint32_t slot) {
  std::vector<double> row{static_cast<double>(slot)};
  plant_->add_truth(row);
  log_.write(row);
}

void Bench::integrate_slot(double period_s) {
  const std::uint64_t start_us = wall_clock_us();
  plant_->integrate(period_s);
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
    if (first) camera_link_.connect(2000);
    if (first) tool_link_.connect(2000);
    first = false;
    wake.frames.erase(std::remove_if(wake.frames.begin(), wake.frames.end(),
                                     [&](const CanFrame& f) { return f.bus >= received_.size(); }),
                      wake.frames.end());
    for (const CanFrame& frame : wake.frames) ++received_[frame.bus];
    const std::uint32_t slot = bus.lockstep() ? wake.slot : integrated_;
    catch_up(slot, period_s);
    if (begun_ == slot) begin_slot(slot, slot * period_s);
    out.clear();
    plant_->exchange(wake.frames, wake.now_us, out);
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
  const auto most = slots + static_cast<std::uint32_t>(std::lround(options_.rest_within_s / period_s));
  const auto rested = static_cast<std::uint32_t>(std::lround(kRested_s / period_s));
  FrameList unheard;
  std::uint32_t at_rest = 0;
  for (std::uint32_t i = 0; i < slots || (i < most && at_rest < rested); ++i) {
    at_rest = plant_->fastest_rad_s() < kRest_rad_s ? at_rest + 1 : 0;
    now_us += period_us;
    if (begun_ == integrated_) record(begun_++);
    plant_->exchange({}, now_us, unheard);
    integrate_slot(period_s);
  }
}

void Bench::write_summary(const Bus& bus) const {
  if (options_.summary_path.empty()) return;
  nlohmann::json drives = nlohmann::json::array();
  for (std::size_t i = 0; i < plant_->drives().size(); ++i) {
    const Drive& drive = plant_->drives().drive(i);
    const DriveCounts c = drive.counts();
    drives.push_back({{"node", drive.node()},
                      {"received", c.received},
                      {"sent", c.sent},
                      {"syncs", c.syncs},
                      {"rpdos", c.rpdos},
                      {"emergencies", c.emergencies},
                      {"quick_stops", c.quick_stops},
                      {"sdo_aborts", c.sdo_aborts},
                      {"statusword", drive.statusword()}});
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
  nlohmann::json summary{
      {"slots", integrated_},
      {"seed", options_.seed},
      {"drives", drives},
      {"faults", faults},
      {"buses", buses},
      {"frames_refused", bus.refused()},
      {"camera_sent", camera_link_.sent()},
      {"camera_lost", camera_link_.lost()},
      {"measured", {{"physics_us_per_slot", integrated_ == 0 ? 0.0 : static_cast<double>(physics_us_) / integrated_}}}};
  equipment_->summarise(summary);
  plant_->summarise(summary);
  std::ofstream file(options_.summary_path);
  file << summary.dump(1) << '\n';
  if (!file) throw std::runtime_error("--summary: " + options_.summary_path + " cannot be written; check the folder");
}

}  // namespace liana::bench
