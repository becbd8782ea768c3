// A number that no double holds, as 1e400: JSON by its grammar, but nothing to compute with.
#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "host/base/json/json.hpp"

namespace liana {

// what() is "a.b[0]: 1e400: allowed ...: what to do", entries counted from 0.
struct JsonNumberError : JsonParseError {
  // From the whole to the number: the name of a member, or which entry of an array, from 0.
  using Step = std::variant<std::string, std::size_t>;
  JsonNumberError(std::vector<Step> way_to_it, std::string number, std::size_t at);
  // "a.b[0]", entries counted from `first`; empty when the number is the whole text.
  std::string place(std::size_t first) const;
  // "1e400: allowed ...: what to do".
  std::string complaint() const;
  std::vector<Step> way;
  std::string text;  // as written, at most 60 characters of it
};

}  // namespace liana
