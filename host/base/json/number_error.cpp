#include "host/base/json/number_error.hpp"

#include <utility>

namespace liana {
namespace {

constexpr std::size_t kLongestShown = 60;

std::string shortened(std::string text) {
  return text.size() <= kLongestShown ? std::move(text) : text.substr(0, kLongestShown) + "...";
}

std::string place_of(const std::vector<JsonNumberError::Step>& way, std::size_t first) {
  std::string place;
  for (const JsonNumberError::Step& step : way) {
    if (const auto* name = std::get_if<std::string>(&step)) {
      place += (place.empty() ? "" : ".") + *name;
    } else {
      place += "[" + std::to_string(first + std::get<std::size_t>(step)) + "]";
    }
  }
  return place;
}

std::string complaint_of(const std::string& number) {
  return shortened(number) + ": allowed -1.797e308 to 1.797e308: correct the number";
}

}  // namespace

JsonNumberError::JsonNumberError(std::vector<Step> way_to_it, std::string number, std::size_t at)
    : JsonParseError(place_of(way_to_it, 0) + (way_to_it.empty() ? "" : ": ") + complaint_of(number), at),
      way(std::move(way_to_it)),
      text(shortened(std::move(number))) {}

std::string JsonNumberError::place(std::size_t first) const { return place_of(way, first); }

std::string JsonNumberError::complaint() const { return complaint_of(text); }

}  // namespace liana
