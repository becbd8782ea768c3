#include "host/model/config/campaign.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "host/model/config/field.hpp"

namespace liana::config {
namespace {

constexpr std::int64_t kLastSeed = (std::int64_t{1} << 53) - 1;
constexpr double kLargest = 1e12;         // of any drawn number
constexpr double kMaxOutside_sd = 3.0;    // between a normal's mean and its nearer bound beyond it
constexpr std::size_t kMaxValues = 1000;  // of one key
constexpr std::size_t kMaxKeys = 64;
constexpr std::array<std::string_view, 3> kTables{"robot.", "scene.", "bus."};
constexpr const char* kKeyAdvice =
    "name an option of liana run with _ in place of -, or a field such as robot.tension.plan_N";

void check_key(const Field& field, const std::string& key) {
  const bool is_option = !key.empty() && std::all_of(key.begin(), key.end(),
                                                     [](unsigned char c) { return std::islower(c) != 0 || c == '_'; });
  const bool is_path = is_table_field(key) && !key.ends_with('.') && key.find("..") == key.npos && key.size() <= 200;
  if (!is_option && !is_path) field.refuse("a key of letters and _, or robot.PATH, scene.PATH, bus.PATH", kKeyAdvice);
}

// Numbers and texts for options; anything for fields of tables, which have a check of their own.
Json value_of(const Field& field, const std::string& key) {
  const Json& value = field.json();
  const bool is_word = value.is_string() && !value.text().empty() && value.text().find('\0') == std::string::npos;
  if (value.is_number() && !std::isfinite(value.get<double>())) field.refuse("a finite number", "correct it");
  if (!is_table_field(key) && !value.is_number() && !is_word) field.refuse("a number or a text", "give one");
  return value;
}

std::vector<Json> values_of(const Field& field, const std::string& key) {
  std::vector<Json> values;
  const std::size_t count = field.size(1, kMaxValues, "list the values");
  for (std::size_t i = 0; i < count; ++i) values.push_back(value_of(field.element(i), key));
  return values;
}

Distribution read_normal(const Field& field) {
  Distribution out{.kind = Distribution::Kind::kNormal, .low = -kLargest, .high = kLargest};
  const auto [mean, sd] = field.at("normal").numbers<2>({-kLargest, kLargest});
  out.mean = mean;
  out.sd = sd;
  if (sd <= 0.0) field.at("normal").refuse("{ mean, standard deviation over 0 }", "correct the second number");
  if (field.json().contains("within")) {
    const Field within = field.at("within");
    const auto [low, high] = within.numbers<2>({-kLargest, kLargest});
    if (low >= high || low > mean + kMaxOutside_sd * sd || high < mean - kMaxOutside_sd * sd || high - low < 0.01 * sd)
      within.refuse("{ low, high } at most 3 standard deviations from the mean and at least 0.01 apart",
                    "values outside are drawn again: give bounds that many draws meet");
    out.low = low;
    out.high = high;
  }
  return out;
}

Distribution read_distribution(const Field& field, const std::string& key) {
  if (!field.json().is_object()) return {.kind = Distribution::Kind::kFixed, .values = {value_of(field, key)}};
  field.only({"uniform", "normal", "choice", "within"});
  const bool is_uniform = field.json().contains("uniform"), is_normal = field.json().contains("normal"),
             is_choice = field.json().contains("choice"), has_bounds = field.json().contains("within");
  if (int{is_uniform} + int{is_normal} + int{is_choice} != 1 || (has_bounds && !is_normal))
    field.refuse("one of uniform, normal, choice; within beside normal",
                 "write it as { uniform = { low, high } } or { normal = { mean, sd }, within = { low, high } }");
  if (is_choice) return {.kind = Distribution::Kind::kChoice, .values = values_of(field.at("choice"), key)};
  if (is_normal) return read_normal(field);
  const auto [low, high] = field.at("uniform").numbers<2>({-kLargest, kLargest});
  if (low >= high) field.at("uniform").refuse("{ low, high } with low below high", "correct the numbers");
  return {.kind = Distribution::Kind::kUniform, .low = low, .high = high};
}

Drawn read_drawn(const Field& field, const std::string& key) {
  check_key(field, key);
  if (!field.json().is_array()) {
    if (!field.json().is_object()) field.refuse("a distribution", "put a value that is always the same into options");
    return {key, {read_distribution(field, key)}};
  }
  if (is_table_field(key)) field.refuse("one distribution", "name the field of the list: robot.LIST.1");
  Drawn out{key, {}};
  const std::size_t count = field.size(2, 16, "give a distribution, or the parts of a value with commas");
  for (std::size_t i = 0; i < count; ++i) out.parts.push_back(read_distribution(field.element(i), key));
  return out;
}

// The entries of a table of keys that may be absent; an empty Lua table is a list.
template <typename Read>
void read_keys(const Field& table, const std::string& name, const Read& read) {
  if (!table.json().contains(name)) return;
  const Field field = table.at(name);
  if (field.json().empty()) return;
  if (!field.json().is_object() || field.json().size() > kMaxKeys)
    field.refuse("a table of at most 64 keys", "write it as { key = ... }");
  for (const auto& [key, value] : field.json().items()) read(field.at(key), key);
}

std::string text_or_empty(const Field& table, const std::string& name) {
  if (!table.json().contains(name)) return "";
  const Field field = table.at(name);
  if (!field.json().is_string() || field.json().text().empty() || field.json().text().size() > 1000)
    field.refuse("a name or a file", "give one, or leave the field out");
  return field.json().text();
}

void check_once(const Field& table, const CampaignConfig& out) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : out.options) keys.push_back(key);
  for (const Swept& each : out.sweep) keys.push_back(each.key);
  for (const Drawn& each : out.draw) keys.push_back(each.key);
  for (const auto& [key, value] :
       std::map<std::string, std::string>{{"robot", out.robot}, {"scene", out.scene}, {"bus", out.bus}}) {
    if (!value.empty()) keys.push_back(key);
  }
  std::sort(keys.begin(), keys.end());
  const auto twice = std::adjacent_find(keys.begin(), keys.end());
  if (twice != keys.end())
    throw std::runtime_error(table.file() + ": " + *twice +
                             ": given twice: allowed once in options, sweep and draw together: leave one out");
}

}  // namespace

