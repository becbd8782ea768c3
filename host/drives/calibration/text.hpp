// Sentences of this room with figures in them.
#pragma once

#include <cstdio>
#include <string>

namespace liana::calibration {

// As printf makes it, of at most 399 characters.
std::string text(const char* format, auto... values) {
  char line[400];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

}  // namespace liana::calibration
