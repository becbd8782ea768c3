#include "host/apps/campaign/store.hpp"

#include <fcntl.h>
#include <sys/file.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "host/apps/launcher/errors.hpp"
#include "host/model/config/canonical.hpp"

namespace liana::campaign {
namespace {

using archive::Database;
using archive::Statement;
using launcher::BadInput;

// All columns of `rows` but cpu_s are the same whenever, wherever and by however many workers they are made.
constexpr const char* kSchema = R"(
CREATE TABLE IF NOT EXISTS campaign(key TEXT PRIMARY KEY, value TEXT NOT NULL);
CREATE TABLE IF NOT EXISTS rows("row" INTEGER PRIMARY KEY, seed INTEGER NOT NULL, drawn TEXT NOT NULL,
  config_hash TEXT NOT NULL, report_hash TEXT NOT NULL, outcome TEXT NOT NULL, exit_code INTEGER NOT NULL,
  reason TEXT NOT NULL, duration_s REAL, tip_error_m REAL, min_clearance_m REAL, max_contact_force_N REAL,
  figures TEXT NOT NULL, command TEXT NOT NULL, cpu_s REAL NOT NULL);
CREATE TABLE IF NOT EXISTS kept("row" INTEGER PRIMARY KEY, folder TEXT NOT NULL, report_hash TEXT NOT NULL);
)";
constexpr const char* kInsert = "INSERT OR IGNORE INTO rows VALUES(?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)";
constexpr std::string_view kMagic("SQLite format 3\0", 16);

// Held until the process ends, however it does. Beside the database: SQLite has locks of its own in it.
api::UniqueFd lock_for(const std::string& path) {
  const std::string file = path + ".lock";
  api::UniqueFd fd(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644));
  if (fd.get() < 0) throw BadInput("--out: '" + path + "': cannot be written; give a file in a folder you may write");
  if (::flock(fd.get(), LOCK_EX | LOCK_NB) != 0)
    throw BadInput("--out: '" + path + "': another liana campaign writes it; wait for its end, or give another file");
  return fd;
}

// Other files are left as they are.
Database open_checked(const std::string& path) {
  const auto is_database = [&path] {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) return false;  // a pipe would be waited for
    std::string begin(kMagic.size(), ' ');
    std::ifstream file(path, std::ios::binary);
    return file.read(begin.data(), static_cast<std::streamsize>(begin.size())) && begin == kMagic;
  };
  std::error_code error;
  if (std::filesystem::exists(path, error) && std::filesystem::file_size(path, error) != 0 && !is_database())
    throw BadInput("--out: '" + path + "': is there, and no database of a campaign; give another file");
  return Database(path, Database::Open::kDurable);
}

std::map<std::string, std::string> facts_of(const Database& database) {
  std::map<std::string, std::string> facts;
  Statement read(database, "SELECT key, value FROM campaign");
  read.bind();
  while (read.step()) facts[read.text(0)] = read.text(1);
  return facts;
}

// Names of fields in which two tables differ.
std::string differences(const Json& a, const Json& b) {
  std::string names;
  const auto look = [&](const Json& one, const Json& other) {
    for (const auto& [key, value] : one.items()) {
      if (other.member_or_null(key) != value && names.find(key) == names.npos)
        names += (names.empty() ? "" : ", ") + key;
    }
  };
  look(a, b);
  look(b, a);
  return names;
}

void check_same(const std::string& path, const std::map<std::string, std::string>& facts, const Campaign& campaign) {
  const auto fact = [&](const char* key) {
    const auto found = facts.find(key);
    return found == facts.end() ? std::string() : found->second;
  };
  const std::string fields = differences(Json::parse_or_null(fact("table")), campaign.table);
  const std::string out = "--out: '" + path + "': was made ";
  if (!fields.empty())
    throw BadInput(out + "by another table: these fields differ: " + fields + "; give another file to --out");
  if (fact("programs") != campaign.programs)
    throw BadInput(out + "by other programs, whose rows may differ; give another file to --out");
}

