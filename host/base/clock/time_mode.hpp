// The three ways time passes on a bus.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace liana::timing {

// As numbered in the WELCOME packet (docs/reference/bus-protocol.md).
enum class TimeMode : std::uint8_t { kFast = 0, kPaced = 1, kReal = 2 };

// "fast", "paced" or "real".
constexpr std::string_view time_mode_name(TimeMode mode) {
  constexpr std::string_view kNames[] = {"fast", "paced", "real"};
  return kNames[static_cast<std::size_t>(mode)];
}

// The mode of that name, or nothing.
constexpr std::optional<TimeMode> time_mode_from(std::string_view name) {
  for (const TimeMode mode : {TimeMode::kFast, TimeMode::kPaced, TimeMode::kReal}) {
    if (time_mode_name(mode) == name) return mode;
  }
  return std::nullopt;
}

}  // namespace liana::timing
