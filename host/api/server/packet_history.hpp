// The newest numbered packets of a topic, for readers that are slow or come back: each of them has its own next number.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace liana::api {

class PacketHistory {
 public:
  static constexpr std::size_t kKept = 4096;

  // Takes the memory of kKept ordinary packets at once: a program that runs for days does not grow with its events.
  PacketHistory() : packets_(kKept, std::string(kOrdinaryBytes, '\0')) {}

  // The packet becomes number next(). The oldest is forgotten when kKept are there.
  void push(const std::string& packet) { packets_[next_++ % kKept].assign(packet); }
  // Number of the oldest that is kept; next() when there is none.
  std::uint64_t oldest() const { return next_ > kKept ? next_ - kKept : 1; }
  // Number that the next packet will have: 1, 2, ...
  std::uint64_t next() const { return next_; }
  // A packet that is kept: oldest() <= number < next().
  const std::string& packet(std::uint64_t number) const { return packets_[number % kKept]; }

 private:
  static constexpr std::size_t kOrdinaryBytes = 512;  // most events are shorter

  std::vector<std::string> packets_;  // number n is at n % kKept
  std::uint64_t next_ = 1;
};

}  // namespace liana::api
