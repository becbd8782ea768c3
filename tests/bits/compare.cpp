#include "tests/bits/compare.hpp"

#include <algorithm>

#include "host/record/serialise.hpp"

namespace liana::bits {
namespace {

// The next tick's Outputs; shorter where the file ends.
std::string next_of(std::istream& file) {
  std::string bytes(serialised_outputs_size<cable::CableArm>(), '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

void note_first(const std::string& expected, const std::string& answered, Comparison& result) {
  result.first_place = std::max<std::uint64_t>(result.ticks, 1) - 1;
  if (expected.size() == serialised_outputs_size<cable::CableArm>())
    result.first_tick = outputs_from<cable::CableArm>(expected).tick;
  const auto [at, end] = std::mismatch(expected.begin(), expected.end(), answered.begin(), answered.end());
  const bool both = at != expected.end() && end != answered.end();
  result.first_field =
      both ? outputs_field_at<cable::CableArm>(static_cast<std::size_t>(at - expected.begin())) : "nothing";
}

}  // namespace

Comparison compare(std::istream& expected, std::istream& answered) {
  Comparison result;
  for (;;) {
    const std::string wanted = next_of(expected), got = next_of(answered);
    if (wanted.empty() && got.empty()) return result;
    if (!wanted.empty()) ++result.ticks;
    if (wanted == got) continue;
    if (result.differing_ticks++ == 0) note_first(wanted, got, result);
  }
}

}  // namespace liana::bits
