#include "host/verify/twin.hpp"

#include "host/verify/nominal_drives.hpp"

namespace liana::verify {

namespace {

// One tick of the copy.
template <class Arm>
Outputs<Arm> step(Controller<Arm>& copy, NominalDrives<Arm>& drives, std::uint64_t tick,
                  const Telecommand<typename Arm::Setpoint>& command) {
  Inputs<Arm> inputs = drives.next_inputs(tick);
  inputs.telecommand = command;
  const Outputs<Arm> outputs = copy.tick(inputs);
  drives.command(outputs);
  return outputs;
}

template <class Command>
Command command_at(std::span<const Command> released, std::uint64_t tick) {
  for (const Command& command : released) {
    if (command.first_tick() == tick) return command;
  }
  return {};
}

}  // namespace

template <class Arm>
Prediction<Arm> Twin<Arm>::run(const TwinImage<Arm>& start, std::span<const Command> released,
                               const Candidate<Arm>& candidate, std::size_t max_stop_ticks) {
  Prediction<Arm> prediction;
  prediction.faults_before =
      static_cast<std::uint64_t>(start.last_outputs.faults.count) + start.last_outputs.faults.dropped;
  Controller<Arm> copy = start.controller;
  NominalDrives<Arm> drives(copy.table(), start.last_inputs.drive, start.last_outputs);
  std::uint64_t tick = start.next_tick;
  for (; tick < candidate.first_tick(); ++tick) step(copy, drives, tick, command_at(released, tick));
  for (; tick < candidate.expiry_tick(); ++tick) {
    prediction.ticks.push_back(
        step(copy, drives, tick, tick == candidate.first_tick() ? candidate.telecommand_ : Command{}));
  }
  prediction.command_ticks = prediction.ticks.size();
  for (std::size_t i = 0; i < max_stop_ticks && !prediction.comes_to_rest; ++i, ++tick) {
    prediction.ticks.push_back(step(copy, drives, tick, Command{}));
    prediction.comes_to_rest = prediction.ticks.back().at_rest != 0;
  }
  return prediction;
}

template class Twin<cable::CableArm>;
template class Twin<serial::SerialArm>;

}  // namespace liana::verify
