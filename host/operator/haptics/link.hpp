// One direction of a link as it disturbs packets: delay, jitter that lets them overtake each other, loss. Seeded: the
// same seed, the same fate of every packet. No heap, no clock.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "host/base/random/random.hpp"

namespace liana::haptics {

struct LinkTable {
  double delay_s = 0.0;  // 0 .. 5
  double jitter = 0.0;   // 0 .. 1: each packet's delay is within this share of `delay_s`, evenly
  double loss = 0.0;     // 0 .. 1: share of packets that never come
};

// Throws std::invalid_argument that names the field, its value and the range.
void check(const LinkTable& table);

// Delays of both directions [s]: commands to the arm, news from it.
struct Delays {
  double forward_s = 0.0;
  double back_s = 0.0;
};

// "FORWARD_S,RETURN_S", e.g. 0.5,0.5; each 0 to 2. Throws std::invalid_argument that says so, and what was given.
Delays delays_of(const std::string& text);

// `kMost`: packets that can be under way; more are lost.
template <class Packet, std::size_t kMost = 1024>
class Link {
 public:
  // `purpose` separates links of one seed.
  Link(const LinkTable& table, std::uint64_t seed, std::uint64_t purpose) : table_(table), random_(seed, purpose) {
    check(table);
  }

  // From now on: `table` for packets that are sent, those under way keep their fate.
  void change(const LinkTable& table) {
    check(table);
    table_ = table;
  }

  void send(const Packet& packet, std::int64_t now_us) noexcept {
    const bool lost = random_.uniform(0.0, 1.0) < table_.loss;
    const double delay_s = table_.delay_s * (1.0 + table_.jitter * random_.uniform(-1.0, 1.0));
    if (lost || count_ == kMost) {
      ++lost_;
      return;
    }
    under_way_[count_++] = {now_us + std::llround(1e6 * delay_s), packet};
  }

  // The packet that has been there longest, if one is.
  std::optional<Packet> receive(std::int64_t now_us) noexcept {
    const auto end = under_way_.begin() + static_cast<std::ptrdiff_t>(count_);
    const auto first =
        std::min_element(under_way_.begin(), end, [](const Flight& a, const Flight& b) { return a.due_us < b.due_us; });
    if (first == end || first->due_us > now_us) return std::nullopt;
    const Packet packet = first->packet;
    std::copy(first + 1, end, first);  // in the order of sending: of two that are due together the first comes first
    --count_;
    return packet;
  }

  // Packets that never come: lost, or more than kMost under way.
  std::int64_t lost() const { return lost_; }

 private:
  struct Flight {
    std::int64_t due_us = 0;
    Packet packet{};
  };

  LinkTable table_;
  simulated::RandomStream random_;
  std::array<Flight, kMost> under_way_{};
  std::size_t count_ = 0;
  std::int64_t lost_ = 0;
};

}  // namespace liana::haptics
