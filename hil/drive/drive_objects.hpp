// The table of objects a simulated drive has (docs/reference/drives.md).
#pragma once

#include <cstdint>

#include "hil/config/dictionary_config.hpp"
#include "hil/drive/object_dictionary.hpp"

namespace liana::bench {

// What differs from drive to drive.
struct DriveSettings {
  int node = 1;  // 1..126
  int axis = 1;  // of the node
  int axes = 1;  // that the node has
  std::uint8_t bus = 0;
  std::uint32_t vendor = 0;
  std::uint32_t product = 0;
  std::uint32_t revision = 0;
  std::uint32_t serial = 0;
  std::uint32_t counts_per_turn = 65536;
  double rated_torque_mNm = 9000;     // before the gear
  double gear = 1.0;                  // motor turns per turn behind the gear, to three decimals
  double fastest_counts_per_s = 0.0;  // that it will be told; 0: not known
  double servo_time_constant_s = 0.03;
  int pull_direction = -1;            // sign of counts that winds cable up
  bool holds_both_ways = false;       // what it moves pulls at it or pushes it: its torque has either sign
  bool is_torque_controlled = false;  // has cyclic synchronous torque, and a joint torque sensor
  DictionaryConfig dictionary;

  // Increments in a unit of 6085.
  double counts_per_speed_unit() const { return dictionary.speeds_in_rpm ? counts_per_turn / 60.0 : 1.0; }
};

// The bench's own dictionary as `dictionary` changes it; throws std::runtime_error naming an object that it does not
// have. Power-on values: PDO 1 of each direction enabled with its predefined COB-ID and no mapping, PDOs 2 to 4, and
// all of a second axis, disabled.
ObjectDictionary make_objects(const DriveSettings& settings);

}  // namespace liana::bench
