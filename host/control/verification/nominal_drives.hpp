// The nominal plant of the twin: drives that go where they are told, one tick late.
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/controller_io.hpp"
#include "firmware_like/drive/ideal_drive.hpp"
#include "firmware_like/math/convert.hpp"

namespace liana::verification {

template <class Arm>
class NominalDrives {
 public:
  // Starts from what the real drives and sensors reported last. `table` must outlive this.
  NominalDrives(const typename Arm::Table& table, const liana::Inputs<Arm>& last)
      : table_(table), drives_(table.drive_count()) {
    inputs_.drive = last.drive;
    inputs_.sensors = last.sensors;
  }

  // The inputs of the next tick: the state, position and torque that the last commands, `told`, asked for. There is no
  // telecommand among them; they are valid until the next call.
  liana::Inputs<Arm>& next_inputs(std::uint64_t tick, const liana::Outputs<Arm>& told) {
    for (std::int32_t drive = 0; drive < drives_; ++drive) {
      const std::size_t i = as_index(drive);
      DriveFeedback& feedback = inputs_.drive[i];
      feedback = next_feedback(feedback, told.drive[i], i, Arm::planned_permille(table_, told, drive));
      target_before_[i] = told.drive[i].target_counts;
    }
    has_told_ = true;
    inputs_.tick = tick;
    if (inputs_.telecommand.kind() != CommandKind::kNone) inputs_.telecommand = {};
    Arm::predict_sensors(table_, told, inputs_.sensors);
    return inputs_;
  }

 private:
  // Before the first command of its own it is not known how the target has moved: then it has not.
  DriveFeedback next_feedback(const DriveFeedback& last, const DriveCommand& told, std::size_t i,
                              std::int16_t torque_permille) const {
    if (!Arm::is_torque_controlled(table_)) return ideal_feedback(last, told, torque_permille);
    const std::int32_t before = has_told_ ? target_before_[i] : told.target_counts;
    return ideal_torque_feedback(last, told, before, torque_permille);
  }

  const typename Arm::Table& table_;
  std::int32_t drives_;
  liana::Inputs<Arm> inputs_{};
  std::array<std::int32_t, kMaxDrives> target_before_{};
  bool has_told_ = false;
};

}  // namespace liana::verification