bool is_table_field(const std::string& key) {
  return std::any_of(kTables.begin(), kTables.end(),
                     [&](std::string_view begin) { return key.starts_with(begin) && key.size() > begin.size(); });
}

std::uint64_t CampaignConfig::row_count() const {
  std::uint64_t rows = seed_count;
  for (const Swept& each : sweep) rows = std::min(rows * each.values.size(), kMaxCampaignRows + 1);
  return rows;
}

CampaignConfig parse_campaign(const Json& table, const std::string& file) {
  const Field field(table, file, "");
  check_kind(field, "campaign");
  field.only({"format", "kind", "name", "mission", "robot", "scene", "bus", "seeds", "options", "sweep", "draw",
              "keep_failed"});
  CampaignConfig out;
  out.name = field.at("name").name(40);
  out.mission = text_or_empty(field, "mission");
  if (out.mission.empty()) field.at("mission");  // says that it is missing
  if (out.mission.ends_with(".json"))
    field.at("mission").refuse("a mission", "make the plan a step of one (docs/how-to/write-a-mission.md)");
  out.robot = text_or_empty(field, "robot");
  out.scene = text_or_empty(field, "scene");
  out.bus = text_or_empty(field, "bus");
  const Field seeds = field.at("seeds");
  seeds.only({"first", "count"});
  if (seeds.json().contains("first"))
    out.first_seed = static_cast<std::uint64_t>(seeds.at("first").integer(0, kLastSeed - kMaxCampaignRows));
  out.seed_count = static_cast<std::uint64_t>(seeds.at("count").integer(1, kMaxCampaignRows));
  if (field.json().contains("keep_failed"))
    out.keep_failed = static_cast<std::uint64_t>(field.at("keep_failed").integer(0, 10'000));
  read_keys(field, "options", [&](const Field& value, const std::string& key) {
    check_key(value, key);
    out.options[key] = value_of(value, key);
  });
  read_keys(field, "sweep", [&](const Field& value, const std::string& key) {
    check_key(value, key);
    out.sweep.push_back({key, values_of(value, key)});
  });
  read_keys(field, "draw",
            [&](const Field& value, const std::string& key) { out.draw.push_back(read_drawn(value, key)); });
  check_once(field, out);
  if (out.row_count() > kMaxCampaignRows)
    throw std::runtime_error(file +
                             ": sweep: more than 1000000 rows: allowed seeds times swept values up to 1000000: " +
                             "give fewer seeds or values");
  return out;
}

}  // namespace liana::config
