// The bench: drives and arm on one end of the bus, camera, tool and truth on the other.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hil/bench/fault_injector.hpp"
#include "hil/bench/plant.hpp"
#include "hil/bench/practice.hpp"
#include "hil/bench/tip_equipment.hpp"
#include "hil/bench/truth_log.hpp"
#include "hil/bus/api_connection.hpp"
#include "hil/bus/bus.hpp"
#include "hil/config/robot_config.hpp"
#include "hil/config/scene_config.hpp"
#include "hil/config/serial_config.hpp"

namespace liana::bench {

// Everything that is chosen on the command line.
struct BenchOptions : ModelOptions {
  RobotConfig robot;                              // a cable arm, unless
  std::optional<SerialRobotConfig> serial_robot;  // it is a serial one
  SceneConfig scene;                              // as its table has it
  SceneOffset scene_offset;                       // where it really is
  BusesConfig buses;
  std::vector<FaultConfig> faults;
  std::uint64_t seed = 1;
  std::string api_socket;
  std::string practice_socket;  // where a person's faults come from; empty: nowhere
  std::string truth_path;
  std::string summary_path;
  double run_on_s = 0.0;       // how long drives and arm go on by themselves after the bus has ended
  double rest_within_s = 0.0;  // and then at most so long, until the arm is at rest
};

class Bench {
 public:
  // Throws std::runtime_error for anything that cannot work.
  explicit Bench(const BenchOptions& options);

  // Runs until the bus ends, run_on_s longer and until the arm is at rest, then writes the summary.
  void run(Bus& bus);

 private:
  void begin_slot(std::uint32_t slot, double now_s);
  void integrate_slot(double period_s);
  void record(std::uint32_t slot);
  std::uint32_t count_syncs(const FrameList& frames, std::uint64_t now_us, std::uint32_t period_us);
  void catch_up(std::uint32_t slots, double period_s);
  void run_on(std::uint64_t now_us, std::uint32_t period_us);
  CameraDefects camera_defects() const;
  ToolDefects tool_defects() const;
  void use_tool(double now_s);
  void write_summary(const Bus& bus) const;

  BenchOptions options_;
  SceneConfig scene_;  // where it really is
  std::unique_ptr<Plant> plant_;
  FaultInjector injector_;
  Practice practice_;
  std::unique_ptr<TipEquipment> equipment_;
  ApiConnection camera_link_;
  ApiConnection tool_link_;
  TruthLog log_;
  std::vector<std::uint32_t> syncs_;  // per bus, real time
  std::uint64_t last_slot_us_ = 0;    // when the last slot ended, real time
  std::vector<std::uint64_t> received_;
  std::vector<std::uint64_t> sent_;
  std::uint32_t begun_ = 0;       // slots begun: truth written, camera looked
  std::uint32_t integrated_ = 0;  // slots whose physics is done
  std::uint64_t physics_us_ = 0;
};

}  // namespace liana::bench
