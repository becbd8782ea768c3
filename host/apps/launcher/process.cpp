#include "host/apps/launcher/process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <deque>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <tuple>
#include <utility>

#include "host/base/file/address_space.hpp"
#include "host/base/install_paths/places.hpp"

namespace liana::launcher {
namespace {

constexpr int kExecFailed = 127;
constexpr rlim_t kMaxAddressSpace = rlim_t{8} << 30;  // of a program that liana starts
constexpr double kStartTimeout_s = 30.0;

std::atomic<unsigned> ends = 0;  // SIGCHLDs: whether a child has ended costs no call
static_assert(std::atomic<unsigned>::is_always_lock_free);

void count_end(int) { ++ends; }

// Whoever started this program may have blocked the signal.
void listen_for_ends() {
  struct sigaction action {};
  action.sa_handler = count_end;
  action.sa_flags = SA_RESTART | SA_NOCLDSTOP;
  ::sigaction(SIGCHLD, &action, nullptr);
  sigset_t ends_only;
  sigemptyset(&ends_only);
  sigaddset(&ends_only, SIGCHLD);
  ::pthread_sigmask(SIG_UNBLOCK, &ends_only, nullptr);
}

std::vector<char*> exec_arguments(const std::vector<std::string>& argv) {
  std::vector<char*> pointers;
  for (const std::string& word : argv) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

// In the child: own process group, so that Ctrl-C reaches only the parent, which turns it into a stop.
[[noreturn]] void become(std::vector<char*>& argv, int out_fd, int error_fd, int realtime_priority) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);  // the parent may wait for signals by a descriptor
  file::limit_address_space(kMaxAddressSpace);
  sched_param parameters{};
  parameters.sched_priority = realtime_priority;
  if (realtime_priority > 0) sched_setscheduler(0, SCHED_FIFO, &parameters);
  const int null_fd = open("/dev/null", O_RDONLY);
  dup2(null_fd, 0);
  dup2(out_fd, 1);
  dup2(error_fd, 2);
  execv(argv[0], argv.data());
  dprintf(2, "%s: %s\n", argv[0], strerror(errno));
  _exit(kExecFailed);
}

pid_t start(const std::vector<std::string>& argv, int out_fd, int error_fd, int realtime_priority) {
  auto arguments = exec_arguments(argv);
  listen_for_ends();
  const pid_t pid = fork();
  if (pid < 0) throw std::runtime_error(argv[0] + ": cannot be started: " + strerror(errno));
  if (pid == 0) become(arguments, out_fd, error_fd, realtime_priority);
  return pid;
}

ExitStatus end_of(int status) {
  if (WIFSIGNALED(status)) return {128 + WTERMSIG(status), WTERMSIG(status)};
  return {WEXITSTATUS(status), 0};
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

// Reads both pipes until both are closed; false as soon as one of them has brought too much.
bool drain(int out_fd, int error_fd, Captured& captured) {
  std::array<pollfd, 2> fds{{{out_fd, POLLIN, 0}, {error_fd, POLLIN, 0}}};
  std::array<std::string*, 2> texts{&captured.out, &captured.error};
  std::array<char, 4096> buffer{};
  for (int open_count = 2; open_count > 0;) {
    if (poll(fds.data(), fds.size(), -1) < 0 && errno != EINTR) return true;
    for (std::size_t i = 0; i < fds.size(); ++i) {
      if (fds[i].fd < 0 || fds[i].revents == 0) continue;
      const ssize_t size = read(fds[i].fd, buffer.data(), buffer.size());
      if (size > 0) {
        texts[i]->append(buffer.data(), static_cast<std::size_t>(size));
        if (texts[i]->size() > kMaxCapturedBytes) return false;
      } else {
        fds[i].fd = -1;
        --open_count;
      }
    }
  }
  return true;
}

// The letter behind the name, which may itself hold brackets: T is stopped, t held by a debugger.
bool stands_still(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string stat;
  std::getline(file, stat);
  const std::size_t name_end = stat.rfind(')');
  return name_end != std::string::npos && name_end + 2 < stat.size() &&
         (stat[name_end + 2] == 'T' || stat[name_end + 2] == 't');
}

}  // namespace

unsigned child_ends() { return ends; }

std::string how(const ExitStatus& end) {
  return end.signal != 0 ? "was killed by signal " + std::to_string(end.signal)
                         : "ended with code " + std::to_string(end.code);
}

ChildProcess::ChildProcess(std::string name, const std::vector<std::string>& argv, std::string log_path,
                           int realtime_priority)
    : name_(std::move(name)), log_path_(std::move(log_path)) {
  const int log_fd = open(log_path_.c_str(), O_CREAT | O_WRONLY | O_APPEND | O_CLOEXEC, 0644);
  if (log_fd < 0) throw std::runtime_error(log_path_ + ": cannot be written: " + strerror(errno));
  pid_ = start(argv, log_fd, log_fd, realtime_priority);
  close(log_fd);
}

ChildProcess::~ChildProcess() { end(0.0); }

void ChildProcess::take_end(int flags) {
  int status = 0;
  rusage used{};
  if (end_ || wait4(pid_, &status, flags, &used) != pid_) return;
  end_ = end_of(status);
  cpu_s_ = seconds(used.ru_utime) + seconds(used.ru_stime);
}

std::optional<ExitStatus> ChildProcess::poll() {
  const unsigned now = ends;
  if (std::exchange(ends_seen_, now) != now) take_end(WNOHANG);
  return end_;
}

std::optional<ExitStatus> ChildProcess::wait(double timeout_s) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(timeout_s);
  while (!poll() && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  return poll();
}

// A program may have made another one, which does its work: liana-mission its script's.
std::vector<pid_t> ChildProcess::processes() const {
  const std::string pid = std::to_string(pid_);
  std::ifstream file("/proc/" + pid + "/task/" + pid + "/children");
  std::vector<pid_t> all{pid_};
  for (pid_t made = 0; file >> made;) all.push_back(made);
  return all;
}

std::optional<pid_t> ChildProcess::stopped() const {
  if (end_) return std::nullopt;
  for (const pid_t each : processes()) {
    if (stands_still(each)) return each;
  }
  return std::nullopt;
}

void ChildProcess::ask_to_end() {
  if (!poll()) kill(pid_, SIGTERM);
}

void ChildProcess::end(double grace_s) {
  if (poll()) return;
  ask_to_end();
  if (wait(grace_s)) return;
  kill(pid_, SIGKILL);
  take_end(0);
}

std::string ChildProcess::last_lines(int count) const {
  std::ifstream log(log_path_);
  std::deque<std::string> lines;
  for (std::string line; std::getline(log, line);) {
    lines.push_back(line);
    if (lines.size() > static_cast<std::size_t>(count)) lines.pop_front();
  }
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : "\n") + line;
  return text;
}

