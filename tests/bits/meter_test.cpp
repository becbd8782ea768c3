// What the Cortex-M7 counted is summed up, and refused where it cannot be true.
#include "tests/bits/meter.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/storage/recording/codec.hpp"
#include "host/storage/recording/serialise.hpp"
#include "tests/bits/tape.hpp"

namespace liana::bits {
namespace {

constexpr Count kCalibration{kCalibrationInstructions / 5 * 4, 0};  // 1.25 instructions a clock

std::string bytes_of(const std::vector<Count>& counts) {
  std::string bytes;
  recording::Writer writer(bytes);
  for (const Count& count : counts) {
    writer("clocks", count.clocks);
    writer("stack_bytes", count.stack_bytes);
  }
  return bytes;
}

std::string ticks_in(const std::vector<OperatingState>& states) {
  std::string bytes;
  cable::Outputs outputs;
  for (const OperatingState state : states) {
    ++outputs.tick;
    outputs.state = state;
    recording::append_serialised(bytes, outputs);
  }
  return bytes;
}

MeterSummary summary_of(const std::vector<OperatingState>& states, const std::vector<Count>& counts) {
  std::istringstream outputs(ticks_in(states)), meter(bytes_of(counts));
  return summarise<cable::CableArm>(outputs, meter);
}

constexpr OperatingState kOn = OperatingState::kEnabled, kFault = OperatingState::kFault;

TEST(BitsMeter, TheMedianIsOfEnabledTicksTheWorstOfAll) {
  const MeterSummary summary =
      summary_of({kFault, kOn, kOn, kOn}, {kCalibration, {9000, 400}, {800, 100}, {1600, 900}, {2400, 200}});
  EXPECT_EQ(summary.ticks, 4u);
  EXPECT_EQ(summary.median_instructions, 2000.0);
  EXPECT_EQ(summary.worst_instructions, 11250.0);
  EXPECT_EQ(summary.worst_tick, 1u);
  EXPECT_EQ(summary.worst_state, "fault");
  EXPECT_EQ(summary.worst_stack_bytes, 900u);
}

TEST(BitsMeter, AClockThatDoesNotCountInstructionsIsRefused) {
  EXPECT_THROW(summary_of({kOn}, {{kCalibration.clocks / 2, 0}, {800, 100}}), std::runtime_error);
  EXPECT_THROW(summary_of({kOn}, {}), std::runtime_error);
}

TEST(BitsMeter, OneCountForEachTickOrItIsRefused) {
  EXPECT_THROW(summary_of({kOn, kOn}, {kCalibration, {800, 100}}), std::runtime_error);
  EXPECT_THROW(summary_of({kOn}, {kCalibration, {800, 100}, {800, 100}}), std::runtime_error);
}

}  // namespace
}  // namespace liana::bits
