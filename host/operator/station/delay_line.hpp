// One direction of a delayed link between the hand's side and the arm's, in arm time: what is sent into it comes out
// later, perhaps in another order.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "host/operator/haptics/link.hpp"
#include "host/operator/haptics/packets.hpp"

namespace liana::station {

template <class Load>
class DelayLine {
 public:
  struct Arrival {
    std::shared_ptr<const Load> load;
    bool is_newest = true;  // nothing that was sent later has come before
  };

  DelayLine(const haptics::LinkTable& table, std::uint64_t seed, std::uint64_t purpose) : link_(table, seed, purpose) {}

  void send(Load load, std::int64_t now_us) {
    link_.send({sequence_++, std::make_shared<const Load>(std::move(load))}, now_us);
  }
  // The next that has come by now.
  std::optional<Arrival> receive(std::int64_t now_us) {
    const auto parcel = link_.receive(now_us);
    if (!parcel) return std::nullopt;
    return Arrival{parcel->load, newest_.accept(parcel->sequence)};
  }

 private:
  struct Parcel {
    std::uint32_t sequence = 0;
    std::shared_ptr<const Load> load;
  };

  haptics::Link<Parcel> link_;
  haptics::Newest newest_;
  std::uint32_t sequence_ = 0;
};

}  // namespace liana::station
