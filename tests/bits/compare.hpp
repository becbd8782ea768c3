// Compares what a target answered with what was expected, every field of Outputs.
#pragma once

#include <cstdint>
#include <istream>
#include <string>

namespace liana::bits {

struct Comparison {
  std::uint64_t ticks = 0;            // expected
  std::uint64_t differing_ticks = 0;  // a tick without an answer, and one too many, differ
  std::uint64_t first_place = 0;      // on the tape, from 0; valid when ticks differ
  std::uint64_t first_tick = 0;       // Outputs::tick there
  std::string first_field;            // e.g. "drive[3].target_counts"; "nothing" when there is no answer
};

// Both are Outputs of this kind of arm, one tick after the other, in the whole form
// (host/storage/recording/serialise.hpp).
template <class Arm>
Comparison compare(std::istream& expected, std::istream& answered);

}  // namespace liana::bits
