// Which known name somebody meant who wrote an unknown one.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace liana::options {

// The known name nearest to `given`, the first of several; empty where none is near. Near is at most two letters added,
// left out, replaced or exchanged with the next one, and at most half as many as `given` has without dashes before it.
std::string nearest(std::string_view given, const std::vector<std::string>& known);

// "; did you mean NAME?", for the end of a refusal; empty where no known name is near. What had `given` as its name
// before gives "; it is called NAME now".
std::string did_you_mean(std::string_view given, const std::vector<std::string>& known);

// "a, b, c" with `more` behind it, and then did_you_mean(): what is allowed, for the end of a refusal.
std::string allowed_names(std::string_view given, const std::vector<std::string>& known, std::string_view more = "");

template <class Value>
std::vector<std::string> names_of(const std::map<std::string, Value>& named) {
  std::vector<std::string> names;
  for (const auto& [name, value] : named) names.push_back(name);
  return names;
}

}  // namespace liana::options
