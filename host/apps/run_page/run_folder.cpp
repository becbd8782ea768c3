#include "host/apps/run_page/run_folder.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "host/base/event/event_json.hpp"
#include "host/base/file/in_file.hpp"
#include "host/base/file/out_file.hpp"
#include "host/base/install_paths/places.hpp"
#include "host/storage/archive/reader.hpp"

namespace liana::run_page {
namespace {

namespace fs = std::filesystem;

std::string text_of(const std::string& file) {
  const auto text = file::content_of(file);
  if (!text) throw std::runtime_error("'" + file + "': cannot be read");
  return *text;
}

// A run whose mission is known is called by it, any other one by when it began.
std::string title_of(const Json& report, const archive::Life& life) {
  const std::string mission = report.is_object() ? report.value("mission", "") : "";
  if (mission.empty()) return "run of " + life.started_utc;
  return fs::path(mission).stem().string() + ", seed " + report.at("seed").dump();
}

void read_archive(const archive::Reader& reader, RunData& run) {
  const archive::Life& life = reader.life();
  run.robot = Json::parse(life.robot);
  run.scene = Json::parse(life.scene);
  run.buses = Json::parse(life.buses);
  run.period_s = life.period_s;
  for (const event::Event& event : reader.events()) run.events.push_back(event::event_json(event));
  if (!reader.layout()) return;
  run.layout = *reader.layout();
  run.records = reader.telemetry();
  for (archive::Facts& facts : reader.facts()) run.facts.emplace_back(facts.tick, std::move(facts.state));
}

}  // namespace

RunData run_in(const std::string& folder) {
  if (!fs::exists(folder + "/archive.db"))
    throw std::runtime_error("'" + folder + "': has no archive.db; give the folder of a run (liana log list)");
  const archive::Reader reader(folder);
  RunData run;
  read_archive(reader, run);
  const std::string report = folder + "/report.json", truth = folder + "/truth.bin";
  if (fs::exists(report)) run.report = Json::parse_or_null(text_of(report));
  run.title = title_of(run.report, reader.life());
  file::require_ordinary(folder + "/commands.txt");
  std::ifstream commands(folder + "/commands.txt");
  std::size_t unread = 0;
  run.commands = report::command_lives(commands, unread);
  if (fs::exists(truth)) run.truth = report::TruthLog::load(truth);
  if (const std::string core = install_paths::page_file("core.wasm"); fs::exists(core)) {
    run.core = text_of(core);
    run.ticks = recorded_ticks_in(folder, run.robot.value("kind", "") == "serial");
  }
  return run;
}

std::string built_page() { return install_paths::page_file("view.html"); }

bool is_page_built() { return fs::exists(built_page()); }

std::size_t write_page(const std::string& folder, const std::string& path) {
  const std::string page = page_of(run_in(folder), text_of(built_page()));
  file::OutFile out(path);
  out.write(page);
  out.finish();
  return page.size();
}

}  // namespace liana::run_page
