// Child processes of `liana run`: started, watched, ended.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace liana::launcher {

// How many SIGCHLDs have come: each may have cut a wait short, in a read with a time limit whatever SA_RESTART says.
unsigned child_ends();

// How a child ended: its exit code, or 128 + the signal that killed it.
struct ExitStatus {
  int code = 0;
  int signal = 0;  // 0 = it exited by itself
};

// "ended with code 1", "was killed by signal 9".
std::string how(const ExitStatus& end);

// Of a program's log, in what is said about its end.
constexpr int kShownLines = 5;

// One running program; its standard output and error go to a log file. It is told to end when its parent dies.
class ChildProcess {
 public:
  // Starts argv[0] (a path) with its output appended to `log_path`; throws std::runtime_error when it cannot be
  // started. `realtime_priority` over 0: with SCHED_FIFO at that priority, where the machine grants it.
  ChildProcess(std::string name, const std::vector<std::string>& argv, std::string log_path, int realtime_priority = 0);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  const std::string& name() const { return name_; }
  // How it ended, or nothing while it runs.
  std::optional<ExitStatus> poll();
  // Processor time of it and of all that it started and waited for [s]; 0 while it runs.
  double cpu_s() const { return cpu_s_; }
  // Waits at most `timeout_s` for its end.
  std::optional<ExitStatus> wait(double timeout_s);
  // Which of its processes (its own, those it made) stands still because somebody stopped it (SIGSTOP, a debugger).
  std::optional<pid_t> stopped() const;
  // SIGTERM, unless it has ended.
  void ask_to_end();
  // The same, and SIGKILL when it is still there after `grace_s`.
  void end(double grace_s);
  // The last `count` lines of its log.
  std::string last_lines(int count) const;
  // What it said last in its own name, after ": ", or that the disk of its log is full; empty where neither is known.
  std::string last_words() const;

 private:
  std::vector<pid_t> processes() const;
  void take_end(int flags);

  std::string name_;
  std::string log_path_;
  pid_t pid_ = -1;
  std::optional<ExitStatus> end_;
  unsigned ends_seen_ = 0;  // of all children, when this one was looked at
  double cpu_s_ = 0.0;
};

// Waits until `path` is there; false when `maker` has ended without it, `stop` became true, or after 30 s.
bool wait_for_socket(const std::string& path, ChildProcess& maker, const std::atomic<bool>& stop);

// How one of several programs ended, and in words: its name, its end and what it said last; below it the last lines of
// its log.
struct NamedResult {
  ExitStatus end;
  std::string text;
};

// Of the programs that have ended and whose end `counts`, the one that ended worst: killed, failed, then in order;
// of equals bench and bus, whose end brings that of the others. Nothing without any.
std::optional<NamedResult> worst_end(const std::vector<std::unique_ptr<ChildProcess>>& children,
                                     const std::function<bool(const ChildProcess&, const ExitStatus&)>& counts);

// Of what run_and_capture takes from each pipe.
constexpr std::size_t kMaxCapturedBytes = 64u << 20;

// What a short helper program printed.
struct Captured {
  int code = 0;
  std::string out;
  std::string error;
};

// Runs argv to its end and captures what it prints; throws std::runtime_error when it cannot be started, or prints more
// than kMaxCapturedBytes, and is killed for it.
Captured run_and_capture(const std::vector<std::string>& argv);

// Path of a program that lies beside the running one; throws std::runtime_error when it is not there.
std::string sibling_program(const std::string& name);

}  // namespace liana::launcher
