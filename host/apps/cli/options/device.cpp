// Options of the commands about input devices: device list, watch.
#include "host/apps/cli/commands.hpp"
#include "host/apps/cli/options/options.hpp"

namespace liana::cli {
namespace {

void add_api(CLI::App& sub, DeviceOptions& device) {
  sub.add_option("--api", device.api,
                 "API socket of lianad; where not given, that of the one running system of this user");
  add_json(sub, device.json);
}

}  // namespace

void declare_device(CLI::App& app, Action& action) {
  CLI::App& group = add_group(app, "device");
  auto [list, listed] = add<DeviceOptions>(group, action, "list", device_list_command);
  add_api(list, listed);
  auto [watch, watched] = add<DeviceOptions>(group, action, "watch", device_watch_command);
  watch.add_option("name", watched.name, "of the device, as device list says it")->required();
  watch.add_option("--rate", watched.rate_hz, "how often, Hz; 0.1 to 50")->capture_default_str();
  watch.add_option("--seconds", watched.seconds, "how long; 0.1 to 86400")->capture_default_str();
  add_api(watch, watched);
}

}  // namespace liana::cli
