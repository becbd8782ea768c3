// The page of a run, or of what runs.
#include <cstdio>
#include <filesystem>

#include "host/apps/cli/commands.hpp"
#include "host/apps/cli/run_choice.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/output.hpp"
#include "host/apps/run_page/run_folder.hpp"
#include "host/base/install_paths/places.hpp"
#include "host/base/json/json.hpp"

namespace liana::cli {
namespace {

namespace fs = std::filesystem;

int show_live(const ViewOptions& options) {
  ConsoleOptions console;
  console.wish.api = options.api;
  console.json = options.json;
  return console_command(console);
}

}  // namespace

int view_command(const ViewOptions& options) {
  if (options.live) return show_live(options);
  if (!options.out_file.empty()) launcher::check_output("--out", options.out_file);
  const std::string folder = options.run.empty() ? last_ended_run("view") : archive_folder("view", options.run);
  if (!run_page::is_page_built())
    throw launcher::BadInput("view: the page is not built (" + run_page::built_page() + " is missing): " +
                             (install_paths::is_installed()
                                  ? "it was not there when Liana was installed: build it, then install again"
                                  : "./dev view builds it, which takes npm"));
  const std::string file = options.out_file.empty() ? folder + "/page.html" : options.out_file;
  const std::size_t bytes = run_page::write_page(folder, file);
  if (options.json) {
    std::puts(Json{{"run", folder}, {"page", fs::absolute(file).string()}, {"bytes", bytes}}.dump().c_str());
  } else {
    std::puts(fs::absolute(file).c_str());
  }
  return launcher::kExitOk;
}

}  // namespace liana::cli
