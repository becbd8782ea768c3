#include "host/apps/report/doctor.hpp"

#include <net/if.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/utsname.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <thread>

#include "host/base/json/json.hpp"

namespace liana::report {
namespace {

constexpr int kWantedPriority = 80;
constexpr std::size_t kWantedLocked_bytes = 256ul << 20;

Finding finding(std::string name, bool good, std::string found, std::string meaning, const std::string& action) {
  return {std::move(name), good, std::move(found), std::move(meaning), good ? "" : action};
}

std::string first_line(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

// Of a thread that ends at once; 0: it is given, otherwise errno.
int try_priority(int priority) {
  int error = 0;
  std::thread([&] {
    sched_param parameters{};
    parameters.sched_priority = priority;
    error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
  }).join();
  return error;
}

// Of memory that is mapped for it and that nobody touches; 0: it is locked, otherwise errno.
int try_lock(std::size_t bytes) {
  void* const memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED) return errno;
  const int error = mlock2(memory, bytes, MLOCK_ONFAULT) == 0 ? 0 : errno;
  munmap(memory, bytes);
  return error;
}

Finding realtime_priority() {
  const int error = try_priority(kWantedPriority);
  return finding(
      "real-time priority", error == 0,
      "SCHED_FIFO " + std::to_string(kWantedPriority) + (error == 0 ? " was given" : ": ") +
          (error == 0 ? "" : std::strerror(error)),
      "--time real runs the control thread with SCHED_FIFO 80; fast and paced need nothing",
      "add '@realtime - rtprio 95' to /etc/security/limits.d/liana.conf, join that group, log in again; in a "
      "container see docs/how-to/run-in-a-container.md");
}

Finding memory_lock() {
  const int error = try_lock(kWantedLocked_bytes);
  return finding(
      "memory locking", error == 0,
      std::to_string(kWantedLocked_bytes >> 20) + " MiB" + (error == 0 ? " were locked" : ": ") +
          (error == 0 ? "" : std::strerror(error)),
      "--time real locks lianad's memory, so that a page fault never delays a tick",
      "add '@realtime - memlock unlimited' to /etc/security/limits.d/liana.conf, join that group, log in again; in a "
      "container see docs/how-to/run-in-a-container.md");
}

Finding kernel() {
  utsname name{};
  uname(&name);
  const bool good = first_line("/sys/kernel/realtime") == "1" || std::strstr(name.version, "PREEMPT_RT") != nullptr;
  return finding("PREEMPT_RT kernel", good, std::string(name.release) + " " + name.version,
                 "bounds the wake-up latency of the control thread; a standard kernel may be milliseconds late",
                 "apt install linux-image-rt-amd64 and boot it");
}

Finding clock_source() {
  const std::string source = first_line("/sys/devices/system/clocksource/clocksource0/current_clocksource");
  timespec resolution{};
  clock_getres(CLOCK_MONOTONIC, &resolution);
  const bool good = resolution.tv_sec == 0 && resolution.tv_nsec <= 1000 &&
                    (source == "tsc" || source == "kvm-clock" || source == "arch_sys_counter");
  return finding(
      "clock", good,
      (source.empty() ? "unknown source" : source) + ", resolution " + std::to_string(resolution.tv_nsec) + " ns",
      "deadlines are absolute times of CLOCK_MONOTONIC; slow sources cost a system call per reading",
      "in real mode choose tsc: echo tsc > /sys/devices/system/clocksource/clocksource0/current_clocksource");
}

Finding processors() {
  const unsigned count = std::thread::hardware_concurrency();
  return finding("processors", count >= 2, std::to_string(count), "one for the control thread, one for everything else",
                 "give the machine a second processor, or use --time fast");
}

Finding governor() {
  const std::string name = first_line("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
  return finding("cpu governor", name.empty() || name == "performance",
                 name.empty() ? "none (fixed or virtual clock)" : name,
                 "a processor that slows down between ticks wakes up late", "cpupower frequency-set -g performance");
}

Finding can_socket() {
  const int fd = socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, 1);
  const int error = errno;
  if (fd >= 0) close(fd);
  return finding("CAN in the kernel", fd >= 0, fd >= 0 ? "raw CAN sockets open" : std::strerror(error),
                 "SocketCAN buses (--bus vcan, real interfaces) need it; the embedded bus does not",
                 "modprobe can can-raw; a kernel without these modules can use hil/vm, a virtual machine with them");
}

Finding can_interfaces() {
  constexpr const char* kArphrdCan = "280";
  std::string names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/sys/class/net", error)) {
    if (first_line(entry.path() / "type") == kArphrdCan)
      names += (names.empty() ? "" : ", ") + entry.path().filename().string();
  }
  return finding("CAN interfaces", !names.empty(), names.empty() ? "none" : names,
                 "the buses a socketcan bus table may name",
                 "ip link add dev vcan0 type vcan; ip link set vcan0 up (and vcan1)");
}

Finding tool(const std::string& program, const std::string& package, const std::string& meaning) {
  const char* path = std::getenv("PATH");
  std::string directories = path == nullptr ? "/usr/bin" : path;
  for (std::size_t start = 0; start <= directories.size();) {
    const std::size_t end = std::min(directories.find(':', start), directories.size());
    const std::string file = directories.substr(start, end - start) + "/" + program;
    if (access(file.c_str(), X_OK) == 0) return finding(program, true, file, meaning, "");
    start = end + 1;
  }
  return finding(program, false, "not found", meaning, "apt install " + package);
}

}  // namespace

std::vector<Finding> examine_realtime() {
  return {realtime_priority(), memory_lock(), kernel(), clock_source(), processors(), governor()};
}

std::vector<Finding> examine_host() {
  std::vector<Finding> findings = examine_realtime();
  findings.push_back(can_socket());
  findings.push_back(can_interfaces());
  findings.push_back(tool("tshark", "tshark", "decodes recorded bus logs as CANopen in the tests"));
  findings.push_back(
      tool("qemu-system-x86_64", "qemu-system-x86", "hil/vm: SocketCAN on machines whose kernel has no CAN"));
  return findings;
}

Json findings_json(const std::vector<Finding>& findings) {
  Json list = Json::array();
  for (const Finding& one : findings) {
    list.push_back({{"name", one.name},
                    {"good", one.good},
                    {"found", one.found},
                    {"meaning", one.meaning},
                    {"action", one.action}});
  }
  return list;
}

}  // namespace liana::report
