// Reading the files that people give liana-bus.
#pragma once

#include <stdexcept>
#include <string>

#include "host/base/json/number_error.hpp"

namespace liana::bus_simulator {

// The value of a file's text; null when it is no JSON, which its reader says with what belongs there. Throws
// std::runtime_error with file, field and number where no double holds the number.
inline Json parse_file(const std::string& text, const std::string& path) {
  try {
    return Json::parse(text);
  } catch (const JsonNumberError& error) {
    throw std::runtime_error(path + ": " + error.what());
  } catch (const JsonParseError&) {
    return {};
  }
}

}  // namespace liana::bus_simulator
