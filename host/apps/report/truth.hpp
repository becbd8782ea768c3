// The bench's truth.bin (docs/reference/formats.md): what the physics did, slot by slot.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "firmware_like/math/pose.hpp"

namespace liana::report {

class TruthLog {
 public:
  // Reads a whole file; throws std::runtime_error when it is missing or malformed. A row cut short at the end is
  // dropped.
  static TruthLog load(const std::string& path);

  std::size_t row_count() const { return columns_.empty() ? 0 : values_.size() / columns_.size(); }
  // Value of a named column; throws std::runtime_error for a column the file does not have.
  double at(std::size_t row, const std::string& column) const;
  // Row of the last slot at or before `slot`; 0 when all are later.
  std::size_t row_of_slot(std::uint64_t slot) const;
  // Smallest (largest) finite value of a column over rows first..last, both included.
  double smallest(const std::string& column, std::size_t first, std::size_t last) const;
  double largest(const std::string& column, std::size_t first, std::size_t last) const;
  // Tip pose in the base frame.
  Pose tip(std::size_t row) const;
  // The file has such a column.
  bool has(const std::string& column) const { return columns_.contains(column); }
  // Angles [deg] in the columns `prefix`1, `prefix`2 ..., as many as the file has.
  std::vector<double> angles_deg(const std::string& prefix, std::size_t row) const;

 private:
  std::map<std::string, std::size_t> columns_;
  std::vector<double> values_;  // row after row
};

}  // namespace liana::report
