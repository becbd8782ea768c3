// The newest numbered packets of a topic, for readers that are slow or come back: each of them has its own next number.
#pragma once

#include <cstdint>
#include <deque>
#include <string>

namespace liana::api {

class PacketHistory {
 public:
  static constexpr std::size_t kKept = 4096;

  // The packet becomes number next(). The oldest is forgotten when kKept are there.
  void push(std::string packet) {
    packets_.push_back(std::move(packet));
    ++next_;
    if (packets_.size() > kKept) packets_.pop_front();
  }
  // Number of the oldest that is kept; next() when there is none.
  std::uint64_t oldest() const { return next_ - packets_.size(); }
  // Number that the next packet will have: 1, 2, ...
  std::uint64_t next() const { return next_; }
  // A packet that is kept: oldest() <= number < next().
  const std::string& packet(std::uint64_t number) const {
    return packets_[static_cast<std::size_t>(number - oldest())];
  }

 private:
  std::deque<std::string> packets_;
  std::uint64_t next_ = 1;
};

}  // namespace liana::api
