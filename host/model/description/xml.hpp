// Text of XML: numbers that are read back as they were, lists of them, and names that may hold anything.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace liana::description {

// The shortest text that is read back as the same number.
std::string number(double value);

// Numbers with a space between them.
std::string numbers(std::span<const double> values);

// ` name="value"`, with what XML reserves in `value` escaped.
std::string attribute(std::string_view name, std::string_view value);

inline std::string attribute(std::string_view name, double value) { return attribute(name, number(value)); }
inline std::string attribute(std::string_view name, std::span<const double> values) {
  return attribute(name, numbers(values));
}

}  // namespace liana::description
