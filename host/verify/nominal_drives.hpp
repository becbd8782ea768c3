// The nominal plant of the twin: drives that go where they are told, one tick late.
#pragma once

#include <cstdint>

#include "firmware_like/controller_io.hpp"
#include "firmware_like/drive/ideal_drive.hpp"
#include "firmware_like/math/convert.hpp"

namespace liana::verify {

template <class Arm>
class NominalDrives {
 public:
  // Starts from what the real drives reported last and what they were told last. `table` must outlive this.
  NominalDrives(const typename Arm::Table& table, const DriveFeedbacks& last, const liana::Outputs<Arm>& told)
      : table_(table), last_(last), told_(told) {}

  // The inputs of the next tick: the state, position and torque that the last commands asked for.
  liana::Inputs<Arm> next_inputs(std::uint64_t tick) {
    for (std::int32_t drive = 0; drive < table_.drive_count(); ++drive) {
      const std::size_t i = as_index(drive);
      const std::int16_t permille = Arm::planned_permille(table_, told_, drive);
      last_[i] = ideal_feedback(last_[i], told_.drive[i], permille);
    }
    liana::Inputs<Arm> inputs;
    inputs.tick = tick;
    inputs.drive = last_;
    return inputs;
  }

  // Takes the commands of a tick.
  void command(const liana::Outputs<Arm>& outputs) { told_ = outputs; }

 private:
  const typename Arm::Table& table_;
  DriveFeedbacks last_;
  liana::Outputs<Arm> told_;
};

}  // namespace liana::verify
