// Simulations in a thread of their own, which begins once: whoever asked goes on, and waits only as long as it can.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "host/model/simulation/simulation.hpp"

namespace liana::simulation {

class Worker {
 public:
  Worker(const ArmModel& model, const config::SceneConfig& scene, double enough_m);
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  // Hands over what is to be simulated; false while the one before it still runs.
  bool begin(const StartState& start, const JointSequence& sequence);
  // Its motion, valid until the next begin; nullptr when it was not there within `patience_s` (infinity: whenever).
  const Motion* motion(double patience_s);

 private:
  enum class Phase { kIdle, kAsked, kDone, kLeaving };
  void work();

  Simulation simulation_;
  StartState start_;
  JointSequence sequence_;
  const Motion* motion_ = nullptr;
  Phase phase_ = Phase::kIdle;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::thread thread_;  // last: it uses all the others
};

}  // namespace liana::simulation
