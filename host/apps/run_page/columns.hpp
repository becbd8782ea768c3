// Numbers over time as columns of 16-bit integers, small enough to stand in a page.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/base/json/json_fwd.hpp"

namespace liana::run_page {

constexpr std::int16_t kNotThere = -32768;  // of a cell

// A value is its cell times `scale`.
struct Column {
  std::string name;       // of the field
  std::size_t index = 0;  // in the field
  std::string unit;
  double scale = 1.0;
  std::vector<std::int16_t> cells;
};

// `values`, in steps of what is fine enough to look at (0.001 deg, 0.1 mm, 0.1 N, ...), or of the least power of ten
// times that with which all fit. Values that are not finite are not there.
Column column_of(const std::string& name, std::size_t index, const std::string& unit,
                 const std::vector<double>& values);

// {"name","index","unit","scale"}
Json to_json(const Column& column);

// The cells of all columns, one column after the other: each as differences from row to row that wrap around, the low
// bytes of all rows before the high ones; compressed (RFC 1951) and as base64. All columns have as many rows.
std::string packed(const std::vector<Column>& columns);

}  // namespace liana::run_page
