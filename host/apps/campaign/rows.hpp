// The rows of a campaign: each has a number, a seed, its values, and the words of the `liana run` that carries it out.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "host/base/json/json.hpp"
#include "host/model/config/campaign.hpp"

namespace liana::campaign {

struct Row {
  std::uint64_t number = 0;  // from 0: points of the sweep, within each all seeds
  std::uint64_t seed = 0;
  Json values;                                // what is swept or drawn, by key
  std::vector<std::string> words;             // for liana: "run", the mission, options
  std::map<std::string, std::string> tables;  // files that the words name, to be written where the row runs
  std::string config_hash;                    // over the contents of tables, mission, faults, options and seed
};

// What `liana run` would take for the same words.
struct BaseTables {
  std::string robot, scene, bus;  // canonical JSON
  Json mission_files;             // name and SHA-256 of each
};

class Rows {
 public:
  // `folder` is that of the campaign's table, where files are looked for that it names.
  Rows(config::CampaignConfig config, std::string folder);

  const config::CampaignConfig& config() const { return config_; }
  std::uint64_t count() const { return config_.row_count(); }

  // Row `number`, the same whenever it is asked for. Throws launcher::BadInput for tables, fields and values that
  // cannot be used.
  Row at(std::uint64_t number);

 private:
  Json values_of(std::uint64_t number, std::uint64_t seed) const;
  std::string as_file(const std::string& value) const;
  const BaseTables& base_tables(const std::map<std::string, Json>& options);
  void write_table(Row& row, const std::string& kind, const std::string& base) const;

  config::CampaignConfig config_;
  std::string folder_;
  std::map<std::vector<std::string>, BaseTables> known_;
  std::map<std::string, std::string> hashes_;  // of files, by path
};

// A drawn value: depends on seed and key alone.
Json drawn_value(const config::Drawn& drawn, std::uint64_t seed);

// Words as a shell reads them.
std::string shell_line(const std::vector<std::string>& words);

}  // namespace liana::campaign
