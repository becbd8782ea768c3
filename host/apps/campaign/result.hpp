// What came of one row.
#pragma once

#include <cstdint>
#include <string>

#include "host/base/json/json.hpp"

namespace liana::campaign {

struct RowResult {
  std::uint64_t number = 0;
  int exit_code = 0;              // of `liana run`
  std::string outcome;            // of its report; "refused" where it refused its input
  std::string reason;             // why, where it is no success
  std::string config_hash;        // of its row
  std::string report_hash;        // empty without a report
  Json figures = Json::object();  // the numbers of the report, by path
  double cpu_s = 0.0;             // of all processes of the run
};

// The numbers of a report by their paths, such as verified_clearance_m.min; of lists those whose entries have names.
Json figures_of(const Json& report);

// SHA-256 over a report without what depends on where and when it was made: paths of mission and robot, overruns.
std::string report_hash(Json report);

Json to_json(const RowResult& result);
// Throws JsonError for what to_json has not made.
RowResult row_result(const Json& json);

}  // namespace liana::campaign
