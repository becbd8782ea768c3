#include "host/apps/campaign/result.hpp"

#include <set>
#include <string>

#include "host/model/config/canonical.hpp"
#include "host/model/config/sha256.hpp"

namespace liana::campaign {
namespace {

void add_figures(Json& figures, const std::string& path, const Json& value) {
  if (value.is_number()) figures[path] = value;
  const std::string begin = path.empty() ? "" : path + ".";
  if (value.is_object()) {
    for (const auto& [key, each] : value.items()) add_figures(figures, begin + key, each);
  }
  if (!value.is_array()) return;
  std::set<std::string> names;  // of equals the first counts
  for (const Json& each : value) {
    const Json& name = each.member_or_null("name");
    if (name.is_string() && names.insert(name.text()).second) add_figures(figures, begin + name.text(), each);
  }
}

}  // namespace

Json figures_of(const Json& report) {
  Json figures = Json::object();
  add_figures(figures, "", report);
  for (const char* no_figure : {"seed", "overruns"}) figures.erase(no_figure);
  return figures;
}

std::string report_hash(Json report) {
  for (const char* key : {"mission", "robot", "overruns"}) report.erase(key);
  return config::sha256_hex(config::canonical_json(report));
}

Json to_json(const RowResult& result) {
  return {{"row", result.number},
          {"exit_code", result.exit_code},
          {"outcome", result.outcome},
          {"reason", result.reason},
          {"config_hash", result.config_hash},
          {"report_hash", result.report_hash},
          {"figures", result.figures},
          {"cpu_s", result.cpu_s}};
}

RowResult row_result(const Json& json) {
  RowResult result;
  result.number = json.at("row").get<std::uint64_t>();
  result.exit_code = json.at("exit_code").get<int>();
  result.outcome = json.at("outcome").text();
  result.reason = json.at("reason").text();
  result.config_hash = json.at("config_hash").text();
  result.report_hash = json.at("report_hash").text();
  result.figures = json.at("figures");
  result.cpu_s = json.at("cpu_s").get<double>();
  return result;
}

}  // namespace liana::campaign
