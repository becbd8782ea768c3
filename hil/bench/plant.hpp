// What a bench moves: the drives of one robot, the arm behind them, and what is true about both.
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "hil/bench/fault_injector.hpp"
#include "hil/bench/tip_equipment.hpp"
#include "hil/config/scene_config.hpp"
#include "hil/math/vec3.hpp"

namespace liana::bench {

// How the arm is to be simulated.
struct ModelOptions {
  std::string arm = "full";  // of a cable arm; or light: no inertia, contact or cable friction
  std::string physics = "nominal";
  std::string start_pose = "prepare";
  double gravity_share = 0.0;  // what counterweights leave of the arm's weight: 0 none, 1 all; along -z of the base
  double linkage_error = 0.0;  // most by which a joint's share of its segment's bend differs from even, by seed
  bool spread = true;  // parameters, start pose and noise by seed; false: the table exactly, noise only from the camera
  bool fixture = false;                  // the arm starts exactly in its start pose
  double free_step_s = 0.001;            // of the full arm's physics while nothing can touch; up to 0.004
  std::vector<std::size_t> cross_wired;  // empty, or two drives that have each other's cable
};

class Plant {
 public:
  Plant() = default;
  Plant(const Plant&) = delete;
  Plant& operator=(const Plant&) = delete;
  virtual ~Plant() = default;

  virtual const Drives& drives() const = 0;
  // Throws std::runtime_error naming the first fault that cannot happen to this arm.
  virtual void refuse(const std::vector<FaultConfig>& faults) const = 0;
  // Faults that begin or end with this slot.
  virtual void inject(std::uint32_t slot, FaultInjector& injector) = 0;
  // What the drives hear and say.
  virtual void exchange(const FrameList& frames, std::uint64_t now_us, FrameList& out) = 0;
  // The physics of one slot.
  virtual void integrate(double period_s) = 0;
  virtual Pose tip() const = 0;
  // What this arm has at its tip instead of the slit's camera and tool; null: these. It does not outlive the plant.
  virtual std::unique_ptr<TipEquipment> make_equipment(const SceneConfig&, std::uint64_t) { return nullptr; }
  // The press rod is gone from now on; nothing where there is none.
  virtual void remove_rod() = 0;
  // The fastest of its true angles now [rad/s].
  virtual double fastest_rad_s() const = 0;

  // The truth's columns behind "slot", and their values now; extremes count since the last call.
  virtual std::vector<std::string> truth_columns() const = 0;
  virtual void add_truth(std::vector<double>& row) = 0;
  // Adds what this kind of arm has to say at the end.
  virtual void summarise(nlohmann::json& summary) const = 0;
};

}  // namespace liana::bench
