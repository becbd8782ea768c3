// Telemetry by the second, for plots over hours: least, mean and largest of what people plot, in a table that SQL
// reads.
#pragma once

#include <string>
#include <vector>

#include "host/api/telemetry/layout.hpp"
#include "host/storage/archive/database.hpp"

namespace liana::archive {

// The table `tm_1s` of one file: a row for each second, `first_tick`, `time_s`, `count` of records, then NAME_min,
// NAME_mean and NAME_max of every value of the fields of docs/reference/formats.md; NAME is the field's path with _ for
// the dot, and _1, _2, ... where it has several. NULL: no number in this second.
class PerSecondSummary {
 public:
  // Makes the table when it is missing. Throws DatabaseError.
  PerSecondSummary(Database& database, const telemetry::Layout& layout);
  // The records of one second, one after the other; at least one. Throws DatabaseError.
  void write(const std::string& records);

 private:
  telemetry::Layout layout_;
  Statement insert_;
  std::vector<double> row_;
};

}  // namespace liana::archive
