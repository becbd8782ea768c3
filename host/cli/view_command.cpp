// The page of a run, or of what runs.
#include <cstdio>
#include <filesystem>

#include "host/cli/commands.hpp"
#include "host/json/json.hpp"
#include "host/system/errors.hpp"
#include "host/system/runs.hpp"
#include "host/view/run_folder.hpp"

namespace liana::cli {
namespace {

namespace fs = std::filesystem;

std::string newest_run() {
  const std::vector<std::string> runs = system::kept_runs(system::runs_folder());
  if (runs.empty())
    throw system::BadInput("view: '" + system::runs_folder() + "' keeps no run yet; run a mission, or name its folder");
  return runs.front();
}

std::string folder_of(const std::string& run) {
  if (run.empty()) return newest_run();
  const std::string kept = system::runs_folder() + "/" + run;
  if (!fs::exists(run) && fs::exists(kept)) return kept;
  if (!fs::is_directory(run)) throw system::BadInput("view: '" + run + "': is no folder of a run (liana log list)");
  return run;
}

int show_live(const ViewOptions& options) {
  ConsoleOptions console;
  console.api = options.api;
  console.json = options.json;
  return console_command(console);
}

}  // namespace

int view_command(const ViewOptions& options) {
  if (options.live) return show_live(options);
  const std::string folder = folder_of(options.run);
  if (!view::is_page_built())
    throw system::BadInput("view: the page is not built (" + view::built_page() +
                           " is missing): ./dev view builds it, which takes npm");
  const std::string file = options.out_file.empty() ? folder + "/page.html" : options.out_file;
  std::size_t bytes = 0;
  try {
    bytes = view::write_page(folder, file);
  } catch (const std::runtime_error& error) {
    throw system::BadInput("view: " + std::string(error.what()));
  }
  if (options.json) {
    std::puts(Json{{"run", folder}, {"page", fs::absolute(file).string()}, {"bytes", bytes}}.dump().c_str());
  } else {
    std::puts(fs::absolute(file).c_str());
  }
  return system::kExitOk;
}

}  // namespace liana::cli
