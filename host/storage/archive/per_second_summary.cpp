#include "host/storage/archive/per_second_summary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "host/api/telemetry/record.hpp"

namespace liana::archive {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();  // SQLite keeps it as NULL

// What is worth a plot over hours; all numbers would take as much room as the records themselves.
constexpr std::array<std::string_view, 23> kPlotted{"measured_js_deg",
                                                    "measured_cp",
                                                    "tension_N",
                                                    "torque_Nm",
                                                    "drives.torque_permille",
                                                    "buses.measured_load",
                                                    "buses.errors",
                                                    "clearance.distance_m",
                                                    "clearance.bound_m",
                                                    "clearance.observation_age_s",
                                                    "shape.missing_m",
                                                    "friction.mu",
                                                    "friction.sd",
                                                    "contact.torque_Nm",
                                                    "verdict.share",
                                                    "device_samples",
                                                    "overruns",
                                                    "refusals",
                                                    "tick_us",
                                                    "insert.measured_wrench.force_N",
                                                    "insert.measured_wrench.torque_Nm",
                                                    "insert.force_setpoint_N",
                                                    "adapter.depth_m"};

telemetry::Layout plotted(telemetry::Layout layout) {
  std::erase_if(layout.places, [](const telemetry::Place& place) {
    return std::ranges::find(kPlotted, place.field.path) == kPlotted.end();
  });
  return layout;
}

std::vector<std::string> columns_of(const telemetry::Layout& layout) {
  std::vector<std::string> columns;
  for (const telemetry::Place& place : layout.places) {
    std::string name(place.field.path);
    std::ranges::replace(name, '.', '_');
    for (std::size_t i = 1; i <= place.count; ++i) {
      const std::string value = place.count > 1 ? name + '_' + std::to_string(i) : name;
      for (const char* figure : {"_min", "_mean", "_max"}) columns.push_back(value + figure);
    }
  }
  return columns;
}

// Makes the table; the statement that fills it.
Statement insert_into_table(Database& database, const std::vector<std::string>& columns) {
  std::string table = "CREATE TABLE IF NOT EXISTS tm_1s(first_tick INTEGER PRIMARY KEY, time_s REAL, count INTEGER";
  std::string insert = "INSERT OR REPLACE INTO tm_1s VALUES(?,?,?";
  for (const std::string& column : columns) {
    table += ", " + column + " REAL";
    insert += ",?";
  }
  database.run(table + ")");
  return {database, insert + ")"};
}

// Least, mean and largest of one value over these records.
void add_figures(const std::vector<std::string>& records, const telemetry::Place& place, std::size_t i,
                 std::vector<double>& row) {
  double least = kNone, most = kNone, sum = 0.0;
  std::size_t count = 0;
  for (const std::string& record : records) {
    const double value = static_cast<double>(telemetry::value_of(record, place, i));
    if (!std::isfinite(value)) continue;
    least = std::fmin(least, value);
    most = std::fmax(most, value);
    sum += value;
    ++count;
  }
  row.insert(row.end(), {least, count == 0 ? kNone : sum / static_cast<double>(count), most});
}

std::vector<std::string> split(const std::string& records, std::size_t bytes) {
  std::vector<std::string> out;
  for (std::size_t at = 0; at + bytes <= records.size(); at += bytes) out.push_back(records.substr(at, bytes));
  return out;
}

}  // namespace

PerSecondSummary::PerSecondSummary(Database& database, const telemetry::Layout& layout)
    : layout_(plotted(layout)), insert_(insert_into_table(database, columns_of(layout_))) {}

void PerSecondSummary::write(const std::string& records) {
  const std::vector<std::string> each = split(records, layout_.bytes);
  const telemetry::Header first = telemetry::header_of(each.at(0));
  row_.assign({first.tick, first.time_s, static_cast<double>(each.size())});
  for (const telemetry::Place& place : layout_.places) {
    for (std::size_t i = 0; i < place.count; ++i) add_figures(each, place, i, row_);
  }
  insert_.run_row(row_);
}

}  // namespace liana::archive
