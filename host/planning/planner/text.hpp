// Sentences with numbers, as snprintf writes them.
#pragma once

#include <cstdio>
#include <string>

namespace liana::planner {

// At most 299 characters.
template <typename... Values>
std::string text(const char* format, Values... values) {
  char buffer[300];
  std::snprintf(buffer, sizeof buffer, format, values...);
  return buffer;
}

// "is 3.00 mm from BODY", or "is 40.00 mm inside BODY".
inline std::string distance_text(double clearance_m, const std::string& body) {
  return text("is %.2f mm %s %s", 1000.0 * (clearance_m < 0.0 ? -clearance_m : clearance_m),
              clearance_m < 0.0 ? "inside" : "from", body.c_str());
}

}  // namespace liana::planner
