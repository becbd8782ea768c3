// What the object dictionary of a simulated drive is, where it is another than the bench's own
// (docs/reference/drives.md).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace liana::bench {

class JsonFile;

// An object; no sub-index: all of them.
struct ObjectPlace {
  std::uint16_t index = 0;
  std::optional<std::uint8_t> sub;
  friend auto operator<=>(const ObjectPlace&, const ObjectPlace&) = default;
};

// An object that the bench's own dictionary has not.
struct AddedObject {
  ObjectPlace place;
  std::string type;  // u8, i8, u16, i16, u32, i32
  bool is_read_only = false;
  std::int64_t value = 0;
  std::optional<std::int64_t> low;  // not given: all that the type can say
  std::optional<std::int64_t> high;
};

struct DictionaryConfig {
  std::string drive_type;  // whose it is, for messages; empty: the bench's own
  std::vector<ObjectPlace> absent;
  std::vector<ObjectPlace> read_only;
  std::map<ObjectPlace, std::int64_t> values;  // at power-on
  std::vector<AddedObject> added;
  std::optional<std::uint32_t> vendor;  // 1018:1 to 3; not given: the robot's
  std::optional<std::uint32_t> product;
  std::optional<std::uint32_t> revision;
  double rated_torque_per_mNm = 1.0;  // how 6076 counts: 1000 for uNm
  bool speeds_in_rpm = false;         // how 6085 counts: rpm/s of the motor, else increments/s^2
  std::uint64_t sdo_us = 0;           // from an SDO request to its answer
  std::uint64_t reset_us = 0;         // from power-on or an NMT reset to the boot-up message; deaf meanwhile
};

// The dictionaries that a bus table gives its drives, by node: of each entry of `drives` that of the type `bench`, or
// of `type` where there is no `bench`. A drive that is not among them has the bench's own. Throws std::runtime_error
// naming file, field, value and what is allowed.
std::map<int, DictionaryConfig> read_dictionaries(const JsonFile& buses);

}  // namespace liana::bench
