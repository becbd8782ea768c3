// liana-gateway: the console's way to lianad, for browsers and other programs (docs/reference/console-protocol.md).
#include <sys/resource.h>

#include <csignal>
#include <cstdio>
#include <optional>
#include <stdexcept>

#include "host/api/device/driver.hpp"
#include "host/apps/gateway/gateway.hpp"
#include "host/apps/gateway/web_server.hpp"
#include "host/base/clock/steady.hpp"
#include "host/base/install_paths/places.hpp"
#include "host/base/options/command_line.hpp"

namespace {

using namespace liana::gateway;

constexpr int kNice = 5;  // whatever clients do here, lianad has its turn first

struct Options {
  std::string api, devices, listen = "127.0.0.1:8765", token_file, certificate, key, runs, page, practice;
};

// Beyond this machine nobody is let in without a token, and nothing goes in the clear.
void require_safe(const Options& options, const liana::api::InternetAddress& listen) {
  if (options.certificate.empty() != options.key.empty())
    throw std::runtime_error("--cert and --key: one without the other; give both");
  if (listen.is_loopback()) return;
  const std::string where = "--listen " + options.listen + ": others than this machine can reach it: ";
  if (options.token_file.empty())
    throw std::runtime_error(where + "give --token-file (docs/reference/console-protocol.md)");
  if (options.certificate.empty()) throw std::runtime_error(where + "give --cert and --key for TLS");
}

// What fails from here on is no longer what was given.
int serve(WebServer& server) {
  try {
    server.run();
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "liana-gateway: %s\n", error.what());
    return 1;
  }
}

int run(const Options& options) {
  const liana::api::InternetAddress listen = liana::api::parse_internet_address("--listen", options.listen);
  require_safe(options, listen);
  std::optional<Tokens> tokens;
  if (!options.token_file.empty()) tokens = read_tokens(options.token_file);
  std::signal(SIGPIPE, SIG_IGN);
  ::setpriority(PRIO_PROCESS, 0, kNice);
  const std::string devices = options.devices.empty() ? liana::device::devices_path(options.api) : options.devices;
  Gateway gateway(options.api, devices, tokens ? &*tokens : nullptr, listen.is_loopback(), liana::timing::steady_s,
                  {liana::install_paths::program_folder() + "/liana", options.practice});
  const std::string page = options.page.empty() ? liana::install_paths::page_file("console.html") : options.page;
  WebServer server({listen, options.certificate, options.key, page, options.runs}, gateway);
  std::puts(server.address().c_str());
  std::fflush(stdout);
  return serve(server);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  liana::options::CommandLine line("liana-gateway: shows a running lianad to browsers");
  line.option("--api", options.api, "API socket of lianad; it need not be there yet").required();
  line.option("--devices", options.devices, "its socket for devices; .devices behind that of --api without");
  line.option("--listen", options.listen, "ADDR:PORT, port 0: a free one").with_default_shown();
  line.option("--token-file", options.token_file, "lines NAME ROLE TOKEN, mode 0600; needed beyond loopback");
  line.option("--cert", options.certificate, "certificate for TLS, PEM; needed beyond loopback");
  line.option("--key", options.key, "its key, PEM");
  line.option("--page", options.page, "file that / shows; where not given the built console");
  line.option("--runs", options.runs, "folder of recorded runs that /runs and /run/NAME show; none where not given");
  line.option("--practice", options.practice, "socket of liana-bench --practice: clients may let faults happen");
  if (const auto code = line.parse(argc, argv)) return *code;
  try {
    return run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "liana-gateway: %s\n", error.what());
    return 2;
  }
}
