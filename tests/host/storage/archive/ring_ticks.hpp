// Ticks for the ring as lianad sends them: the core run on Inputs of an arm whose drives move and scatter.
#pragma once

#include <cmath>
#include <random>
#include <string>

#include "firmware_like/cable_controller.hpp"
#include "host/storage/recording/tick_packet.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::archive {

class RingTicks {
 public:
  // The packet before the first tick.
  std::string start() const { return recording::image_packet<cable::CableArm>(next_tick_, cable::zhu2022::table()); }
  // Where a replay can go on before the next tick.
  std::string image() const { return recording::image_packet<cable::CableArm>(next_tick_, controller_); }
  std::string next() {
    recording::TickRecord<cable::CableArm> record{inputs(), {}};
    record.outputs = controller_.tick(record.inputs);
    ++next_tick_;
    return recording::tick_packet(record, 0, recording::counts_of(cable::zhu2022::table()));
  }
  std::uint64_t next_tick() const { return next_tick_; }

 private:
  cable::Inputs inputs() {
    cable::Inputs inputs;
    inputs.tick = next_tick_;
    for (std::size_t i = 0; i < cable::zhu2022::kCables; ++i) {
      const double wave = 1000.0 * std::sin(static_cast<double>(next_tick_) / 500.0 + static_cast<double>(i));
      inputs.drive[i] = {
          .statusword = 0x0250,
          .torque_permille = static_cast<std::int16_t>(60 + draw_() % 4),
          .position_counts = static_cast<std::int32_t>(1000000.0 + wave) + static_cast<std::int32_t>(draw_() % 3),
          .feedback_age_ticks = 0,
          .heartbeat_age_ticks = 0,
          .operational = 1};
    }
    return inputs;
  }

  cable::Controller controller_{cable::zhu2022::table()};
  std::uint64_t next_tick_ = 40;
  std::mt19937 draw_{1};
};

}  // namespace liana::archive
