// Load cells between drums and first discs, and the nodes that read them (CiA 404,
// docs/reference/drives.md#load-cells).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "hil/config/fault_config.hpp"
#include "hil/config/scene_config.hpp"
#include "hil/drive/self_starting_node.hpp"
#include "hil/math/random.hpp"
#include "hil/math/reduced.hpp"

namespace liana::bench {

// All assumed, as those of small cells with their amplifiers.
struct LoadCellParams {
  double noise_N = 0.2;       // standard deviation of a reading
  double bias_N = 1.0;        // most, constant over a run
  double scale_error = 0.01;  // most, of the reading
};

class LoadCells {
 public:
  // Noise is drawn from the seed; with `spread` bias and scale, too.
  LoadCells(const BusesConfig& buses, bool spread, std::uint64_t seed, const LoadCellParams& figures = {});

  // Throws std::runtime_error for a fault of a load cell that is not there.
  void refuse_faults_of_others(const std::vector<FaultConfig>& faults) const;
  // What of the list is wrong with them in this slot.
  void suffer(const std::vector<FaultConfig>& faults, const std::function<bool(std::size_t)>& is_on);
  // Hears the slot's frames and sends what is due; `tension_N` of every cable at its motor.
  void exchange(const FrameList& frames, std::uint64_t now_us, const CableValues& tension_N, FrameList& out);
  // One reading of cable `cable` of node `node`, in steps.
  std::int16_t read(std::size_t node, std::size_t channel, double tension_N);

 private:
  struct Channel {
    std::size_t cable = 0;
    double zero_N = 0.0, bias_N = 0.0, scale = 1.0;
    bool failed = false, stuck = false;
    double off_N = 0.0;
    std::int16_t last = 0;
  };
  bool has(std::size_t cable) const;

  struct Node {
    SelfStartingNode bus_node;
    std::vector<Channel> channels;
    bool silent = false;
  };

  LoadCellParams figures_;
  double newtons_per_step_;
  Random noise_;
  std::vector<Node> nodes_;
};

}  // namespace liana::bench
