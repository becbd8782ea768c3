// Public names that are no more: whoever uses one is told the name that took its place.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>

namespace liana::options {

struct RetiredName {
  std::string_view old_name, new_name;
};

// The present name of what was called `given`; empty where that is no retired name.
constexpr std::string_view present_name(std::string_view given, std::span<const RetiredName> retired) {
  const auto found =
      std::find_if(retired.begin(), retired.end(), [&](const RetiredName& name) { return name.old_name == given; });
  return found != retired.end() ? found->new_name : std::string_view{};
}

// For a refusal of an old name: what it is now.
inline std::string called_now(std::string_view name) { return "it is called " + std::string(name) + " now"; }

}  // namespace liana::options
