#include "tests/host/drives/bus/embedded_bench.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <atomic>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "host/drives/bus_simulator/bus_listener.hpp"

namespace liana::test {

config::BusesConfig small_table() {
  config::BusesConfig config;
  config.name = "small";
  config.backend = "embedded";
  config.rate_hz = 250;
  config.command_interval_s = 0.02;
  config.heartbeat_ms = 100;
  config.max_load = 0.75;
  config.buses = {{"can0", 1000000, {1}}, {"can1", 500000, {2}}};
  return config;
}

BusThread::BusThread(const config::BusesConfig& table, timing::TimeMode mode, const std::string& log_directory,
                     bus_simulator::FaultScript script) {
  static std::atomic<int> count = 0;
  path_ = "/tmp/liana-bus-test-" + std::to_string(getpid()) + "-" + std::to_string(count++);
  bus_simulator::BusHubOptions options;
  options.time_mode = mode;
  options.period_us = static_cast<std::uint32_t>(table.period_us());
  options.script = std::move(script);
  options.log_directory = log_directory;
  for (const config::BusConfig& bus : table.buses)
    options.wires.push_back({bus.name, static_cast<std::uint32_t>(bus.bitrate)});
  thread_ = std::thread([this, options] {
    bus_simulator::BusHub hub(options, bus_simulator::admit_participants(path_, bus_simulator::welcome_of(options)));
    if (options.time_mode == timing::TimeMode::kReal) {
      bus_simulator::run_real(hub);
    } else {
      bus_simulator::run_lockstep(hub, options.time_mode == timing::TimeMode::kPaced);
    }
    outcome_ = {hub.end_reason(), hub.now_ns, {}};
    for (std::size_t b = 0; b < options.wires.size(); ++b) outcome_.stats.push_back(hub.sim().stats(b));
  });
}

BusThread::~BusThread() {
  if (thread_.joinable()) thread_.join();
}

const BusOutcome& BusThread::outcome() {
  if (thread_.joinable()) thread_.join();
  return outcome_;
}

int connect_patiently(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, path.c_str(), path.size());
  for (int attempt = 0; attempt < 500; ++attempt) {
    const int descriptor = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
    if (connect(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return descriptor;
    close(descriptor);
    usleep(10000);
  }
  return -1;
}

void say_hello(int descriptor, wire::Role role) {
  wire::Hello hello;
  hello.role = role;
  std::strncpy(hello.name.data(), role == wire::Role::kPlant ? "plant" : "controller", hello.name.size() - 1);
  send(descriptor, &hello, sizeof hello, MSG_NOSIGNAL);
}

PlantThread::PlantThread(const std::string& socket_path, React react, int leave_after)
    : thread_([socket_path, react = std::move(react), leave_after] {
        const int descriptor = connect_patiently(socket_path);
        say_hello(descriptor, wire::Role::kPlant);
        wire::Welcome welcome;
        recv(descriptor, &welcome, sizeof welcome, 0);
        wire::Wake wake;
        for (int wakes = 0; wakes != leave_after; ++wakes) {
          if (recv(descriptor, &wake, sizeof wake, 0) <= 0 || (wake.flags & wire::kWakeShutdown) != 0) break;
          wire::Yield yield;
          yield.flags = wire::kYieldWakeOnSync;
          yield.until_us = (std::uint64_t{wake.slot} + 2) * welcome.period_us;
          for (const wire::Frame& frame : react(wake)) yield.frame[yield.frame_count++] = frame;
          if (welcome.time_mode == 2 && yield.frame_count == 0) continue;
          send(descriptor, &yield, yield.size(), MSG_NOSIGNAL);
        }
        close(descriptor);
      }) {}

PlantThread::~PlantThread() { thread_.join(); }

std::string fresh_directory(const std::string& name) {
  const std::string path =
      std::filesystem::temp_directory_path().string() + "/" + name + "-" + std::to_string(getpid());
  std::filesystem::remove_all(path);
  std::filesystem::create_directories(path);
  return path;
}

std::string read_file(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

}  // namespace liana::test