namespace {

// Bus and bench fail by themselves; lianad, whose bus has ended then, and the others follow them.
int comes_first(const ChildProcess& child) { return child.name() == "liana-bench" || child.name() == "liana-bus"; }

bool is_full(const std::string& log_path) {
  std::error_code unknown;
  return std::filesystem::space(std::filesystem::path(log_path).parent_path(), unknown).available == 0 && !unknown;
}

}  // namespace

std::string ChildProcess::last_words() const {
  std::ifstream log(log_path_);
  std::string words;
  for (std::string line; std::getline(log, line);) {
    if (line.starts_with(name_ + ": ")) words = line.substr(name_.size());
  }
  if (is_full(log_path_))  // what it said last may not be there
    words += ": no space is left on the disk of " + std::filesystem::path(log_path_).parent_path().string();
  return words;
}

std::optional<NamedResult> worst_end(const std::vector<std::unique_ptr<ChildProcess>>& children,
                                     const std::function<bool(const ChildProcess&, const ExitStatus&)>& counts) {
  const ChildProcess* cause = nullptr;
  std::tuple<int, int, int> worst;
  for (const auto& child : children) {
    const auto end = child->poll();
    if (!end || !counts(*child, *end)) continue;
    const std::tuple badness(end->signal, end->code, comes_first(*child));
    if (cause != nullptr && badness <= worst) continue;
    cause = child.get();
    worst = badness;
  }
  if (cause == nullptr) return std::nullopt;
  const ExitStatus end{std::get<1>(worst), std::get<0>(worst)};
  return NamedResult{end, cause->name() + " " + how(end) + cause->last_words() + "\n" + cause->last_lines(kShownLines)};
}

bool wait_for_socket(const std::string& path, ChildProcess& maker, const std::atomic<bool>& stop) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(kStartTimeout_s);
  while (!std::filesystem::exists(path)) {
    if (std::chrono::steady_clock::now() > deadline || maker.poll() || stop) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

Captured run_and_capture(const std::vector<std::string>& argv) {
  std::array<int, 2> out{};
  std::array<int, 2> error{};
  if (pipe2(out.data(), O_CLOEXEC) != 0 || pipe2(error.data(), O_CLOEXEC) != 0) {
    throw std::runtime_error(std::string("no pipe for a child process: ") + strerror(errno));
  }
  const pid_t pid = start(argv, out[1], error[1], 0);
  close(out[1]);
  close(error[1]);
  Captured captured;
  const bool is_whole = drain(out[0], error[0], captured);
  if (!is_whole) kill(pid, SIGKILL);
  close(out[0]);
  close(error[0]);
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (!is_whole)
    throw std::runtime_error(argv[0] + ": printed more than " + std::to_string(kMaxCapturedBytes >> 20) +
                             " MiB and was killed");
  captured.code = end_of(status).code;
  return captured;
}

std::string sibling_program(const std::string& name) {
  const std::string path = install_paths::program_folder() + "/" + name;
  if (access(path.c_str(), X_OK) != 0)
    throw std::runtime_error(path + ": this program is missing; build it with ./dev build, or install it again");
  return path;
}

}  // namespace liana::launcher
