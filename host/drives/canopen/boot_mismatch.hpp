// Why a drive could not be booted.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "host/drives/canopen/boot_plan.hpp"

namespace liana::canopen {

enum class BootFailure : std::uint8_t {
  kNone,
  kNoBootUp,        // nothing heard after reset communication
  kNoAnswer,        // SDO timeouts
  kAborted,         // the drive refused: abort_code
  kValue,           // expected and found differ
  kRestarts,        // the drive boots again and again
  kNotOperational,  // started, but no heartbeat says operational
};

struct BootMismatch {
  BootFailure failure = BootFailure::kNone;
  int bus = 0;
  std::uint8_t node = 0;
  std::uint8_t axis = 0;    // of the node; 0: it is about the whole node
  std::uint16_t index = 0;  // object, 0 when no object is concerned
  std::uint8_t sub = 0;
  bool written = false;  // the object was being written
  const char* object_name = "";
  std::uint32_t expected = 0;
  std::uint32_t mask = 0xFFFFFFFF;  // bits that are compared; those that the object has not are set
  std::uint32_t found = 0;          // whole, whatever the mask; kNotOperational: byte of the last heartbeat
  std::uint32_t abort_code = 0;
  bool has_found = false;  // kAborted: what could not be written was read instead; kNotOperational: it had a heartbeat
  std::optional<std::uint8_t> odd_length;  // bytes of an answer or heartbeat that was none for its length
  BootRule rule = BootRule::kEqual;
  std::uint32_t expected_before = 0;  // kPair, kRange: of the object before it
  std::uint32_t found_before = 0;
};

// What a drive was compared with, and so what can be wrong: a robot table, or what it says of itself and was asked to
// do on a desk.
enum class BootReference : std::uint8_t { kRobotTable, kDesk };

// `who` is "drive 3 (node 3, segment 1) on can0". "WHO: object 0x1018:2 (product code): expected 1 (0x1), found 2
// (0x2): what to do", and the same for each further one of the node, behind "; "; `more` is how many are not among
// them. Allocates: not for the real-time thread.
std::string describe(std::span<const BootMismatch> mismatches, std::uint32_t more, const std::string& who,
                     BootReference reference = BootReference::kRobotTable);

}  // namespace liana::canopen
