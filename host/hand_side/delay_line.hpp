// A delayed link between the hand's side and the arm's, in arm time: what is sent into it comes out later, perhaps in
// another order. Of device samples and states only the newest counts; what is said arrives however late.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "host/haptic/link.hpp"
#include "host/haptic/packets.hpp"
#include "host/json/json_fwd.hpp"

namespace liana::hand_side {

// One direction.
class DelayLine {
 public:
  DelayLine(const haptic::LinkTable& table, std::uint64_t seed, std::uint64_t purpose) : link_(table, seed, purpose) {}

  // Messages of one moment travel together.
  void send(std::vector<Json> messages, double now_s);
  // Those that have come by now. Of a parcel that a later one has overtaken, nothing but what a person said.
  std::vector<Json> receive(double now_s);

 private:
  struct Parcel {
    std::uint32_t sequence = 0;
    std::shared_ptr<const std::vector<Json>> messages;
  };

  haptic::Link<Parcel> link_;
  haptic::Newest newest_;
  std::uint32_t sequence_ = 0;
};

}  // namespace liana::hand_side
