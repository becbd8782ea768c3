// A whole embedded bus inside one test: the bus in a thread, the controller's end, and a plant that speaks raw packets.
#pragma once

#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "host/drives/bus/drive_bus.hpp"
#include "host/drives/bus_simulator/bus_hub.hpp"

namespace liana::test {

// Two buses at 250 Hz with one node on each.
config::BusesConfig small_table();

// What the bus did, once it has ended.
struct BusOutcome {
  std::string end_reason;
  std::uint64_t now_ns = 0;
  std::vector<bus_simulator::WireStats> stats;
};

// A bus process without the process. Ends, and is joined, when its participants have left.
class BusThread {
 public:
  BusThread(const config::BusesConfig& table, timing::TimeMode mode, const std::string& log_directory = "",
            bus_simulator::FaultScript script = {});
  ~BusThread();
  const std::string& socket_path() const { return path_; }
  // Waits for the end.
  const BusOutcome& outcome();

 private:
  std::string path_;
  BusOutcome outcome_;
  std::thread thread_;
};

// A plant: connects, and answers every WAKE with what `react` returns. Ends when the bus does, or after `leave_after`
// wakes.
class PlantThread {
 public:
  using React = std::function<std::vector<wire::Frame>(const wire::Wake&)>;
  PlantThread(const std::string& socket_path, React react, int leave_after = -1);
  ~PlantThread();

 private:
  std::thread thread_;
};

// Connects to a bus that may not listen yet; -1 after five seconds.
int connect_patiently(const std::string& path);

// Says HELLO in that role on a connected socket.
void say_hello(int descriptor, wire::Role role);

// A fresh directory for this test.
std::string fresh_directory(const std::string& name);

std::string read_file(const std::string& path);

}  // namespace liana::test
