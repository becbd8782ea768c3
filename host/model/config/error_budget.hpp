// Tables of kind `budget`: chains of errors (requirement B7; lua/budgets/payload_install.lua shows every field).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "host/base/json/json_fwd.hpp"

namespace liana::config {

constexpr std::size_t kMaxErrors = 32, kMaxTerms = 32;  // of a loop
constexpr double kMaxPosition_m = 10.0, kMaxAngle_deg = 30.0, kMaxLever_m = 1000.0;

// What one part of the chain does wrong, as its maker states it.
struct ErrorSource {
  std::string name;
  double position_m = 0.0;
  double angle_rad = 0.0;
};

// What errors do to the end of the chain: positions as they are, angles over the length that follows. Indices into the
// loop's errors, each at most once.
struct ErrorTerm {
  std::string name;
  std::vector<std::size_t> positions, angles;
  double lever_m = 0.0;
};

struct ErrorLoop {
  std::vector<ErrorSource> errors;
  std::vector<ErrorTerm> terms;
};

struct ErrorBudget {
  std::string name;
  ErrorLoop open_loop, closed_loop;
};

// Throws std::runtime_error "file: field: value: allowed ...: what to do".
ErrorBudget parse_error_budget(const Json& table, const std::string& file);

}  // namespace liana::config
