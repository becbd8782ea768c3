// The console of a running system, or of a simulated arm that it starts.
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <thread>

#include "host/apps/cli/commands.hpp"
#include "host/apps/launcher/console_session.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/interrupt.hpp"
#include "host/apps/launcher/system_layout.hpp"
#include "host/base/json/json.hpp"

namespace liana::cli {
namespace {

constexpr auto kLook = std::chrono::milliseconds(50);

void tell(const ConsoleOptions& options, const std::string& api, const std::string& address) {
  if (options.json) {
    std::puts(Json{{"api", api}, {"address", address}}.dump().c_str());
  } else {
    std::printf("console of %s; Ctrl-C ends it\n%s\n", api.c_str(), address.c_str());
  }
  std::fflush(stdout);
}

// For the gateway's log.
class Folder {
 public:
  Folder() : path_(launcher::temporary_directory()) {}
  ~Folder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string file(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

// Nothing of the system belongs to us: it goes on when the console ends.
int attach(const ConsoleOptions& options, const std::string& api) {
  const launcher::InterruptGuard interrupts;
  const Folder folder;
  const launcher::GatewayProcess gateway(api, options.gateway, folder.file("liana-gateway.log"));
  tell(options, api, gateway.address());
  while (interrupts.count() == 0) std::this_thread::sleep_for(kLook);
  return launcher::kExitOk;
}

void simulate_and_show(const ConsoleOptions& options, const launcher::SystemLayout& plan) {
  launcher::ConsoleSession session(plan);
  session.start();
  launcher::GatewayOptions with = options.gateway;
  with.practice = plan.practice_socket();
  const launcher::GatewayProcess gateway(plan.api_socket(), with, plan.file("liana-gateway.log"));
  tell(options, plan.api_socket(), gateway.address());
  while (session.go_on()) {
  }
}

int simulate(const ConsoleOptions& options) {
  launcher::RunOptions run = options.wish.run;
  run.time = "paced";
  run.is_session = run.is_practice = true;
  const launcher::SystemLayout plan = launcher::make_layout(run);
  try {
    simulate_and_show(options, plan);
  } catch (const launcher::BadInput&) {
    launcher::discard(plan);
    throw;
  } catch (...) {
    std::fprintf(stderr, "liana: logs are kept in %s\n", plan.directory.c_str());
    throw;
  }
  launcher::clean_up(plan, true);
  std::fprintf(stderr, "recorded in %s; liana view makes a page of it\n", plan.directory.c_str());
  return launcher::kExitOk;
}

}  // namespace

int console_command(const ConsoleOptions& options) {
  const std::string api = system_to_join("console", options.wish);
  return api.empty() ? simulate(options) : attach(options, api);
}

}  // namespace liana::cli
