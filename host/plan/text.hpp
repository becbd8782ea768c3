// Sentences with numbers, as snprintf writes them.
#pragma once

#include <cstdio>
#include <string>

namespace liana {

// At most 299 characters.
template <typename... Values>
std::string text(const char* format, Values... values) {
  char buffer[300];
  std::snprintf(buffer, sizeof buffer, format, values...);
  return buffer;
}

}  // namespace liana
