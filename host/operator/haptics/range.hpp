// Figures of a table against their ranges.
#pragma once

namespace liana::haptics {

// Throws std::invalid_argument "table: field: value: allowed: least to most" outside the range, and for NaN.
void check_range(const char* table, const char* field, double value, double least, double most);

}  // namespace liana::haptics
