#include "host/storage/archive/reader.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>

#include "host/api/telemetry/record.hpp"
#include "host/base/event/event_json.hpp"
#include "host/base/json/json.hpp"
#include "host/storage/archive/chunk.hpp"
#include "host/storage/archive/facts_change.hpp"
#include "host/storage/archive/schema.hpp"
#include "host/storage/archive/segments.hpp"

namespace liana::archive {
namespace {

namespace fs = std::filesystem;

std::string folder_of(const std::string& path) {
  const fs::path folder = fs::is_directory(path) ? fs::path(path) : fs::path(path).parent_path();
  if (!fs::exists(folder / kArchiveFile))
    throw std::runtime_error("'" + path + "': holds no " + kArchiveFile + "; give the folder of a run");
  return folder.empty() ? "." : folder.string();
}

// Files that may hold something of the span: each ends where the next one begins.
std::vector<Segment> touched(const std::string& folder, std::uint64_t life, Span span) {
  std::vector<Segment> all = segments_in(folder), found;
  std::erase_if(all, [&](const Segment& each) { return each.life != life; });
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool ends_before = i + 1 < all.size() && all[i + 1].first_tick <= span.first;
    if (!ends_before && all[i].first_tick <= span.last) found.push_back(all[i]);
  }
  return found;
}

event::Event event_of(const Statement& row) {
  return event::event_from_json({{"sequence", row.count(0)},
                                 {"tick", row.count(1)},
                                 {"kind", row.text(2)},
                                 {"number", row.whole(3)},
                                 {"subject", row.text(4)},
                                 {"values", Json::parse(row.text(5))},
                                 {"text", row.text(6)}});
}

void add_records(const Statement& row, Span span, std::size_t bytes, std::vector<std::string>& out) {
  constexpr std::uint64_t kMaxRecords = 1 << 16;  // of a second
  if (row.count(0) > kMaxRecords)
    throw std::runtime_error("a second of telemetry has " + std::to_string(row.count(0)) + " records; allowed are " +
                             std::to_string(kMaxRecords) + ": take a good copy of the file");
  const std::string records = unpacked(row.text(1), row.count(0), bytes);
  for (std::size_t at = 0; at < records.size(); at += bytes) {
    std::string record = records.substr(at, bytes);
    const auto tick = static_cast<std::uint64_t>(telemetry::header_of(record).tick);
    if (tick >= span.first && tick <= span.last) out.push_back(std::move(record));
  }
}

// Those that hold at the begin of the span replace earlier ones; those that a file repeats at its begin are left out.
void add_facts(const Statement& row, Span span, std::vector<Facts>& out) {
  Facts facts{row.count(0), static_cast<std::uint32_t>(row.whole(1)), Json::parse(row.text(3))};
  if (!out.empty() && out.back().number == facts.number) return;
  if (row.whole(2) == 0 && !out.empty()) facts.state = with_change(out.back().state, facts.state);
  if (out.size() == 1 && facts.tick <= span.first) out.clear();
  out.push_back(std::move(facts));
}

}  // namespace

Reader::Reader(const std::string& path, std::uint64_t life)
    : folder_(folder_of(path)), database_(folder_ + "/" + kArchiveFile, Database::Open::kRead) {
  if (const auto version = count("PRAGMA user_version"); version != 1)
    throw std::runtime_error(database_.path() + ": version " + std::to_string(version) +
                             ": this program reads 1; read it with the Liana that wrote it");
  lives_ = count("SELECT count(*) FROM life");
  read_life(life == 0 ? lives_ : life);
}

std::uint64_t Reader::count(const std::string& sql) const {
  Statement statement(database_, sql);
  return statement.step() ? statement.count(0) : 0;
}

void Reader::read_life(std::uint64_t life) {
  Statement row(database_,
                "SELECT config_hash, robot, scene, buses, time_mode, period_s, started_utc, made_by, layout, finished "
                "FROM life WHERE id=?");
  row.bind(life);
  if (!row.step())
    throw std::runtime_error(database_.path() + ": life " + std::to_string(life) + ": there are " +
                             std::to_string(lives_));
  life_number_ = life;
  life_ = {row.text(0), row.text(1), row.text(2), row.text(3), row.text(4), row.real(5), row.text(6), row.text(7)};
  finished_ = row.whole(9) != 0;
  if (!row.is_null(8)) layout_ = telemetry::layout_from(Json::parse(row.text(8)));
}

// Without those whose writer was killed before they held anything.
std::vector<Database> Reader::telemetry_of(Span span) const {
  std::vector<Database> found;
  for (const Segment& file : touched(folder_, life_number_, span)) {
    Database database(file.path, Database::Open::kRead);
    Statement version(database, "PRAGMA user_version");
    if (version.step() && version.whole(0) != 0) found.push_back(std::move(database));
  }
  return found;
}

std::optional<Span> Reader::recorded() const {
  std::optional<Span> all;
  for (const Database& database : telemetry_of(kAll)) {
    Statement ends(database, "SELECT min(first_tick), max(last_tick) FROM telemetry");
    if (!ends.step() || ends.is_null(0)) continue;
    if (!all) all = Span{ends.count(0), 0};
    all->last = ends.count(1);
  }
  return all;
}

