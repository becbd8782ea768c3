// Texts of the reports.
#pragma once

#include <array>
#include <cstdarg>
#include <cstdio>
#include <string>

namespace liana::report {

// As printf makes it, of at most 299 characters.
__attribute__((format(printf, 1, 2))) inline std::string line(const char* format, ...) {
  std::array<char, 300> text{};
  va_list values;
  va_start(values, format);
  std::vsnprintf(text.data(), text.size(), format, values);
  va_end(values);
  return text.data();
}

}  // namespace liana::report
