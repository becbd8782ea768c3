#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <map>
#include <tuple>

#include "host/apps/cli/commands.hpp"
#include "host/apps/cli/run_choice.hpp"
#include "host/apps/cli/tracker_export.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/output.hpp"
#include "host/apps/launcher/runs.hpp"
#include "host/base/event/event_json.hpp"
#include "host/base/file/in_file.hpp"
#include "host/base/json/json.hpp"
#include "host/storage/archive/check.hpp"
#include "host/storage/archive/export.hpp"
#include "host/storage/archive/reader.hpp"
#include "host/storage/archive/ring_reader.hpp"

namespace liana::cli {
namespace {

namespace fs = std::filesystem;

archive::Reader reader_of(const std::string& run) { return archive::Reader(archive_folder("log", run)); }

std::string report_text(const std::string& folder, const char* member, const char* fallback) {
  const Json report = Json::parse_or_null(file::content_of(folder + "/report.json").value_or(""));
  const Json& found = report.member_or_null(member);
  return found.is_string() ? found.text() : fallback;
}

// Which time the control ticks are of; null without any.
Json ring_json(const archive::RingReader& ring, double period_s) {
  const auto ticks = ring.recorded();
  if (!ticks) return nullptr;
  return {{"from_s", static_cast<double>(ticks->first) * period_s},
          {"to_s", static_cast<double>(ticks->last) * period_s},
          {"bytes", ring.bytes()}};
}

std::string ring_text(const Json& ring) {
  if (!ring.is_object()) return "-";
  char text[64];
  std::snprintf(text, sizeof text, "%.1f-%.1f s", ring.value("from_s", 0.0), ring.value("to_s", 0.0));
  return text;
}

// One line of the list; an archive that cannot be read says why in place of its outcome.
Json run_json(const std::string& folder) {
  Json run{{"name", fs::path(folder).filename().string()},
           {"folder", folder},
           {"mission", report_text(folder, "mission", "")},
           {"outcome", report_text(folder, "outcome", "no report")}};
  try {
    const archive::Reader reader(folder);
    const auto recorded = reader.recorded();
    run["started_utc"] = reader.life().started_utc;
    run["lives"] = reader.lives();
    run["finished"] = reader.is_finished();
    run["length_s"] = recorded ? static_cast<double>(recorded->last) * reader.life().period_s : 0.0;
    const archive::RingReader ring(folder, reader.life_number());
    run["bytes"] = reader.bytes() + ring.bytes();
    run["ring"] = ring_json(ring, reader.life().period_s);
  } catch (const std::runtime_error& error) {
    run["problem"] = error.what();
  }
  return run;
}

void print_run(const Json& run) {
  if (run.contains("problem")) {
    std::printf("%-18s %s\n", run.at("name").text().c_str(), run.at("problem").text().c_str());
    return;
  }
  std::printf("%-18s %-20s %-9s %8.1f s %7.1f MB  ticks %-16s  %s\n", run.at("name").text().c_str(),
              run.at("started_utc").text().c_str(), run.at("outcome").text().c_str(), run.value("length_s", 0.0),
              run.value("bytes", 0.0) / 1e6, ring_text(run.at("ring")).c_str(), run.at("mission").text().c_str());
}

using ByCommand = std::map<std::uint64_t, archive::Command>;

// An event with what else is known of it: of a refused command its margin and what to do.
Json shown_json(const event::Event& event, double period_s, const ByCommand& refused) {
  Json out = event::event_json(event);
  out.erase("op");
  out["time_s"] = static_cast<double>(event.tick) * period_s;
  if (event.kind != event::EventKind::kVerdict) return out;
  const auto found = refused.find(out.at("values").value("command", std::uint64_t{0}));
  if (found == refused.end()) return out;
  out["name"] = found->second.name;
  out["margin"] = found->second.margin;
  out["remedy"] = found->second.remedy;
  return out;
}

Json gap_json(const archive::Gap& gap, double period_s) {
  return {{"kind", "gap"},
          {"tick", gap.first_tick},
          {"last_tick", gap.last_tick},
          {"time_s", static_cast<double>(gap.first_tick) * period_s},
          {"subject", gap.what},
          {"count", gap.count},
          {"text", gap.what + " are missing: " + gap.text}};
}

void print_shown(const Json& line) {
  std::printf("%10.3f s  %-12s %s\n", line.value("time_s", 0.0), line.at("kind").text().c_str(),
              line.at("text").text().c_str());
  const std::string remedy = line.value("remedy", "");
  if (!remedy.empty()) std::printf("%26s what to do: %s\n", "", remedy.c_str());
}

Json ring_check_json(const archive::LifeCheck& life) {
  const archive::RingCheck& ring = life.ring;
  return {{"from_s", static_cast<double>(ring.first_tick) * life.period_s},
          {"to_s", static_cast<double>(ring.last_tick) * life.period_s},
          {"ticks", ring.ticks},
          {"full_ticks", ring.full_ticks},
          {"missing", ring.missing},
          {"images", ring.images},
          {"files", ring.files},
          {"cut_short", ring.cut_short},
          {"bytes", ring.bytes}};
}

void print_ring(const archive::LifeCheck& life) {
  const archive::RingCheck& ring = life.ring;
  std::printf("  ring: %.1f to %.1f s, %" PRIu64 " ticks, %" PRIu64 " of them with Outputs, %" PRIu64
              " missing, %" PRIu64 " files (%.1f MB)",
              static_cast<double>(ring.first_tick) * life.period_s, static_cast<double>(ring.last_tick) * life.period_s,
              ring.ticks, ring.full_ticks, ring.missing, ring.files, static_cast<double>(ring.bytes) / 1e6);
  if (ring.cut_short > 0) std::printf(", %" PRIu64 " not ended: all that is in them is good", ring.cut_short);
  std::puts("");
}

Json check_json(const archive::Check& check) {
  Json lives = Json::array();
  for (const archive::LifeCheck& life : check.lives) {
    Json gaps = Json::array();
    for (const archive::Gap& gap : life.gaps) {
      gaps.push_back({{"first_tick", gap.first_tick},
                      {"last_tick", gap.last_tick},
                      {"what", gap.what},
                      {"count", gap.count},
                      {"text", gap.text}});
    }
    lives.push_back({{"life", life.number},
                     {"finished", life.finished},
                     {"from_s", life.from_s},
                     {"to_s", life.to_s},
                     {"events", life.events},
                     {"commands", life.commands},
                     {"refused", life.refused},
                     {"records", life.records},
                     {"ring", ring_check_json(life)},
                     {"gaps", gaps}});
  }
  return {{"whole", check.problems.empty()}, {"problems", check.problems}, {"bytes", check.bytes}, {"lives", lives}};
}

void print_check(const archive::Check& check) {
  for (const std::string& problem : check.problems) std::printf("problem: %s\n", problem.c_str());
  for (const archive::LifeCheck& life : check.lives) {
    std::printf("life %" PRIu64 ": %.1f to %.1f s, %" PRIu64 " records, %" PRIu64 " events, %" PRIu64
                " commands, %" PRIu64 " refused, %zu gaps%s\n",
                life.number, life.from_s, life.to_s, life.records, life.events, life.commands, life.refused,
                life.gaps.size(), life.finished ? "" : "; its recorder still writes, or was killed");
    print_ring(life);
    for (const archive::Gap& gap : life.gaps)
      std::printf("  gap: %s, ticks %" PRIu64 " to %" PRIu64 ", %" PRIu64 ": %s\n", gap.what.c_str(), gap.first_tick,
                  gap.last_tick, gap.count, gap.text.c_str());
  }
  std::printf("%s, %.1f MB\n", check.problems.empty() ? "whole" : "NOT whole", static_cast<double>(check.bytes) / 1e6);
}

// 0 when no tick of the time was left out and none differs.
int export_ticks(const archive::Reader& reader, archive::Span span, const LogOptions& options, Json& written) {
  const archive::TicksWritten result = archive::write_ticks(reader, span, options.ticks);
  written.push_back({{"file", options.ticks},
                     {"count", result.ticks},
                     {"unit", "ticks"},
                     {"made_again", result.made_again},
                     {"left_out", result.left_out},
                     {"differing", result.differing}});
  if (!options.json) {
    std::printf("%s: %" PRIu64 " ticks, Outputs of %" PRIu64 " of them made again from their Inputs\n",
                options.ticks.c_str(), result.ticks, result.made_again);
  }
  if (result.left_out > 0) {
    std::fprintf(stderr,
                 "liana: %" PRIu64
                 " ticks were left out: their Outputs are not kept, and no image of this build goes "
                 "before them; the build that recorded makes them again, or begin later\n",
                 result.left_out);
  }
  if (result.differing > 0)
    std::fprintf(stderr, "liana: this core gives other Outputs for %" PRIu64 " ticks than they had\n",
                 result.differing);
  return result.left_out + result.differing == 0 ? launcher::kExitOk : launcher::kExitFailure;
}

std::string seconds(double value_s) {
  char text[32];
  std::snprintf(text, sizeof text, "%g s", value_s);
  return text;
}

archive::Span span_of(const LogOptions& options, const archive::Reader& reader) {
  if (options.from_s > options.to_s)
    throw launcher::BadInput("log: --from " + seconds(options.from_s) + ", --to " + seconds(options.to_s) +
                             ": nothing lies between; allowed: --from 0 to --to; exchange them");
  return reader.span_of(options.from_s, options.to_s);
}

}  // namespace

int log_list_command(const LogOptions& options) {
  Json all = Json::array();
  for (const std::string& folder : launcher::kept_runs(launcher::runs_folder())) all.push_back(run_json(folder));
  if (options.json) {
    std::puts(all.dump(-1, Json::BadUtf8::kReplace).c_str());
    return launcher::kExitOk;
  }
  for (const Json& run : all) print_run(run);
  if (all.empty())
    std::fprintf(stderr, "liana: no run is kept in %s; runs that could not be kept there said where they went\n",
                 launcher::runs_folder().empty() ? "a home folder: there is none" : launcher::runs_folder().c_str());
  return launcher::kExitOk;
}

int log_show_command(const LogOptions& options) {
  const archive::Reader reader = reader_of(options.run);
  const archive::Span span = span_of(options, reader);
  const double period_s = reader.life().period_s;
  ByCommand refused;
  for (archive::Command& command : reader.commands(span, true)) refused[command.sequence] = std::move(command);
  std::multimap<std::uint64_t, Json> lines;
  for (const event::Event& event : reader.events(span)) lines.emplace(event.tick, shown_json(event, period_s, refused));
  for (const archive::Gap& gap : reader.gaps()) {
    if (gap.last_tick >= span.first && gap.first_tick <= span.last)
      lines.emplace(gap.first_tick, gap_json(gap, period_s));
  }
  for (const auto& [tick, line] : lines) {
    if (options.json) {
      std::puts(line.dump(-1, Json::BadUtf8::kReplace).c_str());
    } else {
      print_shown(line);
    }
  }
  return launcher::kExitOk;
}

int log_export_command(const LogOptions& options) {
  using Write = std::uint64_t (*)(const archive::Reader&, archive::Span, const std::string&, double);
  const std::tuple<const char*, const char*, std::string, Write> kinds[]{
      {"--csv", "rows", options.csv, archive::write_csv},
      {"--mcap", "messages", options.mcap, archive::write_mcap},
      {"--ros2", "messages", options.ros2, archive::write_ros2},
      {"--candump", "frames", options.candump, archive::write_candump},
      {"--tracker", "rows", options.tracker, write_tracker}};
  const bool has_file = std::ranges::any_of(kinds, [](const auto& kind) { return !std::get<2>(kind).empty(); });
  if (!has_file && options.ticks.empty())
    throw launcher::BadInput("log export: no file given; give --csv, --mcap, --ros2, --candump, --tracker or --ticks");
  for (const auto& [option, unit, file, write] : kinds) {
    if (!file.empty()) launcher::check_output(option, file);
  }
  const archive::Reader reader = reader_of(options.run);
  const double zero_s = options.wall_time ? archive::begin_utc_s(reader.life()) : 0.0;
  Json written = Json::array();
  for (const auto& [option, unit, file, write] : kinds) {
    if (file.empty()) continue;
    const std::uint64_t count = write(reader, span_of(options, reader), file, zero_s);
    if (!options.json) std::printf("%s: %" PRIu64 " %s\n", file.c_str(), count, unit);
    written.push_back({{"file", file}, {"count", count}, {"unit", unit}});
  }
  const int code =
      options.ticks.empty() ? launcher::kExitOk : export_ticks(reader, span_of(options, reader), options, written);
  if (options.json) std::puts(written.dump().c_str());
  return code;
}

int log_verify_command(const LogOptions& options) {
  const archive::Check check = archive::check(reader_of(options.run).folder());
  if (options.json) {
    std::puts(check_json(check).dump(-1, Json::BadUtf8::kReplace).c_str());
  } else {
    print_check(check);
  }
  return check.problems.empty() ? launcher::kExitOk : launcher::kExitFailure;
}

}  // namespace liana::cli
