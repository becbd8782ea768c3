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
      : table_(table), last_(last.drive), sensors_(last.sensors) {}

  // The inputs of the next tick: the state, position and torque that the last commands, `told`, asked for.
  liana::Inputs<Arm> next_inputs(std::uint64_t tick, const liana::Outputs<Arm>& told) {
    for (std::int32_t drive = 0; drive < table_.drive_count(); ++drive) {
      const std::size_t i = as_index(drive);
      last_[i] = next_feedback(last_[i], told.drive[i], i, Arm::planned_permille(table_, told, drive));
      target_before_[i] = told.drive[i].target_counts;
    }
    has_told_ = true;
    liana::Inputs<Arm> inputs;
    inputs.tick = tick;
    inputs.drive = last_;
    inputs.sensors = sensors_ = Arm::imagined(table_, told, sensors_);
    return inputs;
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
  DriveFeedbacks last_;
  std::array<std::int32_t, kMaxDrives> target_before_{};
  bool has_told_ = false;
  [[no_unique_address]] typename Arm::Sensors sensors_;
};

}  // namespace liana::verification
