#include "host/apps/campaign/rows.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/output.hpp"
#include "host/apps/launcher/system_layout.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/base/random/random.hpp"
#include "host/model/config/canonical.hpp"
#include "host/model/config/config.hpp"
#include "host/model/config/field.hpp"
#include "host/model/config/serial_robot.hpp"
#include "host/model/config/sha256.hpp"

namespace liana::campaign {
namespace {

namespace fs = std::filesystem;
using config::Distribution;
using launcher::BadInput;

constexpr int kMaxRedraws = 100'000;
const std::set<std::string> kFileOptions{"robot", "scene", "bus", "faults", "calibration"};

// FNV-1a: keys with different names have different streams.
std::uint64_t purpose_of(std::string_view key) {
  std::uint64_t hash = 0xCBF29CE484222325ULL;
  for (const char c : key) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3ULL;
  return hash;
}

double normal_within(const Distribution& given, simulated::RandomStream& stream) {
  for (int i = 0; i < kMaxRedraws; ++i) {
    const double value = given.mean + stream.normal(given.sd);
    if (value >= given.low && value <= given.high) return value;
  }
  throw BadInput("draw: normal: no draw of " + std::to_string(kMaxRedraws) +
                 " was within the bounds; give bounds that more draws meet");
}

Json drawn_part(const Distribution& given, simulated::RandomStream& stream) {
  switch (given.kind) {
    case Distribution::Kind::kUniform:
      return stream.uniform(given.low, given.high);
    case Distribution::Kind::kNormal:
      return normal_within(given, stream);
    case Distribution::Kind::kChoice:
      return given.values[stream.next() % given.values.size()];
    case Distribution::Kind::kFixed:
      break;
  }
  return given.values.front();
}

std::string word_of(const Json& value) { return value.is_string() ? value.text() : config::canonical_json(value); }

std::string option_of(const std::string& key) {
  std::string option = "--" + key;
  std::replace(option.begin(), option.end(), '_', '-');
  return option;
}

std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (c == '.') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

// The place that a path leads to; entries of lists are counted from 1, as in Lua. The last name may be a new one: the
// check of the table knows which there are.
Json& place_of(Json& table, const std::string& key) {
  const std::vector<std::string> parts = parts_of(key);
  Json* place = &table;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const std::string& part = parts[i];
    if (place->is_array()) {
      std::size_t entry = 0;
      const auto [stopped, error] = std::from_chars(part.data(), part.data() + part.size(), entry);
      if (error != std::errc() || stopped != part.data() + part.size() || entry < 1 || entry > place->size())
        throw BadInput(key + ": '" + part + "': allowed an entry of the list from 1 to " +
                       std::to_string(place->size()));
      place = &(*place)[entry - 1];
    } else if (place->is_object() && (i + 1 == parts.size() || place->contains(part))) {
      place = &(*place)[part];
    } else {
      throw BadInput(key + ": '" + part + "': no such field in the table; see docs/reference/formats.md");
    }
  }
  return *place;
}

void check_simulated(const std::string& buses, const std::string& name) {
  const config::BusesConfig parsed = launcher::checked([&] { return config::parse_buses(buses, name); });
  if (parsed.backend != "embedded")
    throw BadInput("bus: '" + parsed.name +
                   "': leads to real buses: a campaign simulates; allowed a table with backend embedded");
}

Json files_of_mission(const std::string& mission, const BaseTables& base) {
  const std::string scratch = launcher::temporary_directory(), robot = scratch + "/robot.json",
                    bus = scratch + "/buses.json";
  Json files = Json::array();
  const auto remove = [&] {
    std::error_code gone;
    fs::remove_all(scratch, gone);
  };
  try {
    launcher::write_output(robot, base.robot);
    launcher::write_output(bus, base.bus);
    for (const Json& file : launcher::check_mission(mission, robot, bus).value("files", Json::array()))
      files.push_back({{"file", file.at("file")}, {"sha256", file.at("sha256")}});
  } catch (...) {
    remove();
    throw;
  }
  remove();
  return files;
}

}  // namespace

Json drawn_value(const config::Drawn& drawn, std::uint64_t seed) {
  simulated::RandomStream stream(seed, purpose_of(drawn.key));
  if (drawn.parts.size() == 1) return drawn_part(drawn.parts.front(), stream);
  std::string text;
  for (const Distribution& part : drawn.parts) text += (text.empty() ? "" : ",") + word_of(drawn_part(part, stream));
  return text;
}

std::string shell_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) {
    const bool is_plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
      return std::isalnum(c) != 0 || std::string_view("-_=./,:+@").find(static_cast<char>(c)) != std::string_view::npos;
    });
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += (line.empty() ? "" : " ") + (is_plain ? word : quoted + "'");
  }
  return line;
}

Rows::Rows(config::CampaignConfig config, std::string folder) : config_(std::move(config)), folder_(std::move(folder)) {
  config_.mission = as_file(config_.mission);
  for (auto [key, value] :
       {std::pair{"robot", &config_.robot}, std::pair{"scene", &config_.scene}, std::pair{"bus", &config_.bus}}) {
    if (!value->empty()) config_.options[key] = *value;
  }
}

