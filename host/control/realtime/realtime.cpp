#include "host/control/realtime/realtime.hpp"

#include <pthread.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <future>
#include <stdexcept>
#include <string>

namespace liana::realtime {

namespace {

// Touches the pages that the thread's ticks will use.
void touch_stack() {
  std::array<volatile char, std::size_t{256} * 1024> stack;
  for (std::size_t i = 0; i < stack.size(); i += 4096) stack[i] = 0;
}

// With a small limit mlockall itself may succeed, and the first allocation after it fail.
bool room_is_left() {
  constexpr std::size_t kNeeded = 64u << 20;
  void* const trial = ::mmap(nullptr, kNeeded, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (trial == MAP_FAILED) return false;
  ::munmap(trial, kNeeded);
  return true;
}

// Locked memory is there from the start, stacks with all their 8 MB; no thread of lianad needs more than this.
void keep_stacks_small() {
  constexpr std::size_t kStackBytes = 1u << 20;
  pthread_attr_t attributes;
  ::pthread_attr_init(&attributes);
  ::pthread_attr_setstacksize(&attributes, kStackBytes);
  ::pthread_setattr_default_np(&attributes);
  ::pthread_attr_destroy(&attributes);
}

int become_realtime() {
  sched_param parameters{};
  parameters.sched_priority = kRealtimePriority;
  return ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameters);
}

}  // namespace

void lock_memory() {
  keep_stacks_small();
  if (::mlockall(MCL_CURRENT | MCL_FUTURE) == 0 && room_is_left()) return;
  const int error = errno;
  ::munlockall();
  throw std::runtime_error(
      std::string("time mode real: memory cannot be locked (") + std::strerror(error) +
      "): needs CAP_IPC_LOCK or an unlimited memlock limit; see `liana doctor`, or use --time fast or paced");
}

// Of Linux: a thread's own, although the name says process, and handed on to the threads that it makes.
void come_before_ordinary_work() {
  constexpr int kNice = -15;
  ::setpriority(PRIO_PROCESS, 0, kNice);
}

std::jthread start_realtime(std::function<void(const std::stop_token&)> body, ThreadResult& end) {
  std::promise<int> started;
  std::future<int> result = started.get_future();
  std::jthread thread(
      [started = std::move(started), body = std::move(body), &end](const std::stop_token& stop) mutable {
        const int error = become_realtime();
        touch_stack();
        started.set_value(error);
        if (error == 0) run_guarded([&] { body(stop); }, end);
      });
  const int error = result.get();
  if (error == 0) return thread;
  thread.join();
  throw std::runtime_error(std::string("time mode real: no real-time priority (") + std::strerror(error) +
                           "): needs CAP_SYS_NICE or an rtprio limit of " + std::to_string(kRealtimePriority) +
                           "; see `liana doctor`, or use --time fast or paced");
}

}  // namespace liana::realtime
