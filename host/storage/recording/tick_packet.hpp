// Binary packets of the API topic `tick` (docs/reference/api.md): what lianad sends to the archive.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "firmware_like/controller.hpp"
#include "host/storage/recording/tick_record.hpp"
#include "host/storage/recording/visit.hpp"

namespace liana::recording {

// First byte of a packet. JSON packets start with '{' and never collide.
enum class TickPacket : std::uint8_t {
  kTick = 1,  // u64 dropped, u8 drives, thetas, segments, u32 length of Inputs, Inputs, Outputs
  kImage =
      2,  // u64 next tick, u8 fresh (1: the Controller has not ticked yet), the robot's table, the Controller's fields
};

// One packet per tick; `dropped` counts ticks that were lost on the way so far, `counts` are the robot's.
template <class Arm>
std::string tick_packet(const TickRecord<Arm>& record, std::uint64_t dropped, const RecordedCounts& counts);

// The file that holds what image packets carry.
constexpr const char* kImagesFile = "snapshots.mcap";

// One packet before the first tick (of the table alone: the Controller has not ticked yet) and every kImageEveryTicks.
constexpr std::uint64_t kImageEveryTicks = 1000;
template <class Arm>
std::string image_packet(std::uint64_t next_tick, const typename Arm::Table& table);
template <class Arm>
std::string image_packet(std::uint64_t next_tick, const Controller<Arm>& controller);

// Splits a kTick packet into recorded inputs and outputs; throws std::runtime_error when its length is wrong.
struct TickParts {
  std::uint64_t dropped = 0;
  RecordedCounts counts;
  std::string_view inputs, outputs;
};
TickParts split_tick_packet(std::string_view packet);

// Which packet this is; throws std::runtime_error when it is none.
TickPacket tick_packet_kind(std::string_view packet);

// Content of a start or controller_snapshot message.
template <class Arm>
struct ControllerSnapshot {
  std::uint64_t next_tick = 0;
  bool fresh = false;  // the Controller has not ticked yet: the table says all
  typename Arm::Table table{};
  std::string_view state;  // of the Controller (image.hpp), empty when fresh; only the same build can use it
};
// Throws std::runtime_error with file (`source`), field, value and what is allowed, when the table would harm the core.
template <class Arm>
ControllerSnapshot<Arm> parse_image(std::string_view data, const std::string& source = kImagesFile);

}  // namespace liana::recording