std::vector<event::Event> Reader::events(Span span) const {
  std::vector<event::Event> out;
  Statement row(database_,
                "SELECT sequence, tick, kind, number, subject, values_json, text FROM event "
                "WHERE life=? AND tick BETWEEN ? AND ? ORDER BY sequence");
  row.bind(life_number_, span.first, span.last);
  while (row.step()) out.push_back(event_of(row));
  return out;
}

std::vector<Command> Reader::commands(Span span, bool only_refused) const {
  std::vector<Command> out;
  Statement row(database_,
                "SELECT sequence, tick, released, code, share, name, text, remedy, margin FROM command "
                "WHERE life=? AND tick BETWEEN ? AND ? AND released <= ? ORDER BY sequence");
  row.bind(life_number_, span.first, span.last, only_refused ? 0 : 1);
  while (row.step()) {
    out.push_back({row.count(0), row.count(1), row.whole(2) != 0, static_cast<int>(row.whole(3)), row.real(4),
                   row.text(5), row.text(6), row.text(7), row.text(8)});
  }
  return out;
}

std::vector<Gap> Reader::gaps() const {
  std::vector<Gap> out;
  Statement row(database_, "SELECT first_tick, last_tick, what, count, text FROM gap WHERE life=? ORDER BY first_tick");
  row.bind(life_number_);
  while (row.step()) out.push_back({row.count(0), row.count(1), row.text(2), row.count(3), row.text(4)});
  return out;
}

std::vector<std::string> Reader::telemetry(Span span) const {
  std::vector<std::string> out;
  for (const Database& database : telemetry_of(span)) {
    Statement row(database,
                  "SELECT count, records FROM telemetry WHERE first_tick >= ifnull((SELECT max(first_tick) FROM "
                  "telemetry WHERE first_tick <= ?), 0) AND first_tick <= ? ORDER BY first_tick");
    row.bind(span.first, span.last);
    while (row.step()) add_records(row, span, layout_->bytes, out);
  }
  return out;
}

std::vector<Facts> Reader::facts(Span span) const {
  std::vector<Facts> out;
  for (const Database& database : telemetry_of(span)) {
    Statement row(
        database,
        "SELECT tick, number, whole, state FROM facts WHERE tick >= ifnull((SELECT max(tick) FROM facts WHERE "
        "tick <= ? AND whole), 0) AND tick <= ? ORDER BY tick");
    row.bind(span.first, span.last);
    while (row.step()) add_facts(row, span, out);
  }
  return out;
}

Counts Reader::counts() const {
  const std::string life = " WHERE life=" + std::to_string(life_number_);
  return {count("SELECT count(*) FROM event" + life), count("SELECT count(*) FROM command" + life),
          count("SELECT count(*) FROM command" + life + " AND released=0")};
}

std::vector<std::string> Reader::missing_files() const {
  std::vector<std::uint64_t> first_ticks;
  if (count("SELECT count(*) FROM sqlite_master WHERE name='telemetry_file'") != 0) {
    Statement row(database_,
                  "SELECT first_tick FROM telemetry_file AS file WHERE life=? AND NOT EXISTS (SELECT * FROM gap WHERE "
                  "gap.life=file.life AND gap.what='telemetry' AND gap.first_tick=file.first_tick AND gap.count=0)");
    row.bind(life_number_);
    while (row.step()) first_ticks.push_back(row.count(0));
  }
  std::vector<std::string> missing;
  for (const std::uint64_t first_tick : first_ticks) {
    const fs::path file = segment_path(folder_, life_number_, first_tick);
    if (!fs::exists(file)) missing.push_back(file.filename());
  }
  const bool has_any = !touched(folder_, life_number_, kAll).empty();
  const bool is_explained = std::ranges::any_of(gaps(), [](const Gap& gap) { return gap.what == "telemetry"; });
  if (first_ticks.empty() && layout_ && finished_ && !has_any && !is_explained)
    missing.push_back("telemetry-" + std::to_string(life_number_) + "-*.db");
  return missing;
}

std::uint64_t Reader::bytes() const {
  std::vector<Segment> files = segments_in(folder_);
  files.push_back({0, 0, database_.path()});
  return bytes_of(files);
}

std::vector<std::string> Reader::problems() const {
  std::vector<std::string> found{database_.problem(false)};
  for (const Segment& file : segments_in(folder_)) {
    try {
      found.push_back(Database(file.path, Database::Open::kRead).problem(false));
    } catch (const DatabaseError& error) {
      found.push_back(error.what());
    }
  }
  std::erase(found, "");
  return found;
}

Span Reader::span_of(double from_s, double to_s) const {
  const auto tick = [this](double seconds) {
    return static_cast<std::uint64_t>(std::clamp(std::round(seconds / life_.period_s), 0.0, 1e15));
  };
  return {tick(from_s), tick(to_s)};
}

}  // namespace liana::archive
