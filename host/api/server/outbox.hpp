// What waits for one client to read it.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>

#include "host/api/server/topic.hpp"

namespace liana::api {

class Outbox {
 public:
  static constexpr std::size_t kMaxDroppable = 8;  // of one topic, for a client that may lose some
  static constexpr std::size_t kMaxPackets = 8192;
  static constexpr std::size_t kMaxBytes = 524288;            // beyond them there is room for one packet alone
  static constexpr std::size_t kMaxBytesOfTicks = 32u << 20;  // of the archive, which may be slow for half a minute

  // From now on there is room for so many bytes.
  void set_most_bytes(std::size_t bytes) { max_bytes_ = bytes; }
  // Adds a packet; false when there is no room. A droppable one takes the place of the oldest droppable of its topic
  // when kMaxDroppable wait; dropped() counts those.
  bool add(Topic topic, bool droppable, std::string packet);
  bool empty() const { return packets_.empty(); }
  std::size_t size() const { return packets_.size(); }
  // The packet that is `i` behind the oldest, below size().
  std::string_view at(std::size_t i) const { return packets_[i].bytes; }
  // Takes the oldest away.
  void pop();
  void clear();
  // How many of the topic wait.
  std::size_t waiting(Topic topic) const { return waiting_[index_of(topic)]; }
  std::uint64_t dropped() const { return dropped_; }

 private:
  struct Packet {
    Topic topic;
    bool droppable;
    std::string bytes;
  };
  void forget_oldest(Topic topic);

  std::deque<Packet> packets_;
  std::array<std::size_t, kTopicNames.size()> waiting_{}, waiting_droppable_{};
  std::size_t bytes_ = 0, max_bytes_ = kMaxBytes;
  std::uint64_t dropped_ = 0;
};

}  // namespace liana::api
