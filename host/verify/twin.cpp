#include "host/verify/twin.hpp"

#include "firmware_like/drive/ideal_drive.hpp"
#include "firmware_like/math/convert.hpp"

namespace liana {

namespace {

// A copy of the Controller on drives that go where they are told.
struct Ahead {
  cable::Controller controller;
  cable::Inputs inputs;
  cable::Outputs told;

  const cable::Outputs& step(std::uint64_t tick, const cable::Telecommand& command) {
    const cable::RobotTable& table = controller.table();
    for (std::int32_t i = 0; i < table.drive_count(); ++i) {
      const std::size_t d = as_index(i);
      const std::int16_t permille = cable::CableArm::planned_permille(table, told, i);
      inputs.drive[d] = ideal_feedback(inputs.drive[d], told.drive[d], permille);
    }
    inputs.tick = tick;
    inputs.telecommand = command;
    told = controller.tick(inputs);
    return told;
  }
};

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
  Ahead copy{start.controller, {}, start.last_outputs};
  copy.inputs.drive = start.last_inputs.drive;
  std::uint64_t tick = start.next_tick;
  for (; tick < candidate.first_tick(); ++tick) copy.step(tick, command_at(released, tick));
  for (; tick < candidate.expiry_tick(); ++tick) {
    prediction.ticks.push_back(
        copy.step(tick, tick == candidate.first_tick() ? candidate.telecommand_ : cable::Telecommand{}));
  }
  prediction.command_ticks = prediction.ticks.size();
  for (std::size_t i = 0; i < max_stop_ticks && !prediction.comes_to_rest; ++i, ++tick) {
    prediction.ticks.push_back(copy.step(tick, cable::Telecommand{}));
    prediction.comes_to_rest = prediction.ticks.back().at_rest != 0;
  }
  return prediction;
}

}  // namespace liana
