#include "hil/bench/bench.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "hil/bench/cable_plant.hpp"
#include "hil/bus/wall_clock.hpp"
#include "hil/serial/serial_plant.hpp"

namespace liana::bench {

namespace {

std::unique_ptr<Plant> make_plant(const BenchOptions& options) {
  if (options.serial_robot)
    return std::make_unique<SerialPlant>(*options.serial_robot, options.buses, options, options.faults, options.seed);
  return std::make_unique<CablePlant>(options.robot, options.scene, options.buses, options, options.seed);
}

std::vector<std::string> columns_of(const Plant& plant) {
  std::vector<std::string> columns{"slot"};
  for (std::string& name : plant.truth_columns()) columns.push_back(std::move(name));
  return columns;
}

}  // namespace

Bench::Bench(const BenchOptions& options)
    : options_(options),
      plant_(make_plant(options)),
      injector_(options.faults),
      camera_(options.scene.camera, options.scene.slit_frame, options.scene.rod.pose, options.seed),
      link_(options.api_socket),
      log_(options.truth_path, columns_of(*plant_)),
      syncs_(options.buses.names.size(), 0),
      received_(options.buses.names.size(), 0),
      sent_(options.buses.names.size(), 0) {}

// State at the start of a slot goes to truth and camera before anything in the slot happens.
void Bench::begin_slot(std::uint32_t slot, double now_s) {
  plant_->inject(slot, injector_);
  record(slot);
  camera_.look(now_s, plant_->tip());
  while (const auto view = camera_.deliver(now_s)) link_.send(camera_message(*view));
  begun_ = slot + 1;
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
  FrameList unheard;
  for (std::uint32_t i = 0; i < slots; ++i) {
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
      {"camera_sent", link_.sent()},
      {"camera_lost", link_.lost()},
      {"measured", {{"physics_us_per_slot", integrated_ == 0 ? 0.0 : static_cast<double>(physics_us_) / integrated_}}}};
  plant_->summarise(summary);
  std::ofstream file(options_.summary_path);
  file << summary.dump(1) << '\n';
  if (!file) throw std::runtime_error("--summary: " + options_.summary_path + " cannot be written; check the folder");
}

}  // namespace liana::bench
