#include "host/model/description/xml.hpp"

#include <charconv>

#include "host/base/svg/svg.hpp"

namespace liana::description {

std::string number(double value) {
  char text[32];  // + 0.0: no "-0"
  return {text, std::to_chars(text, text + sizeof text, value + 0.0).ptr};
}

std::string numbers(std::span<const double> values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : " ") + number(value);
  return text;
}

std::string attribute(std::string_view name, std::string_view value) {
  return " " + std::string(name) + "=\"" + svg::escaped(value) + '"';
}

}  // namespace liana::description
