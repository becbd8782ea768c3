// Which known name somebody meant who wrote an unknown one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace liana::options {

// The known name nearest to `given`, the first of several; empty where none is near. Near is at most two letters added,
// left out, replaced or exchanged with the next one, and at most half as many as `given` has without dashes before it.
std::string nearest(std::string_view given, const std::vector<std::string>& known);

// "; did you mean NAME?", for the end of a refusal; empty where no known name is near.
std::string did_you_mean(std::string_view given, const std::vector<std::string>& known);

}  // namespace liana::options
