// Reports of missions, also of those that died.
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "host/lua/mission_run.hpp"

namespace liana {

void write_report(const std::string& path, const std::string& report_json) {
  std::ofstream out(path, std::ios::trunc);
  out << report_json << "\n";
  if (!out.flush()) throw std::runtime_error(path + ": cannot be written: allowed a writable place: choose another --report");
}

std::string failed_report(const Activity& activity, const std::string& mission, const std::string& reason) {
  nlohmann::json report = nlohmann::json::parse(activity.report.data(), nullptr, false);
  if (!report.is_object()) report = {{"mission", mission}, {"steps", nlohmann::json::array()}, {"duration_s", 0}};
  report["outcome"] = "failed";
  report["reason"] = reason;
  for (auto& step : report["steps"]) {
    if (step.value("outcome", "") == "running") step["outcome"] = "failed", step["reason"] = reason;
  }
  return report.dump();
}

}  // namespace liana
