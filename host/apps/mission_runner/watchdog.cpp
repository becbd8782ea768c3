#include "host/apps/mission_runner/watchdog.hpp"

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <new>
#include <stdexcept>

#include "host/base/file/address_space.hpp"

namespace liana::mission_runner {
namespace {

constexpr long kPoll_ns = 20'000'000;

double seconds(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// What the script's process may use, whatever gets out of the sandbox: it makes no other one, and writes a report.
void limit_itself() {
  const auto limit = [](auto resource, rlim_t most) {
    const rlimit both{most, most};
    ::setrlimit(resource, &both);  // a lower limit that is there already stays
  };
  file::limit_address_space(1u << 30);
  limit(RLIMIT_FSIZE, 64u << 20);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_NPROC, 0);
}

[[noreturn]] void run_child(pid_t parent, const std::function<int()>& body) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  limit_itself();
  if (getppid() != parent) _exit(1);  // the parent died before prctl
  const int code = body();
  std::fflush(stdout);
  std::fflush(stderr);
  _exit(code);
}

// Notices when the child computes without a beat for longer than the limits.
class Watch {
 public:
  Watch(pid_t child, const Activity& activity, const ScriptTimeLimits& limits) : activity_(activity), limits_(limits) {
    if (clock_getcpuclockid(child, &cpu_clock_) != 0) cpu_clock_ = CLOCK_MONOTONIC;
    restart();
  }

  bool too_long() {
    const auto beats = activity_.beats.load(std::memory_order_relaxed);
    if (beats != beats_) restart();
    const double wall_s = seconds(CLOCK_MONOTONIC) - wall_start_s_;
    const double cpu_s = seconds(cpu_clock_) - cpu_start_s_;
    return wall_s > limits_.starved_s || (wall_s > limits_.wall_s && cpu_s > limits_.cpu_s);
  }

 private:
  void restart() {
    beats_ = activity_.beats.load(std::memory_order_relaxed);
    wall_start_s_ = seconds(CLOCK_MONOTONIC);
    cpu_start_s_ = seconds(cpu_clock_);
  }

  const Activity& activity_;
  ScriptTimeLimits limits_;
  clockid_t cpu_clock_ = CLOCK_MONOTONIC;
  std::uint64_t beats_ = 0;
  double wall_start_s_ = 0.0;
  double cpu_start_s_ = 0.0;
};

WatchedEnd end_of(int status) {
  if (WIFSIGNALED(status)) return {1, false, WTERMSIG(status)};
  return {WEXITSTATUS(status), false, 0};
}

}  // namespace

Activity& shared_activity() {
  void* memory = mmap(nullptr, sizeof(Activity), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED)
    throw std::runtime_error(std::string("shared memory for the script watchdog: ") + std::strerror(errno));
  return *new (memory) Activity;
}

WatchedEnd run_watched(Activity& activity, const ScriptTimeLimits& limits, const std::function<int()>& body) {
  std::fflush(stdout);
  std::signal(SIGCHLD, SIG_DFL);  // where whoever started us ignores it, nobody learns how the child ended
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error(std::string("cannot start the script's process: ") + std::strerror(errno));
  if (child == 0) run_child(parent, body);
  Watch watch(child, activity, limits);
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (watch.too_long()) {
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      return {4, true, 0};
    }
    const timespec pause{0, kPoll_ns};
    nanosleep(&pause, nullptr);
  }
  return end_of(status);
}

std::string last_seen(const Activity& activity) {
  if (activity.file[0] == '\0') return "before its first line";
  return std::string(activity.file.data()) + ":" + std::to_string(activity.line.load(std::memory_order_relaxed));
}

}  // namespace liana::mission_runner
