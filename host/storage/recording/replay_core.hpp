// The core once more, on Inputs that were recorded.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "firmware_like/cable_controller.hpp"
#include "firmware_like/serial_controller.hpp"
#include "host/storage/recording/codec.hpp"
#include "host/storage/recording/image.hpp"
#include "host/storage/recording/serialise.hpp"
#include "host/storage/recording/tick_packet.hpp"
#include "host/storage/recording/visit.hpp"

namespace liana::recording {

template <class Arm>
class ReplayCore {
 public:
  // Goes on from the image; `file` is named where its state makes no sense (controller_from).
  ReplayCore(const ControllerSnapshot<Arm>& image, const std::string& file)
      : controller_(image.fresh ? Controller<Arm>(image.table) : controller_from<Arm>(image.state, image.table, file)),
        counts_(counts_of(image.table)),
        next_tick_(image.next_tick) {}

  // Whether these Inputs are those of the next tick. Deadlines that were lost are no gap: the core had no tick.
  bool is_next(std::string_view inputs) const {
    std::uint64_t tick = 0;
    std::uint32_t lost_ticks = 0;
    Reader head(inputs);
    head("tick", tick);
    head("lost_ticks", lost_ticks);
    return tick == next_tick_ + lost_ticks;
  }
  // The Outputs, in recorded form.
  std::string tick(std::string_view inputs) {
    const Inputs<Arm> in = RecordingDecoder::recorded_inputs<Arm>(inputs, counts_);
    std::string outputs;
    append_recorded(outputs, controller_.tick(in), counts_);
    next_tick_ = in.tick + 1;
    return outputs;
  }
  // An image packet, from which the same goes on at this tick.
  std::string image_packet(std::uint64_t tick) const { return recording::image_packet<Arm>(tick, controller_); }
  std::uint64_t next_tick() const { return next_tick_; }
  const RecordedCounts& counts() const { return counts_; }

 private:
  Controller<Arm> controller_;
  RecordedCounts counts_;
  std::uint64_t next_tick_;
};

}  // namespace liana::recording
