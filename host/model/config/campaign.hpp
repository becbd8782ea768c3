// Tables of kind `campaign`: a mission run for many seeds, with values that are swept or drawn (lua/campaigns).
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "host/base/json/json.hpp"

namespace liana::config {

// One value that chance gives.
struct Distribution {
  enum class Kind { kFixed, kUniform, kNormal, kChoice };
  Kind kind = Kind::kFixed;
  std::vector<Json> values{};    // fixed: one; choice: all of them
  double low = 0.0, high = 0.0;  // uniform: in [low, high); normal: what is outside is drawn again
  double mean = 0.0, sd = 1.0;   // normal
};

// Keys are options of `liana run` with _ in place of -, or robot.PATH, scene.PATH, bus.PATH for a field of a table.
struct Swept {
  std::string key;
  std::vector<Json> values;
};
struct Drawn {
  std::string key;
  std::vector<Distribution> parts;  // several: their values with commas between, as --scene-offset wants them
};

struct CampaignConfig {
  std::string name;
  std::string mission;            // its name, or a file beside the table
  std::string robot, scene, bus;  // empty: as liana run chooses
  std::uint64_t first_seed = 1;   // each point of the sweep has the same seeds
  std::uint64_t seed_count = 1;
  std::uint64_t keep_failed = 20;  // so many failed rows, those with the lowest numbers, are kept in full
  std::map<std::string, Json> options;
  std::vector<Swept> sweep;  // by key; the last one changes fastest
  std::vector<Drawn> draw;

  // Rows of the whole campaign: points of the sweep times seeds.
  std::uint64_t row_count() const;
};

constexpr std::uint64_t kMaxCampaignRows = 1'000'000;

// Throws std::runtime_error with file, field, value, what is allowed and what to do.
CampaignConfig parse_campaign(const Json& table, const std::string& file);

// Whether a key is the field of a table: robot.PATH, scene.PATH or bus.PATH.
bool is_table_field(const std::string& key);

}  // namespace liana::config
