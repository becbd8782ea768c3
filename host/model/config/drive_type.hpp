// A drive type: what a maker's object dictionary has, in which units it speaks, and what it is told at boot
// (docs/reference/drives.md). A type is a table of lua/drives; the values here are those of `cia402_csp`, which every
// drive is that no bus table names.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/base/json/json_fwd.hpp"

namespace liana::config {

class Field;

// What a type says of an object that the boot reads or writes.
enum class Presence : std::uint8_t {
  kRequired,  // without it the drive is refused
  kOptional,  // asked for; a drive without it is right, and what it would have said is not checked
  kAbsent,    // never asked for: the maker's dictionary has none
  kFixed,     // only read, and compared
};

// An object, e.g. 6065:0 or 1400:5.
struct ObjectId {
  std::uint16_t index = 0;
  std::uint8_t sub = 0;
  friend auto operator<=>(const ObjectId&, const ObjectId&) = default;
};

struct ObjectRule {
  Presence presence = Presence::kRequired;
  std::optional<std::uint32_t> value;  // fixed: what it says instead of what the boot would write
  friend bool operator==(const ObjectRule&, const ObjectRule&) = default;
};

// Two numbers of a factor of CiA 402, e.g. 6091:1 and 6091:2.
struct Factor {
  std::uint32_t first = 1;
  std::uint32_t second = 1;
  friend bool operator==(const Factor&, const Factor&) = default;
};

// How the drive's numbers are meant. Positions are always increments of the motor's encoder.
struct DriveUnits {
  std::uint32_t position = 0x00B50000;    // 60A8: increments
  std::optional<std::uint32_t> velocity;  // 60A9, compared where it is given
  bool speeds_in_rpm = false;             // 607F, 6085, 60C5 in rpm and rpm/s of the motor; else in increments
  double rated_torque_per_Nm = 1000.0;    // 6076: 1000 where it counts mNm, 1e6 where it counts uNm
  std::optional<Factor> encoder;          // 608F; not given: the robot's counts, 1
  std::optional<Factor> gear;             // 6091; not given: the robot's gear
  std::optional<Factor> feed;             // 6092; not given: counts of one turn behind the gear, 1
  friend bool operator==(const DriveUnits&, const DriveUnits&) = default;
};

// An object that drives of the type are told at boot, beside what all are told.
struct StartUpWrite {
  ObjectId object;
  std::string name;
  std::uint8_t bytes = 4;  // 1, 2 or 4
  std::uint32_t value = 0;
  bool read_back = true;
  friend bool operator==(const StartUpWrite&, const StartUpWrite&) = default;
};

// How long the drive may take [s].
struct DriveTimes {
  double sdo_answer_s = 1.0;   // for one answer
  double boot_up_s = 10.0;     // from the first reset to the boot-up message
  double operational_s = 2.0;  // from NMT start to the heartbeat that says so
  friend bool operator==(const DriveTimes&, const DriveTimes&) = default;
};

struct DriveType {
  std::string name = "cia402_csp";
  std::string source = "CiA 301 4.2.0, CiA 402-2 4.1";  // the public dictionary that it follows
  std::optional<std::uint32_t> vendor;                  // 1018:1; not given: the robot's
  std::optional<std::uint32_t> product;                 // 1018:2
  std::optional<std::uint32_t> revision;                // 1018:3
  bool is_cst =
      false;  // cyclic synchronous torque (6060 = 10) with its own process data (docs/reference/drives.md); else csp
  std::map<ObjectId, ObjectRule> objects;  // on top of generic_rules()
  DriveUnits units;
  std::uint32_t polarity = 0;                // 607E, bits 7 and 6
  std::uint16_t max_torque_permille = 1000;  // 6072
  std::uint16_t following_time_ms = 100;     // 6066
  std::int16_t quick_stop_option = 2;        // 605A
  std::int16_t fault_option = 2;             // 605E
  std::int16_t abort_connection_option = 3;  // 6007
  double stop_within_s = 0.1;                // 6085 and 60C5: from the fastest command to rest, and back
  bool has_torque = true;                    // 6077 is reported; else tension has another source, or none
  bool mapping_is_fixed = false;             // 1600 and 1A00 are read and compared, never written
  std::vector<StartUpWrite> writes;
  DriveTimes times;

  // What holds for an object: the type's own rule, else the generic one.
  ObjectRule rule_of(ObjectId object) const;
  // False where nothing is sure to stop a drive whose master is lost: 1016:1 and 1400:5 are both left out, optional or
  // fixed to 0, or 6007 is no action.
  bool stops_by_itself() const;
  friend bool operator==(const DriveType&, const DriveType&) = default;
};

// The objects that a boot may ask for or tell, with what the generic type says of each.
const std::map<ObjectId, Presence>& generic_rules();

// "6065", "0x6065" or "1400:5"; refuses what is no object. Sub-index 0 is left out.
ObjectId parse_object(const Field& field, const std::string& text);
std::string object_name(ObjectId object);

// Reads and checks a table of kind "drive" (docs/reference/drives.md has the fields); throws std::runtime_error "file:
// field: value: allowed ...: what to do".
DriveType parse_drive_type(const Json& table, const std::string& file);

}  // namespace liana::config
