#include "host/storage/archive/inbox.hpp"

#include <utility>

namespace liana::archive {

void Inbox::put(Letter letter) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return closed_ || letters_.size() < most_; });
  add(std::move(letter));
}

bool Inbox::try_put(Letter letter) {
  const std::lock_guard lock(mutex_);
  if (letters_.size() >= most_) return false;
  add(std::move(letter));
  return true;
}

// Who takes is woken by the first and by the last that it waits for.
void Inbox::add(Letter letter) {
  if (closed_) return;
  letters_.push_back(std::move(letter));
  if (letters_.size() == 1 || letters_.size() == enough()) changed_.notify_all();
}

std::optional<Inbox::Letter> Inbox::take() {
  std::unique_lock lock(mutex_);
  if (letters_.empty()) gather(lock);
  if (letters_.empty()) return std::nullopt;
  Letter letter = std::move(letters_.front());
  letters_.pop_front();
  if (letters_.size() + 1 == most_) changed_.notify_all();
  return letter;
}

// Many at once: to wake a thread for each costs more than to write it.
void Inbox::gather(std::unique_lock<std::mutex>& lock) {
  changed_.wait(lock, [this] { return closed_ || !letters_.empty(); });
  changed_.wait_for(lock, kGather, [this] { return closed_ || letters_.size() >= enough(); });
}

void Inbox::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  changed_.notify_all();
}

bool Inbox::is_closed() {
  const std::lock_guard lock(mutex_);
  return closed_;
}

}  // namespace liana::archive
