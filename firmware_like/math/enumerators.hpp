// How many enumerators an enum has: a table whose length is that cannot miss a row for a new one.
#pragma once

#include <cstddef>
#include <string_view>
#include <utility>

namespace liana {

// Whether an enum has an enumerator of this value: the compiler calls it by its name, and others (Enum)7.
template <auto kValue>
constexpr bool is_enumerator() noexcept {
  constexpr std::string_view kText = __PRETTY_FUNCTION__;
  return kText[kText.rfind('=') + 2] != '(';
}

// How many enumerators an enum of numbers in blocks has: of the first 100 numbers from 0, kStep, ... 9 kStep on. A
// table that has as many rows with ascending numbers has one for each.
template <class Enum, std::size_t kStep>
constexpr std::size_t count_enumerators() noexcept {
  return []<std::size_t... kIndex>(std::index_sequence<kIndex...>) {
    constexpr bool kIs[] = {is_enumerator<static_cast<Enum>(kIndex / 100 * kStep + kIndex % 100)>()...};
    std::size_t count = 0;
    for (const bool is : kIs) count += is ? 1 : 0;
    return count;
  }
  (std::make_index_sequence<1000>());
}

}  // namespace liana
