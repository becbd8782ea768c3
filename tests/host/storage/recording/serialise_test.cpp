// Serialisation: complete, little-endian, the same both ways.
#include "host/storage/recording/serialise.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <utility>

#include "host/storage/recording/visit.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::recording {

using namespace cable;
namespace {

// Bytes of a value in which every bit pattern is different from its neighbours; padding included.
template <class T>
T patterned() {
  std::array<unsigned char, sizeof(T)> bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<unsigned char>(1 + (i * 37) % 120);
  T value;
  std::memcpy(static_cast<void*>(&value), bytes.data(), sizeof(T));
  return value;
}

template <class T>
std::string serialised(const T& value) {
  std::string out;
  append_serialised(out, value);
  return out;
}

TEST(Serialise, OutputsComeBackBitForBit) {
  const std::string bytes = serialised(patterned<cable::Outputs>());
  EXPECT_EQ(serialised(outputs_from<cable::CableArm>(bytes)), bytes);
}

TEST(Serialise, InputsComeBackBitForBitWithTheirTelecommand) {
  const cable::Inputs inputs = patterned<cable::Inputs>();
  const cable::Inputs back = RecordingDecoder::inputs<cable::CableArm>(serialised(inputs));
  EXPECT_EQ(serialised(back), serialised(inputs));
  EXPECT_EQ(back.telecommand.sequence(), inputs.telecommand.sequence());
  EXPECT_EQ(back.telecommand.expiry_tick(), inputs.telecommand.expiry_tick());
}

TEST(Serialise, TheRobotTableComesBack) {
  const std::string bytes = serialised(zhu2022::table());
  EXPECT_EQ(serialised(table_from<cable::CableArm>(bytes)), bytes);
}

TEST(Serialise, NumbersAreLittleEndian) {
  cable::Outputs outputs;
  outputs.tick = 0x0102030405060708u;
  EXPECT_EQ(serialised(outputs).substr(0, 8), std::string("\x08\x07\x06\x05\x04\x03\x02\x01"));
}

TEST(Serialise, ShortOrLongDataIsRefused) {
  const std::string bytes = serialised(cable::Outputs{});
  EXPECT_THROW(outputs_from<cable::CableArm>(bytes.substr(1)), std::runtime_error);
  EXPECT_THROW(outputs_from<cable::CableArm>(bytes + "x"), std::runtime_error);
}

TEST(Serialise, AByteOffsetNamesItsField) {
  EXPECT_EQ(outputs_field_at<cable::CableArm>(0), "tick");
  EXPECT_EQ(outputs_field_at<cable::CableArm>(8), "state");
  cable::Outputs a, b;
  b.drive[3].target_counts = 7;
  const std::string x = serialised(a), y = serialised(b);
  std::size_t at = 0;
  while (x[at] == y[at]) ++at;
  EXPECT_EQ(outputs_field_at<cable::CableArm>(at), "drive[3].target_counts");
  EXPECT_EQ(outputs_field_at<cable::CableArm>(1u << 20), "");
}

// Converts to any field; counts how many an aggregate has.
struct AnyField {
  template <class T>
  operator T() const;
};
template <class T, std::size_t... I>
constexpr bool has_fields(std::index_sequence<I...>) {
  return requires { T{(static_cast<void>(I), AnyField{})...}; };
}
template <class T, std::size_t N = 48>
constexpr std::size_t field_count() {
  if constexpr (has_fields<T>(std::make_index_sequence<N>{})) return N;
  if constexpr (!has_fields<T>(std::make_index_sequence<N>{})) return field_count<T, N - 1>();
}

struct FieldCounter {
  std::size_t count = 0;
  template <class T>
  void operator()(const char*, const T&) {
    ++count;
  }
};
template <class T>
std::size_t visited_fields() {
  FieldCounter counter;
  const T value{};
  visit(counter, value);
  return counter.count;
}

TEST(Serialise, NoFieldIsForgotten) {
  EXPECT_EQ(visited_fields<cable::Inputs>(), field_count<CycleInputs>() + 1)
      << "and sensors; the telecommand is visited by itself";
  EXPECT_EQ(visited_fields<cable::LoadCells>(), field_count<cable::LoadCells>());
  EXPECT_EQ(visited_fields<cable::Outputs>(), field_count<CycleOutputs>() + field_count<cable::Report>());
  EXPECT_EQ(visited_fields<FaultList>(), field_count<FaultList>());
  EXPECT_EQ(visited_fields<Fault>(), field_count<Fault>());
  EXPECT_EQ(visited_fields<DriveFeedback>(), field_count<DriveFeedback>());
  EXPECT_EQ(visited_fields<DriveCommand>(), field_count<DriveCommand>());
  EXPECT_EQ(visited_fields<Pose>(), field_count<Pose>());
  EXPECT_EQ(visited_fields<cable::Setpoint>(), field_count<cable::Setpoint>());
  EXPECT_EQ(visited_fields<cable::NodeTarget>(), field_count<cable::NodeTarget>());
  EXPECT_EQ(visited_fields<cable::RobotParams>(), field_count<cable::RobotParams>());
  EXPECT_EQ(visited_fields<cable::SegmentParams>(), field_count<cable::SegmentParams>());
  EXPECT_EQ(visited_fields<cable::TensionLimits>(), field_count<cable::TensionLimits>());
  EXPECT_EQ(visited_fields<cable::MotionLimits>(), field_count<cable::MotionLimits>());
  EXPECT_EQ(visited_fields<cable::DriveParams>(), field_count<cable::DriveParams>());
}

}  // namespace
}  // namespace liana::recording
