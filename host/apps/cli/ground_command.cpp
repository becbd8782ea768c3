#include <cstdio>
#include <memory>
#include <stdexcept>

#include "host/api/ground/definitions.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/ground/ground_store.hpp"
#include "host/apps/ground/server.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/interrupt.hpp"
#include "host/apps/launcher/observer.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/base/json/json.hpp"

namespace liana::cli {
namespace {

constexpr double kMegabyte = 1e6, kHour_s = 3600.0;

ground::Sizes sizes_of_robot(const std::string& name) {
  const std::string robot = launcher::evaluate_table("robot", name);
  return launcher::checked([&] { return ground::sizes_of(Json::parse(robot)); });
}

int print_definitions(const GroundOptions& options) {
  const ground::Sizes sizes = sizes_of_robot(options.robot);
  const auto make = options.xtce ? ground::xtce : options.cosmos ? ground::cosmos : ground::ground_page;
  std::fputs(make(sizes).c_str(), stdout);
  return launcher::kExitOk;
}

// Packets carry no key.
api::InternetAddress address_of(const GroundOptions& options, const char* option, const std::string& text) {
  const api::InternetAddress address = launcher::checked([&] { return api::parse_internet_address(option, text); });
  if (address.is_loopback() || options.trusted_network) return address;
  throw launcher::BadInput(std::string(option) + " " + text +
                           ": others than this computer can reach it, and packets carry no key: allowed a loopback "
                           "address: give one, or --trusted-network");
}

ground::ServerConfig config_of(const GroundOptions& options) {
  ground::ServerConfig out;
  out.telemetry = address_of(options, "--telemetry", options.telemetry);
  out.telecommand = address_of(options, "--telecommand", options.telecommand);
  if (!options.udp_to.empty()) out.to = address_of(options, "--udp-to", options.udp_to);
  const std::vector<std::string> systems = launcher::systems_to_ask(options.api);
  if (systems.size() > 1) throw launcher::BadInput("ground: more than one system runs: name one with --api");
  out.api = systems.front();
  out.on_board = {options.silence_s, static_cast<std::size_t>(options.store_mb * kMegabyte)};
  return out;
}

void print_ports(const ground::Server& server, bool json) {
  const std::string telemetry = server.telemetry().text(), telecommand = server.telecommand().text();
  if (json) {
    std::puts(Json{{"telemetry", telemetry}, {"telecommand", telecommand}}.dump().c_str());
  } else {
    std::printf("telemetry at %s, telecommands at %s; Ctrl-C ends it\n", telemetry.c_str(), telecommand.c_str());
  }
  std::fflush(stdout);
}

}  // namespace

int ground_command(const GroundOptions& options) {
  if (options.xtce || options.cosmos || options.markdown) return print_definitions(options);
  const ground::ServerConfig config = config_of(options);
  const auto server = launcher::checked([&] { return std::make_unique<ground::Server>(config); });
  print_ports(*server, options.json);
  const launcher::InterruptGuard interrupts;
  server->run(interrupts.any());
  return launcher::kExitOk;
}

int ground_store_command(const GroundStoreOptions& options) {
  ground::StoreConfig config;
  config.file = options.file;
  config.telemetry = launcher::checked([&] { return api::parse_internet_address("--telemetry", options.telemetry); });
  config.telecommand =
      launcher::checked([&] { return api::parse_internet_address("--telecommand", options.telecommand); });
  config.keep_s = kHour_s * options.keep_h;
  std::fprintf(stderr, "liana: telemetry of %s goes to %s; Ctrl-C ends it\n", config.telemetry.text().c_str(),
               options.file.c_str());
  const launcher::InterruptGuard interrupts;
  const ground::StoreCounts counts = ground::keep_telemetry(
      config, interrupts.any(), [](const std::string& line) { std::fprintf(stderr, "liana: %s\n", line.c_str()); });
  const Json out{{"packets", counts.packets},    {"again", counts.again},   {"unreadable", counts.unreadable},
                 {"found", counts.found},        {"filled", counts.filled}, {"lost", counts.lost},
                 {"questions", counts.questions}};
  if (options.json) {
    std::puts(out.dump().c_str());
  } else {
    std::printf("%llu new packets; %llu were missing, %llu of them have come, %llu are lost\n",
                static_cast<unsigned long long>(counts.packets), static_cast<unsigned long long>(counts.found),
                static_cast<unsigned long long>(counts.filled), static_cast<unsigned long long>(counts.lost));
  }
  return counts.lost == 0 ? launcher::kExitOk : launcher::kExitFailure;
}

int ground_show_command(const GroundStoreOptions& options) {
  const ground::Sizes sizes = sizes_of_robot(options.robot);
  const auto file = launcher::checked(
      [&] { return std::make_unique<ground::PacketFile>(options.file, archive::Database::Open::kRead); });
  file->read([&](const std::string& packet) {
    const auto telemetry = ground::read_telemetry(packet);
    if (!telemetry) return;
    const Json report = ground::report_json(*telemetry, sizes);
    if (options.name.empty() || report.value("name", "") == options.name) std::puts(report.dump().c_str());
  });
  return launcher::kExitOk;
}

}  // namespace liana::cli
