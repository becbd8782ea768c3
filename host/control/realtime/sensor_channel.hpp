// Nodes on the drives' buses that are no drives: wrist sensor and adapter of a serial arm, load cells of a cable arm.
// They are heard and started, and the adapter is told.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "firmware_like/cable/arm/load_cell.hpp"
#include "firmware_like/serial/sensor_pdo.hpp"
#include "host/drives/bus/drive_bus.hpp"
#include "host/model/config/config.hpp"

namespace liana::realtime {

class SensorChannel {
 public:
  // Setup. A table without sensors: nothing is ever heard or sent.
  explicit SensorChannel(const config::BusesConfig& buses);

  // A tick begins, `lost` ticks after the one before it should have: what was heard grows older.
  void begin_tick(std::uint64_t lost) noexcept;
  // A frame of nobody else; those of other nodes are ignored.
  void on_frame(int bus, const bus::CanFrame& frame) noexcept;
  // Once per tick: starts a node that is not operational, and tells the adapter, every fourth tick.
  void step(bus::DriveBus& bus, std::uint64_t tick, serial::AdapterCommand command, std::uint8_t sequence) noexcept;

  // What was heard until now. Halves of a wrist sample count when both have come.
  const serial::Sensors& sensors() const noexcept { return sensors_; }
  const cable::LoadCells& load_cells() const noexcept { return load_cells_; }

 private:
  struct Node {
    int bus = -1;  // none
    std::uint8_t id = 0;
    bool wants_start = false;  // a heartbeat said that it is not operational
  };

  struct CellNode : Node {
    std::vector<std::size_t> cables;  // of its channels
  };

  void on_heartbeat(int bus, const bus::CanFrame& frame, Node& node) noexcept;
  void take_halves() noexcept;
  void take_cells(const CellNode& node, const bus::CanFrame& frame) noexcept;
  void start(bus::DriveBus& bus, Node& node) noexcept;

  Node wrist_;
  Node adapter_;
  std::vector<CellNode> cell_nodes_;
  cable::LoadCells load_cells_{};
  serial::Sensors sensors_{};
  std::optional<serial::WristHalf> force_, torque_;  // of the sample that is not whole yet
};

}  // namespace liana::realtime
