#include "host/storage/archive/inbox.hpp"

#include <utility>

namespace liana::archive {

void Inbox::put(Letter letter) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return closed_ || letters_.size() < most_; });
  if (closed_) return;
  letters_.push_back(std::move(letter));
  changed_.notify_all();
}

bool Inbox::try_put(Letter letter) {
  const std::lock_guard lock(mutex_);
  if (letters_.size() >= most_) return false;
  if (!closed_) letters_.push_back(std::move(letter));
  changed_.notify_all();
  return true;
}

std::optional<Inbox::Letter> Inbox::take() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return closed_ || !letters_.empty(); });
  if (letters_.empty()) return std::nullopt;
  Letter letter = std::move(letters_.front());
  letters_.pop_front();
  changed_.notify_all();
  return letter;
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
