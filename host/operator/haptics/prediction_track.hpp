// Where the arm was predicted to be, for as long as an answer may take: a ring of the last 512, about 10 s at 20 ms.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "host/control/virtual_fixtures/hand_motion.hpp"

namespace liana::haptics {

class PredictionTrack {
 public:
  // The prediction for `t_us`; times that do not rise are ignored.
  void put(std::int64_t t_us, const Motion& tip) noexcept;
  // The newest one; nothing before the first.
  std::optional<Motion> newest() const noexcept;
  // The prediction for a time, between two straight; the newest for a later time, nothing before the oldest.
  std::optional<Motion> at(std::int64_t t_us) const noexcept;

 private:
  static constexpr std::size_t kMost = 512;
  struct Entry {
    std::int64_t t_us = 0;
    Motion tip{};
  };
  const Entry& back(std::size_t steps) const noexcept { return ring_[(count_ - 1 - steps) % kMost]; }

  std::array<Entry, kMost> ring_{};
  std::size_t count_ = 0;  // ever put
};

}  // namespace liana::haptics
