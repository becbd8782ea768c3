// liana-spacemouse: a SpaceMouse as an input device of lianad (docs/reference/device-protocol.md).
#include <poll.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <thread>

#include "host/api/device/driver.hpp"
#include "host/base/clock/steady.hpp"
#include "host/base/options/command_line.hpp"
#include "host/operator/spacemouse/spacenav.hpp"

namespace liana::spacemouse {
namespace {

constexpr double kRate_hz = 100.0;
constexpr std::int64_t kPeriod_us = 10'000;
constexpr std::int64_t kLate_us = 50'000;
constexpr double kConnectTimeout_s = 5.0;
constexpr std::uint64_t kNoButton = 32;

volatile std::sig_atomic_t g_over = 0;

struct SpacemouseOptions {
  std::string api, devices, name = "spacemouse";
  std::uint64_t button = kNoButton;
  PuckTable puck;
};

void check_range(const char* option, double value, double low, double high) {
  if (value >= low && value <= high) return;
  char text[120];
  std::snprintf(text, sizeof text, "%s: %g: allowed %g to %g", option, value, low, high);
  throw std::runtime_error(text);
}

void check(const SpacemouseOptions& options) {
  check_range("--speed", options.puck.speed_m_s, 0.001, 1.0);
  check_range("--turn", options.puck.turn_rad_s, 0.01, 5.0);
  check_range("--button", static_cast<double>(options.button), 0.0, 32.0);
  if (options.api.empty() == options.devices.empty())
    throw std::runtime_error("--api, --devices: allowed is one of them: give lianad's API socket, or that of devices");
}

device::Capability capability(const SpacemouseOptions& options) {
  device::Capability out{.name = options.name, .kind = device::Kind::kPointer, .rate_hz = kRate_hz};
  out.hand[0] = {LIANA_ALL_AXES | LIANA_TWIST, 0, 32, 0, {-9.0, -9.0, -9.0}, {9.0, 9.0, 9.0}, 0.0, 0.0};
  return out;
}

void sleep_until(std::int64_t due_us) {
  const std::int64_t left_us = due_us - timing::steady_us();
  if (left_us > 0) std::this_thread::sleep_for(std::chrono::microseconds(left_us));
}

// What fails from here on is no longer what was given.
void serve(Spacenav& spacenav, device::Driver& driver, const PuckTable& table) {
  Puck puck(table);
  for (std::int64_t due_us = timing::steady_us(); g_over == 0; due_us += kPeriod_us) {
    sleep_until(due_us);
    if (!spacenav.read(puck)) throw std::runtime_error("spacenavd is gone; the arm holds");
    const std::int64_t t_us = timing::steady_us();
    driver.receive(t_us);
    if (!driver.is_open()) throw std::runtime_error(driver.problem());
    driver.send(puck.step(t_us, 1.0 / kRate_hz));
    if (t_us - due_us > kLate_us) due_us = t_us;  // the hand does not make up for a pause
  }
  driver.leave();
}

int run(SpacemouseOptions options) {
  check(options);
  if (options.button != kNoButton) options.puck.button = static_cast<int>(options.button);
  Spacenav spacenav;
  const std::string path = options.devices.empty() ? device::devices_path(options.api) : options.devices;
  device::Driver driver = device::Driver::connect(path, capability(options), timing::steady_us(), kConnectTimeout_s);
  for (const int signal : {SIGTERM, SIGINT}) std::signal(signal, [](int) { g_over = 1; });
  try {
    serve(spacenav, driver, options.puck);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "liana-spacemouse: %s\n", error.what());
    return 1;
  }
}

}  // namespace
}  // namespace liana::spacemouse

int main(int argc, char** argv) {
  liana::spacemouse::SpacemouseOptions options;
  liana::options::CommandLine line("liana-spacemouse: a SpaceMouse, through spacenavd, as an input device of lianad");
  line.option("--api", options.api, "API socket of lianad, beside which its socket of devices is");
  line.option("--devices", options.devices, "in place of --api: the socket of devices");
  line.option("--name", options.name, "of the device at lianad").with_default_shown();
  line.option("--speed", options.puck.speed_m_s, "of the hand with the puck pushed all the way, m/s; 0.001 to 1")
      .with_default_shown();
  line.option("--turn", options.puck.turn_rad_s, "the same of its turning, rad/s; 0.01 to 5").with_default_shown();
  line.option("--button", options.button, "button that is the deadman, 0 to 31; 32: the puck itself, while it is moved")
      .with_default_shown();
  if (const auto code = line.parse(argc, argv)) return *code;
  try {
    return liana::spacemouse::run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "liana-spacemouse: %s\n", error.what());
    return 2;
  }
}
