#include "host/model/config/field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "host/base/file/in_file.hpp"
#include "host/base/json/number_error.hpp"
#include "host/base/options/nearest.hpp"
#include "host/base/options/retired.hpp"
#include "host/model/config/canonical.hpp"

namespace liana::config {
namespace {

constexpr std::size_t kLongestValueShown = 60;

// Fields of tables.
constexpr std::array<options::RetiredName, 7> kRetired{{
    {"fixture_poses", "jig_poses"},
    {"watch", "monitor"},
    {"most_force_N", "max_force_N"},
    {"most_joint_Nm", "max_joint_Nm"},
    {"most_travel_m", "max_travel_m"},
    {"most_aside_m", "max_lateral_m"},
    {"most_turn_deg", "max_turn_deg"},
}};

std::string shown(const Json& value) {
  const std::string text = canonical_json(value);
  return text.size() <= kLongestValueShown ? text : text.substr(0, kLongestValueShown) + "...";
}

}  // namespace

std::string Range::text() const {
  if (above) return "over " + canonical_number(low) + ", up to " + canonical_number(high);
  return canonical_number(low) + " to " + canonical_number(high);
}

bool Range::contains(double value) const {
  return std::isfinite(value) && value <= high && (above ? value > low : value >= low);
}

void Field::refuse(const std::string& allowed, const std::string& what_to_do) const {
  throw std::runtime_error(file_ + ": " + (path_.empty() ? "" : path_ + ": ") + shown(*value_) + ": allowed " +
                           allowed + ": " + what_to_do);
}

Field Field::at(const std::string& key) const {
  if (!value_->is_object()) refuse("a table with named fields", "write it as { " + key + " = ... }");
  const auto found = value_->find(key);
  const std::string path = path_.empty() ? key : path_ + "." + key;
  if (found == nullptr)
    throw std::runtime_error(file_ + ": " + path +
                             ": missing: allowed a value as docs/reference/formats.md gives it: add the field");
  return Field(*found, file_, path);
}

Field Field::element(std::size_t i) const {
  return Field((*value_)[i], file_, path_ + "[" + std::to_string(i + 1) + "]");
}

std::size_t Field::size(std::size_t low, std::size_t high, const std::string& what_to_do) const {
  const std::string count = low == high ? std::to_string(low) : std::to_string(low) + " to " + std::to_string(high);
  const std::string allowed = "a list of " + count + " entries";
  if (!value_->is_array()) refuse(allowed, what_to_do);
  if (value_->size() >= low && value_->size() <= high) return value_->size();
  throw std::runtime_error(file_ + ": " + path_ + ": " + std::to_string(value_->size()) + " entries: allowed " +
                           allowed + ": " + what_to_do);
}

void Field::only(const std::set<std::string>& known) const {
  if (!value_->is_object()) refuse("a table with named fields", "see docs/reference/formats.md");
  for (const auto& [key, item] : value_->items()) {
    if (known.count(key) != 0) continue;
    const Field field(item, file_, path_.empty() ? key : path_ + "." + key);
    const std::string now{options::present_name(key, kRetired)};
    if (!now.empty()) field.refuse("no such field", options::called_now(now));
    field.refuse("no such field" + options::did_you_mean(key, {known.begin(), known.end()}),
                 "remove it or correct its spelling");
  }
}

double Field::number(const Range& range) const {
  if (!value_->is_number()) refuse("a number " + range.text(), "give a plain number");
  const double value = value_->get<double>();
  if (!range.contains(value)) refuse(range.text(), "choose a value in this range");
  return value;
}

std::int64_t Field::integer(std::int64_t low, std::int64_t high) const {
  const double value = number({static_cast<double>(low), static_cast<double>(high)});
  if (value != std::trunc(value))
    refuse("whole numbers " + std::to_string(low) + " to " + std::to_string(high), "round it");
  return static_cast<std::int64_t>(value);
}

std::string Field::name(std::size_t longest) const {
  const std::string allowed = "1 to " + std::to_string(longest) + " letters, digits, '_', '-', '.'";
  if (!value_->is_string()) refuse(allowed, "give a quoted name");
  const auto text = value_->get<std::string>();
  const auto plain = [](unsigned char c) {
    return (c < 128 && std::isalnum(c) != 0) || c == '_' || c == '-' || c == '.';
  };
  if (text.empty() || text.size() > longest || !std::all_of(text.begin(), text.end(), plain))
    refuse(allowed, "choose another name");
  return text;
}

std::string Field::choice(const std::vector<std::string>& words) const {
  const std::string given = value_->is_string() ? value_->get<std::string>() : "";
  if (std::find(words.begin(), words.end(), given) != words.end()) return given;
  refuse(options::allowed_names(given, words), "use one of these words");
}

Json parse_json(const std::string& text, const std::string& file, const std::string& advice) {
  try {
    return Json::parse(text, Json::Twice::kRefuse);
  } catch (const JsonTwiceError& error) {
    throw std::runtime_error(file + ": " + error.key + ": given twice: allowed once: remove one of them");
  } catch (const JsonNumberError& error) {
    throw std::runtime_error(file + ": " + error.place(1) + (error.way.empty() ? "" : ": ") + error.complaint());
  } catch (const JsonParseError& error) {
    throw std::runtime_error(file + ": not JSON: " + error.what() + ": " + advice);
  }
}

std::string read_text_file(const std::string& path) {
  file::require_ordinary(path);
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  if (!in || !(text << in.rdbuf()))
    throw std::runtime_error(path + ": cannot be read: allowed a readable file that is not empty: check the path");
  return text.str();
}

void check_kind(const Field& table, const std::string& kind, const std::string& other) {
  table.at("format").integer(1, 1);
  const Field found = table.at("kind");
  if (found.json() != kind) found.refuse(kind + other, "give a table of this kind");
}

}  // namespace liana::config
