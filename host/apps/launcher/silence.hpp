// Says while something computes without a word that it still does.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace liana::launcher {

class Silence {
 public:
  // Calls `say` in a thread of its own whenever `after_s` have passed since the last word, with the time since the
  // beginning.
  Silence(double after_s, std::function<void(double since_s)> say);
  ~Silence();
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

  // Something was said.
  void broken();

 private:
  void watch(double after_s);

  std::function<void(double since_s)> say_;
  std::mutex mutex_;
  std::condition_variable woken_;
  bool over_ = false;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now(), last_ = begin_;
  std::thread thread_;
};

}  // namespace liana::launcher
