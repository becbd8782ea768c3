#include "host/verify/twin.hpp"

#include "host/verify/nominal_drives.hpp"

namespace liana {

namespace {

using Drives = NominalDrives<cable::CableArm>;

// One tick of the copy.
cable::Outputs step(cable::Controller& copy, Drives& drives, std::uint64_t tick, const cable::Telecommand& command) {
  cable::Inputs inputs = drives.next_inputs(tick);
  inputs.telecommand = command;
  const cable::Outputs outputs = copy.tick(inputs);
  drives.command(outputs);
  return outputs;
}

cable::Telecommand command_at(std::span<const cable::Telecommand> released, std::uint64_t tick) {
  for (const cable::Telecommand& command : released) {
    if (command.first_tick() == tick) return command;
  }
  return {};
}

}  // namespace

Prediction Twin::run(const TwinImage& start, std::span<const cable::Telecommand> released, const Candidate& candidate,
                     std::size_t max_stop_ticks) {
  Prediction prediction;
  prediction.faults_before =
      static_cast<std::uint64_t>(start.last_outputs.faults.count) + start.last_outputs.faults.dropped;
  cable::Controller copy = start.controller;
  Drives drives(copy.table(), start.last_inputs.drive, start.last_outputs);
  std::uint64_t tick = start.next_tick;
  for (; tick < candidate.first_tick(); ++tick) step(copy, drives, tick, command_at(released, tick));
  for (; tick < candidate.expiry_tick(); ++tick) {
    prediction.ticks.push_back(
        step(copy, drives, tick, tick == candidate.first_tick() ? candidate.telecommand_ : cable::Telecommand{}));
  }
  prediction.command_ticks = prediction.ticks.size();
  for (std::size_t i = 0; i < max_stop_ticks && !prediction.comes_to_rest; ++i, ++tick) {
    prediction.ticks.push_back(step(copy, drives, tick, cable::Telecommand{}));
    prediction.comes_to_rest = prediction.ticks.back().at_rest != 0;
  }
  return prediction;
}

}  // namespace liana
