// The calibration of one arm: what `liana calibrate` measured of every drive and cable, and when it may be used
// (docs/how-to/calibrate.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/drives/calibration/table_fields.hpp"
#include "host/model/config/config.hpp"

namespace liana::calibration {

// One drive with its cable.
struct CableCalibration {
  std::uint32_t serial = 0;      // 0x1018:4 of the drive
  std::int32_t direction = 1;    // +1: counts grow while cable is paid out
  std::int32_t zero_counts = 0;  // at payout = path at the zero pose + lead
  double drum_radius_m = 0.0;
  double pretension_N = 0.0;  // found at the first pose
  double offset_m = 0.0;      // of the zero against the robot table's; for people
};

// Friction between cables and holes, and its standard deviation.
struct FrictionOf {
  double mu = 0.0;
  double sd = 0.0;
};
struct Friction {
  FrictionOf arm;                                  // of all segments together
  std::vector<std::optional<FrictionOf>> segment;  // nothing where it cannot be told apart
};

struct Calibration {
  std::string robot;         // name
  std::string robot_sha256;  // of the robot's canonical JSON
  std::string date;          // YYYY-MM-DD, UTC
  std::vector<CableCalibration> cables;
  std::optional<Friction> friction{};  // only where it was measured
  std::vector<FieldValue> fields{};    // what was measured of the robot table's (table_fields.hpp), in their order
};

// Today in UTC as YYYY-MM-DD.
std::string today_utc();

// The file's text: canonical JSON with a checksum over everything else in it.
std::string calibration_json(const Calibration& calibration);

// Reads a calibration for `robot` as of `today`. Throws std::runtime_error "file: field: value: allowed ...: what to
// do" when the checksum is wrong, it is for another robot or table, older than drives.calibration_days of the robot
// table, from the future, or holds a value out of range.
Calibration parse_calibration(const std::string& text, const std::string& file, const config::RobotConfig& robot,
                              const std::string& today);
Calibration load_calibration(const std::string& path, const config::RobotConfig& robot, const std::string& today);

// Every cable is longer than its drive says by `longer_m`: its zero is put right.
void shift_zeros(const cable::CableVector& longer_m, const config::RobotConfig& robot, Calibration& calibration);

// The robot with the calibration's drums, directions, zeros and drive serial numbers in place of its table's, and its
// friction and other fields where those were measured.
void apply(const Calibration& calibration, config::RobotConfig& robot);

}  // namespace liana::calibration
