// The only places where numbers change type: integers between widths, floating point to integer.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

namespace liana {

// Integer `from` as type To; a value To cannot hold becomes To's nearest limit, so nothing ever wraps.
template <std::integral To, std::integral From>
constexpr To narrow(From from) noexcept {
  if (std::cmp_less(from, std::numeric_limits<To>::min())) return std::numeric_limits<To>::min();
  if (std::cmp_greater(from, std::numeric_limits<To>::max())) return std::numeric_limits<To>::max();
  return static_cast<To>(from);
}

// Array position of a non-negative index; a negative one becomes 0.
constexpr std::size_t as_index(std::int32_t index) noexcept { return narrow<std::size_t>(index); }

// How a floating-point number became an integer.
enum class CountStatus : std::uint8_t { kExact = 0, kSaturated = 1, kNotANumber = 2 };

struct Counts {
  std::int32_t value = 0;  // rounded half away from zero; the nearest limit when saturated; 0 when not a number
  CountStatus status = CountStatus::kExact;
};

// The one conversion from floating point to integer; the status says when the value is not the rounded argument.
constexpr Counts to_counts(double value) noexcept {
  constexpr double kLow = static_cast<double>(std::numeric_limits<std::int32_t>::min());
  constexpr double kHigh = static_cast<double>(std::numeric_limits<std::int32_t>::max());
  if (value != value) return {0, CountStatus::kNotANumber};
  if (value < kLow) return {std::numeric_limits<std::int32_t>::min(), CountStatus::kSaturated};
  if (value > kHigh) return {std::numeric_limits<std::int32_t>::max(), CountStatus::kSaturated};
  const std::int32_t truncated = static_cast<std::int32_t>(value);
  const double rest = value - static_cast<double>(truncated);  // exact: both are below 2^31
  if (rest >= 0.5) return {truncated + 1, CountStatus::kExact};
  if (rest <= -0.5) return {truncated - 1, CountStatus::kExact};
  return {truncated, CountStatus::kExact};
}

}  // namespace liana
