#include "host/apps/report/truth.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "host/base/file/in_file.hpp"
#include "host/base/json/json.hpp"

namespace liana::report {

static_assert(std::endian::native == std::endian::little, "truth.bin is little-endian and read as it is");

TruthLog TruthLog::load(const std::string& path) {
  file::require_ordinary(path);
  std::ifstream file(path, std::ios::binary);
  std::string header;
  if (!std::getline(file, header))
    throw std::runtime_error(path + ": no truth was written by the simulator: look at its log beside this file");
  const auto parsed = Json::parse_or_null(header);
  if (!parsed.contains("columns")) throw std::runtime_error(path + ": the first line names no columns");
  TruthLog log;
  for (const auto& name : parsed["columns"]) log.columns_.emplace(name.get<std::string>(), log.columns_.size());
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const std::size_t row_bytes = log.columns_.size() * sizeof(double);
  if (row_bytes == 0) throw std::runtime_error(path + ": the first line names no columns");
  log.values_.resize(bytes.size() / row_bytes * log.columns_.size());
  if (!log.values_.empty()) std::memcpy(log.values_.data(), bytes.data(), log.values_.size() * sizeof(double));
  return log;
}

double TruthLog::at(std::size_t row, const std::string& column) const {
  const auto found = columns_.find(column);
  if (found == columns_.end()) throw std::runtime_error("truth.bin has no column " + column);
  return values_.at(row * columns_.size() + found->second);
}

std::size_t TruthLog::row_of_slot(std::uint64_t slot) const {
  std::size_t low = 0;
  std::size_t high = row_count();
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    if (at(middle, "slot") <= static_cast<double>(slot)) {
      low = middle;
    } else {
      high = middle;
    }
  }
  return low;
}

double TruthLog::smallest(const std::string& column, std::size_t first, std::size_t last) const {
  double value = std::numeric_limits<double>::infinity();
  for (std::size_t row = first; row <= last; ++row) value = std::fmin(value, at(row, column));
  return value;
}

double TruthLog::largest(const std::string& column, std::size_t first, std::size_t last) const {
  double value = -std::numeric_limits<double>::infinity();
  for (std::size_t row = first; row <= last; ++row) value = std::fmax(value, at(row, column));
  return value;
}

Pose TruthLog::tip(std::size_t row) const {
  return {{at(row, "tip_x_m"), at(row, "tip_y_m"), at(row, "tip_z_m")},
          {at(row, "tip_qw"), at(row, "tip_qx"), at(row, "tip_qy"), at(row, "tip_qz")}};
}

std::vector<double> TruthLog::angles_deg(const std::string& prefix, std::size_t row) const {
  std::vector<double> angles;
  for (int i = 1; has(prefix + std::to_string(i)); ++i) angles.push_back(at(row, prefix + std::to_string(i)));
  return angles;
}

}  // namespace liana::report