double real_or_nan(const Json& figures, const char* name) {
  const Json& value = figures.member_or_null(name);
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

Store::Store(const std::string& path, const Campaign& campaign)
    : lock_(lock_for(path)), database_(open_checked(path)), insert_([&]() -> Statement {
        database_.run(kSchema);
        const std::map<std::string, std::string> facts = facts_of(database_);
        if (!facts.empty()) {
          check_same(path, facts, campaign);
          return {database_, kInsert};
        }
        archive::Transaction all(database_);
        Statement put(database_, "INSERT INTO campaign VALUES(?,?)");
        put.run("name", campaign.name);
        put.run("table", config::canonical_json(campaign.table));
        put.run("programs", campaign.programs);
        put.run("rows", std::to_string(campaign.rows));
        all.commit();
        return {database_, kInsert};
      }()) {}

std::map<std::uint64_t, std::string> Store::done() const {
  std::map<std::uint64_t, std::string> rows;
  Statement read(database_, "SELECT \"row\", config_hash FROM rows");
  read.bind();
  while (read.step()) rows[read.count(0)] = read.text(1);
  return rows;
}

std::vector<std::uint64_t> Store::failed_not_kept(std::uint64_t count) const {
  std::vector<std::uint64_t> rows;
  Statement read(database_,
                 "SELECT \"row\", \"row\" IN (SELECT \"row\" FROM kept) FROM rows WHERE outcome NOT IN ('success', "
                 "'refused') ORDER BY \"row\" LIMIT ?");
  read.bind(count);
  while (read.step()) {
    if (read.whole(1) == 0) rows.push_back(read.count(0));
  }
  return rows;
}

void Store::put(const Row& row, const std::string& command, const RowResult& result) {
  const Json& figures = result.figures;
  insert_.run(row.number, row.seed, config::canonical_json(row.values), result.config_hash, result.report_hash,
              result.outcome, result.exit_code, result.reason, real_or_nan(figures, "duration_s"),
              real_or_nan(figures, "tip_error_m"), real_or_nan(figures, "min_clearance_m"),
              real_or_nan(figures, "max_contact_force_N"), config::canonical_json(figures), command, result.cpu_s);
}

bool Store::put_kept(const RowResult& repeated, const std::string& folder) {
  Statement put(database_, "INSERT OR REPLACE INTO kept VALUES(?,?,?)");
  put.run(repeated.number, folder, repeated.report_hash);
  Statement read(database_, "SELECT report_hash FROM rows WHERE \"row\"=?");
  read.bind(repeated.number);
  return read.step() && read.text(0) == repeated.report_hash;
}

void Store::finish() { database_.finish(); }

Stored read_store(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw BadInput("'" + path + "': no such file; give the database that liana campaign has written (--out)");
  Stored stored;
  try {
    const Database database(path, Database::Open::kRead);
    const std::map<std::string, std::string> facts = facts_of(database);
    stored.campaign = {facts.at("name"), Json::parse(facts.at("table")), facts.at("programs"),
                       std::stoull(facts.at("rows"))};
    Statement read(database,
                   "SELECT rows.\"row\", seed, drawn, config_hash, rows.report_hash, outcome, exit_code, reason, "
                   "figures, command, cpu_s, folder FROM rows LEFT JOIN kept ON kept.\"row\" = rows.\"row\" "
                   "ORDER BY rows.\"row\"");
    read.bind();
    while (read.step()) {
      StoredRow row;
      row.result.number = read.count(0);
      row.result.config_hash = read.text(3);
      row.result.report_hash = read.text(4);
      row.result.outcome = read.text(5);
      row.result.exit_code = static_cast<int>(read.whole(6));
      row.result.reason = read.text(7);
      row.result.figures = Json::parse(read.text(8));
      row.result.cpu_s = read.real(10);
      row.seed = read.count(1);
      row.values = Json::parse(read.text(2));
      row.command = read.text(9);
      if (!read.is_null(11)) row.kept = read.text(11);
      stored.rows.push_back(std::move(row));
    }
  } catch (const std::exception& problem) {
    throw BadInput("'" + path + "': is no database of a campaign (" + problem.what() +
                   "); give one that liana campaign has written (--out)");
  }
  return stored;
}

}  // namespace liana::campaign
