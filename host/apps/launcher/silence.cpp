#include "host/apps/launcher/silence.hpp"

#include <utility>

namespace liana::launcher {

using Clock = std::chrono::steady_clock;

Silence::Silence(double after_s, std::function<void(double since_s)> say)
    : say_(std::move(say)), thread_([this, after_s] { watch(after_s); }) {}

Silence::~Silence() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  woken_.notify_all();
  thread_.join();
}

void Silence::broken() {
  const std::lock_guard lock(mutex_);
  last_ = Clock::now();
}

void Silence::watch(double after_s) {
  const auto patience = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(after_s));
  std::unique_lock lock(mutex_);
  while (!over_) {
    woken_.wait_until(lock, last_ + patience);
    if (over_ || Clock::now() < last_ + patience) continue;
    last_ = Clock::now();
    say_(std::chrono::duration<double>(last_ - begin_).count());
  }
}

}  // namespace liana::launcher