// Names are looked up by liana run; files stand beside the table.
std::string Rows::as_file(const std::string& value) const {
  const bool is_file = value.find('/') != value.npos || value.ends_with(".lua") || value.ends_with(".json");
  return is_file ? (fs::path(folder_) / value).lexically_normal().string() : value;
}

Json Rows::values_of(std::uint64_t number, std::uint64_t seed) const {
  Json values = Json::object();
  std::uint64_t point = number / config_.seed_count;
  for (std::size_t i = config_.sweep.size(); i-- > 0;) {
    const config::Swept& swept = config_.sweep[i];
    values[swept.key] = swept.values[point % swept.values.size()];
    point /= swept.values.size();
  }
  for (const config::Drawn& drawn : config_.draw) values[drawn.key] = drawn_value(drawn, seed);
  return values;
}

const BaseTables& Rows::base_tables(const std::map<std::string, Json>& options) {
  const auto given = [&](const char* key) {
    const auto found = options.find(key);
    return found == options.end() ? std::string() : word_of(found->second);
  };
  const std::vector<std::string> names{given("robot"), given("scene"), given("bus")};
  const auto found = known_.find(names);
  if (found != known_.end()) return found->second;
  const launcher::MissionTables own = launcher::tables_of_mission(config_.mission);
  const auto first = [](const std::string& a, const std::string& b, const char* c) {
    return !a.empty() ? a : !b.empty() ? b : std::string(c);
  };
  const std::string robot = first(names[0], own.robot, launcher::kDefaultRobot);
  BaseTables base;
  base.robot = launcher::evaluate_table("robot", robot);
  const bool is_serial = launcher::checked([&] { return config::robot_kind(base.robot, robot); }) == "serial";
  base.scene = launcher::evaluate_table("scene", first(names[1], own.scene, is_serial ? "none" : "panel_slit"));
  const std::string bus = names[2].empty() && robot == own.robot ? own.bus : names[2];
  base.bus = launcher::buses_of(robot, base.robot, bus).json;
  check_simulated(base.bus, bus);
  base.mission_files = files_of_mission(config_.mission, base);
  return known_.emplace(names, std::move(base)).first->second;
}

void Rows::write_table(Row& row, const std::string& kind, const std::string& base) const {
  const std::string begin = kind + ".";
  Json table = Json::parse(base);
  bool is_changed = false;
  for (const auto& [key, value] : row.values.items()) {
    if (!key.starts_with(begin)) continue;
    place_of(table, key) = value;
    is_changed = true;
  }
  for (const auto& [key, value] : config_.options) {
    if (!key.starts_with(begin)) continue;
    place_of(table, key) = value;
    is_changed = true;
  }
  if (!is_changed) return;
  const std::string name = "row " + std::to_string(row.number) + ": " + kind;
  row.tables[kind + ".json"] =
      launcher::checked([&] { return config::check_table(kind == "bus" ? "buses" : kind, table, name); });
}

Row Rows::at(std::uint64_t number) {
  Row row;
  row.number = number;
  row.seed = config_.first_seed + number % config_.seed_count;
  row.values = values_of(number, row.seed);
  std::map<std::string, Json> options;
  for (const auto& [key, value] : config_.options) options[key] = value;
  for (const auto& [key, value] : row.values.items()) options[key] = value;
  std::erase_if(options, [](const auto& each) { return config::is_table_field(each.first); });
  Json hashed = Json::object();
  for (auto& [key, value] : options) {
    hashed[key] = value;
    if (kFileOptions.count(key) == 0 || !value.is_string()) continue;
    const std::string file = as_file(value.text());
    if (file == value.text() && key != "faults" && key != "calibration") continue;  // a name
    auto found = hashes_.find(file);
    if (found == hashes_.end()) {
      const std::string text = launcher::checked([&] { return config::read_text_file(file); });
      found = hashes_.emplace(file, config::sha256_hex(text)).first;
    }
    value = file;
    hashed[key] = found->second;
  }
  const BaseTables& base = base_tables(options);
  write_table(row, "robot", base.robot);
  write_table(row, "scene", base.scene);
  write_table(row, "bus", base.bus);
  const auto table = [&](const char* kind, const std::string& unchanged) {
    const auto found = row.tables.find(std::string(kind) + ".json");
    return found == row.tables.end() ? unchanged : found->second;
  };
  hashed["mission"] = base.mission_files;
  hashed["seed"] = row.seed;
  for (const auto& [kind, unchanged] :
       {std::pair{"robot", &base.robot}, std::pair{"scene", &base.scene}, std::pair{"bus", &base.bus}})
    hashed[kind] = config::sha256_hex(table(kind, *unchanged));
  row.config_hash = config::sha256_hex(config::canonical_json(hashed));
  if (row.tables.count("robot.json") != 0) row.tables.emplace("bus.json", base.bus);  // else chosen by the robot's name
  for (const auto& [file, text] : row.tables) options[file.substr(0, file.find('.'))] = file;
  row.words = {"run", config_.mission, "--seed=" + std::to_string(row.seed)};
  for (const auto& [key, value] : options) row.words.push_back(option_of(key) + "=" + word_of(value));
  return row;
}

}  // namespace liana::campaign
