#include "host/control/verification/twin.hpp"

#include "host/control/verification/nominal_drives.hpp"

namespace liana::verification {

namespace {

// The copy and its drives, which go on from what was told last.
template <class Arm>
struct Copy {
  using Command = Telecommand<typename Arm::Setpoint>;

  explicit Copy(const TwinSnapshot<Arm>& start)
      : controller(start.controller), drives(controller.table(), start.last_inputs), tick(start.next_tick) {}

  // `command`: what the tick hears; nullptr: nothing.
  Outputs<Arm> step(const Outputs<Arm>& told, const Command* command) {
    Inputs<Arm>& inputs = drives.next_inputs(tick++, told);
    if (command != nullptr) inputs.telecommand = *command;
    return controller.tick(inputs);
  }

  Controller<Arm> controller;
  NominalDrives<Arm> drives;
  std::uint64_t tick;
};

template <class Command>
const Command* command_at(std::span<const Command> released, std::uint64_t tick) {
  for (const Command& command : released) {
    if (command.first_tick() == tick) return &command;
  }
  return nullptr;
}

// `next`: in force from `first_tick` to `expiry_tick`.
template <class Arm, class Command>
void predict(const TwinSnapshot<Arm>& start, std::span<const Command> released, const Command& next,
             std::uint64_t first_tick, std::uint64_t expiry_tick, std::size_t max_stop_ticks,
             Prediction<Arm>& prediction) {
  const Outputs<Arm>& last = start.last_outputs;
  prediction.faults_before = static_cast<std::uint64_t>(last.faults.count) + last.faults.dropped;
  prediction.comes_to_rest = false;
  std::vector<Outputs<Arm>>& ticks = prediction.ticks;
  ticks.clear();
  Copy<Arm> copy(start);
  ticks.push_back(last);
  while (copy.tick < first_tick) ticks.back() = copy.step(ticks.back(), command_at(released, copy.tick));
  // What was told before the candidate is no part of the prediction: its first tick takes that place.
  ticks.back() = copy.step(ticks.back(), &next);
  while (copy.tick < expiry_tick) ticks.push_back(copy.step(ticks.back(), nullptr));
  prediction.command_ticks = ticks.size();
  for (std::size_t i = 0; i < max_stop_ticks && !prediction.comes_to_rest; ++i) {
    ticks.push_back(copy.step(ticks.back(), nullptr));
    prediction.comes_to_rest = ticks.back().at_rest != 0;
  }
}

}  // namespace

template <class Arm>
void Twin<Arm>::run(const TwinSnapshot<Arm>& start, std::span<const Command> released, const Candidate<Arm>& candidate,
                    std::size_t max_stop_ticks, Prediction<Arm>& prediction) {
  predict(start, released, candidate.telecommand_, candidate.first_tick(), candidate.expiry_tick(), max_stop_ticks,
          prediction);
}

template <class Arm>
void Twin<Arm>::stop(const TwinSnapshot<Arm>& start, std::span<const Command> released, std::uint64_t first_tick,
                     std::size_t max_stop_ticks, Prediction<Arm>& prediction) {
  const auto interval = static_cast<std::uint64_t>(start.controller.table().interval_ticks);
  predict(start, released, Command{}, first_tick, first_tick + interval, max_stop_ticks, prediction);
}

template class Twin<cable::CableArm>;
template class Twin<serial::SerialArm>;

}  // namespace liana::verification
