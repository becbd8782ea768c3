#include "host/model/simulation/worker.hpp"

#include <chrono>
#include <cmath>

namespace liana::simulation {

Worker::Worker(const ArmModel& model, const config::SceneConfig& scene, double enough_m)
    : simulation_(model, scene, enough_m), thread_([this] { work(); }) {}

Worker::~Worker() {
  {
    const std::lock_guard lock(mutex_);
    phase_ = Phase::kLeaving;
  }
  changed_.notify_all();
  thread_.join();
}

bool Worker::begin(const StartState& start, const JointSequence& sequence) {
  {
    const std::lock_guard lock(mutex_);
    if (phase_ == Phase::kAsked) return false;
    start_ = start;
    sequence_ = sequence;
    phase_ = Phase::kAsked;
  }
  changed_.notify_all();
  return true;
}

const Motion* Worker::motion(double patience_s) {
  std::unique_lock lock(mutex_);
  const auto is_done = [this] { return phase_ == Phase::kDone; };
  if (std::isinf(patience_s)) {
    changed_.wait(lock, is_done);
  } else if (!changed_.wait_for(lock, std::chrono::duration<double>(patience_s), is_done)) {
    return nullptr;
  }
  return motion_;
}

void Worker::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return phase_ == Phase::kAsked || phase_ == Phase::kLeaving; });
    if (phase_ == Phase::kLeaving) return;
    lock.unlock();
    const Motion& motion = simulation_.run(start_, sequence_);
    lock.lock();
    motion_ = &motion;
    if (phase_ == Phase::kAsked) phase_ = Phase::kDone;
    changed_.notify_all();
  }
}

}  // namespace liana::simulation
