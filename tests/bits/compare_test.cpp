// The comparison finds every difference, and names it.
#include "tests/bits/compare.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "host/storage/recording/serialise.hpp"

namespace liana::bits {
namespace {

template <class Arm>
std::string outputs_of(std::uint64_t tick) {
  Outputs<Arm> outputs;
  outputs.tick = tick;
  std::string bytes;
  recording::append_serialised(bytes, outputs);
  return bytes;
}

template <class Arm>
Comparison compared(const std::string& expected, const std::string& answered) {
  std::istringstream one(expected), other(answered);
  return compare<Arm>(one, other);
}

template <class Arm>
class BitsCompare : public testing::Test {};
using BothArms = testing::Types<cable::CableArm, serial::SerialArm>;
TYPED_TEST_SUITE(BitsCompare, BothArms);

TYPED_TEST(BitsCompare, EqualTicksDoNotDiffer) {
  const std::string run = outputs_of<TypeParam>(7) + outputs_of<TypeParam>(8);
  const Comparison result = compared<TypeParam>(run, run);
  EXPECT_EQ(result.ticks, 2u);
  EXPECT_EQ(result.differing_ticks, 0u);
}

TYPED_TEST(BitsCompare, EverySingleBitOfOutputsIsComparedAndItsFieldNamed) {
  const std::string run = outputs_of<TypeParam>(7) + outputs_of<TypeParam>(8);
  const std::size_t size = recording::serialised_outputs_size<TypeParam>();
  for (std::size_t byte = 0; byte < size; ++byte) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string other = run;
      char& changed = other[size + byte];
      changed = static_cast<char>(changed ^ (1 << bit));
      const Comparison result = compared<TypeParam>(run, other);
      ASSERT_EQ(result.differing_ticks, 1u) << "byte " << byte;
      ASSERT_EQ(result.first_tick, 8u);
      ASSERT_EQ(result.first_place, 1u);
      ASSERT_EQ(result.first_field, recording::outputs_field_at<TypeParam>(byte));
      ASSERT_FALSE(result.first_field.empty());
    }
  }
}

TYPED_TEST(BitsCompare, ATickWithoutAnAnswerDiffers) {
  const Comparison result =
      compared<TypeParam>(outputs_of<TypeParam>(7) + outputs_of<TypeParam>(8), outputs_of<TypeParam>(7));
  EXPECT_EQ(result.ticks, 2u);
  EXPECT_EQ(result.differing_ticks, 1u);
  EXPECT_EQ(result.first_tick, 8u);
  EXPECT_EQ(result.first_field, "nothing");
}

TYPED_TEST(BitsCompare, AnAnswerThatEndsInTheMiddleOfATickDiffers) {
  const std::string run = outputs_of<TypeParam>(7) + outputs_of<TypeParam>(8);
  EXPECT_EQ(compared<TypeParam>(run, run.substr(0, run.size() - 1)).differing_ticks, 1u);
}

TYPED_TEST(BitsCompare, AnAnswerTooManyDiffers) {
  EXPECT_EQ(compared<TypeParam>(outputs_of<TypeParam>(7), outputs_of<TypeParam>(7) + outputs_of<TypeParam>(8))
                .differing_ticks,
            1u);
}

}  // namespace
}  // namespace liana::bits
