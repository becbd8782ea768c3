// The comparison finds every difference, and names it.
#include "tests/bits/compare.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "host/record/serialise.hpp"

namespace liana::bits {
namespace {

std::string outputs_of(std::uint64_t tick) {
  cable::Outputs outputs;
  outputs.tick = tick;
  std::string bytes;
  append_serialised(bytes, outputs);
  return bytes;
}

Comparison compared(const std::string& expected, const std::string& answered) {
  std::istringstream one(expected), other(answered);
  return compare(one, other);
}

TEST(BitsCompare, EqualTicksDoNotDiffer) {
  const std::string run = outputs_of(7) + outputs_of(8);
  const Comparison result = compared(run, run);
  EXPECT_EQ(result.ticks, 2u);
  EXPECT_EQ(result.differing_ticks, 0u);
}

TEST(BitsCompare, EverySingleBitOfOutputsIsComparedAndItsFieldNamed) {
  const std::string run = outputs_of(7) + outputs_of(8);
  for (std::size_t byte = 0; byte < serialised_outputs_size<cable::CableArm>(); ++byte) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string other = run;
      other[serialised_outputs_size<cable::CableArm>() + byte] =
          static_cast<char>(other[serialised_outputs_size<cable::CableArm>() + byte] ^ (1 << bit));
      const Comparison result = compared(run, other);
      ASSERT_EQ(result.differing_ticks, 1u) << "byte " << byte;
      ASSERT_EQ(result.first_tick, 8u);
      ASSERT_EQ(result.first_place, 1u);
      ASSERT_EQ(result.first_field, outputs_field_at<cable::CableArm>(byte));
      ASSERT_FALSE(result.first_field.empty());
    }
  }
}

TEST(BitsCompare, ATickWithoutAnAnswerDiffers) {
  const Comparison result = compared(outputs_of(7) + outputs_of(8), outputs_of(7));
  EXPECT_EQ(result.ticks, 2u);
  EXPECT_EQ(result.differing_ticks, 1u);
  EXPECT_EQ(result.first_tick, 8u);
  EXPECT_EQ(result.first_field, "nothing");
}

TEST(BitsCompare, AnAnswerThatEndsInTheMiddleOfATickDiffers) {
  const std::string run = outputs_of(7) + outputs_of(8);
  EXPECT_EQ(compared(run, run.substr(0, run.size() - 1)).differing_ticks, 1u);
}

TEST(BitsCompare, AnAnswerTooManyDiffers) {
  EXPECT_EQ(compared(outputs_of(7), outputs_of(7) + outputs_of(8)).differing_ticks, 1u);
}

}  // namespace
}  // namespace liana::bits
