// What waits for one client to read it.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <string>

#include "host/api/topic.hpp"

namespace liana::api {

class Outbox {
 public:
  static constexpr std::size_t kMaxDroppable = 8;  // of one topic, for a client that may lose some
  static constexpr std::size_t kMaxPackets = 8192;

  // Adds a packet; false when there is no room. A droppable one takes the place of the oldest droppable of its topic
  // when kMaxDroppable wait; dropped() counts those.
  bool add(Topic topic, bool droppable, std::string packet);
  bool empty() const { return packets_.empty(); }
  // The oldest; not of an empty one.
  const std::string& front() const { return packets_.front().bytes; }
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
  std::uint64_t dropped_ = 0;
};

}  // namespace liana::api
