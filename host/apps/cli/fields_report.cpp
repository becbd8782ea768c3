#include "host/apps/cli/fields_report.hpp"

#include <algorithm>
#include <cstdio>

namespace liana::cli {

Json fields_json(const calibration::FieldsFound& found) {
  Json out{{"fields", Json::array()}, {"not_told_apart", found.not_told_apart}, {"problems", found.problems}};
  for (const calibration::FieldValue& one : found.values)
    out["fields"].push_back({{"field", one.field}, {"value", one.value}, {"sd", one.sd}});
  return out;
}

void print_fields(const calibration::FieldsFound& found, const cable::RobotParams& table) {
  std::printf("%-40s %10s %10s %10s\n", "field", "table", "found", "+-");
  for (const calibration::TableField& field : calibration::table_fields(table)) {
    const auto one = std::ranges::find(found.values, field.field, &calibration::FieldValue::field);
    if (one == found.values.end()) continue;
    std::printf("%-40s %10.5g %10.5g %10.2g\n", one->field.c_str(), field.table_value, one->value, one->sd);
  }
  for (const std::vector<std::string>& names : found.not_told_apart) {
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ",") + name;
    std::printf("cannot be told apart in these poses: %s\n", list.c_str());
  }
}

void print_problems(const calibration::FieldsFound& found) {
  for (const std::string& problem : found.problems) std::printf("problem: %s\n", problem.c_str());
}

}  // namespace liana::cli
