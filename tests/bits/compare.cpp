#include "tests/bits/compare.hpp"

#include <algorithm>

#include "host/storage/recording/serialise.hpp"

namespace liana::bits {
namespace {

// The next tick's Outputs; shorter where the file ends.
template <class Arm>
std::string next_of(std::istream& file) {
  std::string bytes(recording::serialised_outputs_size<Arm>(), '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

template <class Arm>
void note_first(const std::string& expected, const std::string& answered, Comparison& result) {
  result.first_place = std::max<std::uint64_t>(result.ticks, 1) - 1;
  if (expected.size() == recording::serialised_outputs_size<Arm>())
    result.first_tick = recording::outputs_from<Arm>(expected).tick;
  const auto [at, end] = std::mismatch(expected.begin(), expected.end(), answered.begin(), answered.end());
  const bool both = at != expected.end() && end != answered.end();
  result.first_field =
      both ? recording::outputs_field_at<Arm>(static_cast<std::size_t>(at - expected.begin())) : "nothing";
}

}  // namespace

template <class Arm>
Comparison compare(std::istream& expected, std::istream& answered) {
  Comparison result;
  for (;;) {
    const std::string wanted = next_of<Arm>(expected), got = next_of<Arm>(answered);
    if (wanted.empty() && got.empty()) return result;
    if (!wanted.empty()) ++result.ticks;
    if (wanted == got) continue;
    if (result.differing_ticks++ == 0) note_first<Arm>(wanted, got, result);
  }
}

template Comparison compare<cable::CableArm>(std::istream&, std::istream&);
template Comparison compare<serial::SerialArm>(std::istream&, std::istream&);

}  // namespace liana::bits
