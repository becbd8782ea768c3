#include "hil/bench/truth_log.hpp"

#include <bit>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace liana::bench {

static_assert(std::endian::native == std::endian::little, "rows are written as they lie in memory");

TruthLog::TruthLog(const std::string& path, std::size_t theta_count) : path_(path) {
  if (path.empty()) return;
  std::vector<std::string> columns{"slot"};
  for (std::size_t i = 1; i <= theta_count; ++i) columns.push_back("theta_deg_" + std::to_string(i));
  for (const char* name : {"tip_x_m", "tip_y_m", "tip_z_m", "tip_qw", "tip_qx", "tip_qy", "tip_qz", "clearance_m",
                           "slit_clearance_m", "sphere_clearance_m", "contact_force_N", "rod_force_N", "tension_min_N",
                           "tension_motor_min_N", "tension_motor_max_N", "enabled"})
    columns.emplace_back(name);
  columns_ = columns.size();
  file_.reset(std::fopen(path.c_str(), "wb"));
  if (!file_) throw std::runtime_error("--truth: " + path + " cannot be created; check the folder");
  const std::string header = nlohmann::json{{"columns", columns}}.dump() + "\n";
  std::fputs(header.c_str(), file_.get());
}

void TruthLog::write(const std::vector<double>& row) {
  if (!file_) return;
  if (row.size() != columns_)
    throw std::runtime_error("truth: a row of " + std::to_string(row.size()) + " values, expected " +
                             std::to_string(columns_));
  if (std::fwrite(row.data(), sizeof(double), row.size(), file_.get()) != row.size())
    throw std::runtime_error("--truth: writing " + path_ + " failed; is the disk full?");
}

void TruthLog::flush() {
  if (file_ && std::fflush(file_.get()) != 0)
    throw std::runtime_error("--truth: writing " + path_ + " failed; is the disk full?");
}

}  // namespace liana::bench
