#include "hil/bench/load_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace liana::bench {

LoadCells::LoadCells(const BusesConfig& buses, bool spread, std::uint64_t seed, const LoadCellParams& figures)
    : figures_(figures), newtons_per_step_(buses.newtons_per_step), noise_(seed, "load cells") {
  Random drawn(seed, "load cell errors");
  for (const LoadCellNodeConfig& config : buses.load_cells) {
    Node node{{static_cast<std::uint32_t>(config.node), static_cast<std::uint8_t>(config.bus)}, {}, false};
    for (std::size_t i = 0; i < config.cables.size(); ++i) {
      Channel channel{.cable = config.cables[i], .zero_N = config.zero_N[i]};
      if (spread) {
        channel.bias_N = drawn.uniform(-figures_.bias_N, figures_.bias_N);
        channel.scale = 1.0 + drawn.uniform(-figures_.scale_error, figures_.scale_error);
      }
      node.channels.push_back(channel);
    }
    nodes_.push_back(std::move(node));
  }
}

namespace {

bool is_of_load_cells(FaultKind kind) {
  return kind == FaultKind::kLoadCellFailed || kind == FaultKind::kLoadCellStuck ||
         kind == FaultKind::kLoadCellSilent || kind == FaultKind::kLoadCellOff;
}

}  // namespace

bool LoadCells::has(std::size_t cable) const {
  return std::any_of(nodes_.begin(), nodes_.end(), [cable](const Node& node) {
    return std::any_of(node.channels.begin(), node.channels.end(),
                       [cable](const Channel& channel) { return channel.cable == cable; });
  });
}

void LoadCells::refuse_faults_of_others(const std::vector<FaultConfig>& faults) const {
  for (const FaultConfig& fault : faults) {
    if (!is_of_load_cells(fault.kind)) continue;
    for (const std::size_t cable : fault.drives) {
      if (has(cable)) continue;
      throw std::runtime_error("fault " + fault.name + ": cable " + std::to_string(cable + 1) +
                               " has no load cell in the bus table; name a cable that has one");
    }
  }
}

void LoadCells::suffer(const std::vector<FaultConfig>& faults, const std::function<bool(std::size_t)>& is_on) {
  for (Node& node : nodes_) {
    node.silent = false;
    for (Channel& channel : node.channels) {
      channel.failed = channel.stuck = false;
      channel.off_N = 0.0;
      for (std::size_t i = 0; i < faults.size(); ++i) {
        const FaultConfig& fault = faults[i];
        const auto& cables = fault.drives;
        if (!is_on(i) || std::find(cables.begin(), cables.end(), channel.cable) == cables.end()) continue;
        if (fault.kind == FaultKind::kLoadCellFailed) channel.failed = true;
        if (fault.kind == FaultKind::kLoadCellStuck) channel.stuck = true;
        if (fault.kind == FaultKind::kLoadCellOff) channel.off_N += fault.parameters.tension_N;
        if (fault.kind == FaultKind::kLoadCellSilent) node.silent = true;
      }
    }
  }
}

std::int16_t LoadCells::read(std::size_t node, std::size_t channel, double tension_N) {
  using Steps = std::numeric_limits<std::int16_t>;
  Channel& cell = nodes_[node].channels[channel];
  if (cell.failed) return Steps::min();
  if (cell.stuck) return cell.last;
  const double felt_N = cell.scale * tension_N + cell.zero_N + cell.bias_N + cell.off_N;
  const double steps = std::round((felt_N + noise_.gaussian(figures_.noise_N)) / newtons_per_step_);
  cell.last = static_cast<std::int16_t>(std::clamp<double>(steps, Steps::min(), Steps::max()));
  return cell.last;
}

void LoadCells::exchange(const FrameList& frames, std::uint64_t now_us, const CableValues& tension_N, FrameList& out) {
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    Node& node = nodes_[n];
    FrameList said;
    for (const CanFrame& frame : frames) {
      if (!node.bus_node.hears(frame) || frame.id != 0x080 || !node.bus_node.is_operational()) continue;
      std::vector<std::uint8_t> bytes;
      for (std::size_t i = 0; i < node.channels.size(); ++i) {
        const auto steps = static_cast<std::uint16_t>(read(n, i, tension_N[node.channels[i].cable]));
        bytes.push_back(static_cast<std::uint8_t>(steps & 0xFF));
        bytes.push_back(static_cast<std::uint8_t>(steps >> 8));
      }
      node.bus_node.send(0x180 + node.bus_node.node(), bytes, said);
    }
    node.bus_node.tick(now_us, said);
    if (!node.silent) out.insert(out.end(), said.begin(), said.end());
  }
}

}  // namespace liana::bench
