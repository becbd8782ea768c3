#include "host/api/server/outbox.hpp"

#include <algorithm>

namespace liana::api {

bool Outbox::add(Topic topic, bool droppable, std::string packet) {
  if (droppable && waiting_droppable_[index_of(topic)] >= kMaxDroppable) forget_oldest(topic);
  if (packets_.size() >= kMaxPackets) return false;
  if (!packets_.empty() && bytes_ + packet.size() > max_bytes_) return false;
  bytes_ += packet.size();
  packets_.push_back({topic, droppable, std::move(packet)});
  ++waiting_[index_of(topic)];
  if (droppable) ++waiting_droppable_[index_of(topic)];
  return true;
}

void Outbox::forget_oldest(Topic topic) {
  const auto oldest = std::find_if(packets_.begin(), packets_.end(),
                                   [topic](const Packet& p) { return p.droppable && p.topic == topic; });
  bytes_ -= oldest->bytes.size();
  packets_.erase(oldest);
  --waiting_[index_of(topic)];
  --waiting_droppable_[index_of(topic)];
  ++dropped_;
}

void Outbox::pop() {
  const Packet& oldest = packets_.front();
  --waiting_[index_of(oldest.topic)];
  if (oldest.droppable) --waiting_droppable_[index_of(oldest.topic)];
  bytes_ -= oldest.bytes.size();
  packets_.pop_front();
}

void Outbox::clear() {
  packets_.clear();
  bytes_ = 0;
  waiting_ = waiting_droppable_ = {};
}

}  // namespace liana::api
