// liana device list|watch: the input devices of a running system (docs/reference/device-protocol.md).
#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <thread>

#include "host/api/server/client.hpp"
#include "host/apps/cli/arguments.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/interrupt.hpp"
#include "host/apps/launcher/observer.hpp"
#include "host/base/json/json.hpp"

namespace liana::cli {
namespace {

// One lianad, asked again and again.
class Asked {
 public:
  explicit Asked(const std::string& api) : client_(api::ApiClient::connect(api, kConnectTimeout_s)) {
    launcher::say_hello(client_, "liana device", launcher::Observer::kBlind);
  }
  // Throws std::runtime_error, also for an arm that has no devices.
  Json devices() {
    client_.send({{"op", "devices"}, {"id", 1}});
    const auto answer = launcher::wait_for(client_, "ok", kAnswerTimeout_s);
    if (!answer)
      throw std::runtime_error("lianad runs but did not answer within 5 s: see docs/how-to/nothing-answers.md");
    return answer->at("devices");
  }

 private:
  api::ApiClient client_;
};

// A number with its unit, or that it is not known.
std::string shown(const Json& value, double units, const char* unit) {
  if (!value.is_number()) return "-";
  char text[40];
  std::snprintf(text, sizeof text, "%.1f %s", units * value.get<double>(), unit);
  return text;
}

void print_row(const Json& device) {
  const Json& hand = device.at("hands")[0];
  std::printf("%-24s %-8s %5zu  %10s  %9s  %9s  %7.1f N  %s\n", device.at("name").text().c_str(),
              device.at("kind").text().c_str(), device.at("hands").size(),
              shown(device.at("rate_hz"), 1.0, "Hz").c_str(), shown(device.at("delay_up_s"), 1e3, "ms").c_str(),
              shown(device.at("delay_down_s"), 1e3, "ms").c_str(), hand.at("max_force_N").get<double>(),
              device.at("in_use").get<bool>() ? "in use" : "");
}

void print_list(const std::string& api, const Json& devices) {
  std::printf("%s: %zu devices\n", api.c_str(), devices.size());
  if (devices.size() == 0) return;
  std::printf("%-24s %-8s %5s  %10s  %9s  %9s  %9s\n", "name", "kind", "hands", "rate", "up", "down", "force");
  for (const Json& device : devices) print_row(device);
}

const Json& find(const Json& devices, const std::string& name) {
  std::string names;
  for (const Json& device : devices) {
    if (device.at("name").text() == name) return device;
    names += (names.empty() ? "" : ", ") + device.at("name").text();
  }
  throw std::runtime_error("NAME: '" + name + "': not connected; connected: " + (names.empty() ? "none" : names));
}

void print_hand(std::size_t number, const Json& hand) {
  const Json& sample = hand.at("sample");
  if (sample.is_null()) return (void)std::printf("hand %zu  no sample yet\n", number);
  const Json& pose = sample.at("measured_cp");
  std::printf("hand %zu  %12.3f s  %-4s  %-7s  trigger %.2f  %8.4f %8.4f %8.4f m  %7.4f %7.4f %7.4f %7.4f\n", number,
              1e-6 * sample.at("t_us").get<double>(), sample.at("valid").get<bool>() ? "seen" : "lost",
              sample.at("deadman").get<bool>() ? "held" : "open", sample.at("trigger").get<double>(),
              pose[0].get<double>(), pose[1].get<double>(), pose[2].get<double>(), pose[3].get<double>(),
              pose[4].get<double>(), pose[5].get<double>(), pose[6].get<double>());
}

void print_device(const Json& device) {
  for (std::size_t i = 0; i < device.at("hands").size(); ++i) print_hand(i, device.at("hands")[i]);
}

}  // namespace

int device_list_command(const DeviceOptions& options) {
  int code = launcher::kExitOk;
  for (const std::string& api : launcher::systems_to_ask(options.api)) {
    try {
      const Json devices = Asked(api).devices();
      if (options.json) {
        std::puts(Json{{"api", api}, {"devices", devices}}.dump().c_str());
      } else {
        print_list(api, devices);
      }
    } catch (const std::exception& error) {
      std::fprintf(stderr, "liana: %s: %s\n", api.c_str(), error.what());
      code = launcher::kExitFailure;
    }
  }
  return code;
}

int device_watch_command(const DeviceOptions& options) {
  const double period_s = 1.0 / parse_number_in("--rate", options.rate_hz, 0.1, 50.0, "Hz");
  const double seconds = parse_number_in("--seconds", options.seconds, 0.1, 86400.0, "s");
  const std::vector<std::string> systems = launcher::systems_to_ask(options.api);
  if (systems.size() > 1) throw launcher::BadInput("--api: more than one system runs: give the socket of one");
  Asked asked(systems.front());
  const launcher::InterruptGuard interrupts;
  for (double at_s = 0.0; at_s < seconds && interrupts.count() == 0; at_s += period_s) {
    const Json devices = asked.devices();
    const Json& device = find(devices, options.name);
    if (options.json) {
      std::puts(device.dump().c_str());
    } else {
      print_device(device);
    }
    std::fflush(stdout);
    std::this_thread::sleep_for(std::chrono::duration<double>(period_s));
  }
  return launcher::kExitOk;
}

}  // namespace liana::cli
