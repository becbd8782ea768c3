#include "hil/drive/drive_objects.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hil/drive/dictionary_changes.hpp"

namespace liana::bench {

namespace {

using enum ObjectType;
using enum Access;

constexpr std::int64_t kU32Max = 0xFFFFFFFF;
constexpr std::int64_t kI32Min = -0x80000000LL;
constexpr std::int64_t kI32Max = 0x7FFFFFFF;
constexpr std::uint32_t kDisabled = 0x80000000;

// Index, sub, type, access, mappable, value, low, high.
constexpr Object kCommon[] = {
    {0x1000, 0, kU32, kReadOnly, false, 0x00020192, 0, kU32Max},  // device type: servo drive, CiA 402
    {0x1001, 0, kU8, kReadOnly, false, 0, 0, 255},                // error register
    {0x1003, 0, kU8, kReadWrite, false, 0, 0, 0},                 // error history: writing 0 clears it
    {0x1003, 1, kU32, kReadOnly, false, 0, 0, kU32Max},
    {0x1005, 0, kU32, kReadWrite, false, 0x80, 0x80, 0x80},  // SYNC COB-ID
    {0x1008, 0, kText, kReadOnly, false, 0, 0, 0, "Liana bench drive"},
    {0x1016, 0, kU8, kReadOnly, false, 1, 0, 255},
    {0x1016, 1, kU32, kReadWrite, false, 0, 0, 0x7FFFFF},  // consumer heartbeat: node << 16 | ms
    {0x1017, 0, kU16, kReadWrite, false, 0, 0, 65535},     // producer heartbeat [ms]
    {0x1018, 0, kU8, kReadOnly, false, 4, 0, 255},
    {0x1029, 0, kU8, kReadOnly, false, 1, 0, 255},
    {0x1029, 1, kU8, kReadWrite, false, 0, 0, 2},      // master lost: 0 pre-operational, 1 no change, 2 stopped
    {0x6007, 0, kI16, kReadWrite, false, 3, 0, 3},     // abort connection: 3 = quick stop
    {0x603F, 0, kU16, kReadOnly, true, 0, 0, 65535},   // last error code
    {0x6040, 0, kU16, kReadWrite, true, 0, 0, 65535},  // controlword
    {0x6041, 0, kU16, kReadOnly, true, 0, 0, 65535},   // statusword
    {0x605A, 0, kI16, kReadWrite, false, 2, 2, 2},     // quick stop: ramp, then switch-on disabled
    {0x605E, 0, kI16, kReadWrite, false, 2, 2, 2},     // fault reaction: quick-stop ramp
    {0x6060, 0, kI8, kReadWrite, true, 0, -128, 127},  // mode: csp only, see the write guard
    {0x6061, 0, kI8, kReadOnly, true, 0, -128, 127},
    {0x6062, 0, kI32, kReadOnly, true, 0, kI32Min, kI32Max},   // position demand
    {0x6064, 0, kI32, kReadOnly, true, 0, kI32Min, kI32Max},   // position actual
    {0x6065, 0, kU32, kReadWrite, false, 20000, 0, kU32Max},   // following error window [counts]
    {0x6066, 0, kU16, kReadWrite, false, 100, 0, 65535},       // following error time [ms]
    {0x606C, 0, kI32, kReadOnly, true, 0, kI32Min, kI32Max},   // velocity [counts/s]
    {0x6072, 0, kU16, kReadWrite, true, 1000, 0, 3000},        // max torque [permille]
    {0x6077, 0, kI16, kReadOnly, true, 0, -32768, 32767},      // torque [permille of rated]
    {0x6078, 0, kI16, kReadOnly, true, 0, -32768, 32767},      // current [permille of rated]
    {0x607A, 0, kI32, kReadWrite, true, 0, kI32Min, kI32Max},  // target position
    {0x608F, 0, kU8, kReadOnly, false, 2, 0, 255},
    {0x608F, 2, kU32, kReadOnly, false, 1, 0, kU32Max},  // motor revolutions
    {0x60C2, 0, kU8, kReadOnly, false, 2, 0, 255},
    {0x60C2, 1, kU8, kReadWrite, false, 4, 1, 255},           // interpolation period
    {0x60C2, 2, kI8, kReadWrite, false, -3, -6, 0},           // its power of ten [s]
    {0x60F4, 0, kI32, kReadOnly, true, 0, kI32Min, kI32Max},  // following error
    {0x6502, 0, kU32, kReadOnly, false, 0x80, 0, kU32Max},    // supported modes: csp
};

constexpr std::int64_t kBothModes = 0x80 | 0x200;  // 6502: csp and cst

// What only a drive with a joint torque sensor has. Gains: docs/reference/drives.md.
constexpr Object kTorque[] = {
    {0x3001, 0, kU8, kReadOnly, false, 7, 0, 255},
    {0x3001, 1, kU32, kReadWrite, false, 3000, 0, 1000000},    // damping [N.m.s/rad]
    {0x3001, 2, kU32, kReadWrite, false, 2000, 0, 100000},     // drift integral [0.001/s]
    {0x3001, 3, kU32, kReadWrite, false, 3000, 0, 100000},     // torque gain [0.001]
    {0x3001, 4, kU32, kReadWrite, false, 10000, 0, 1000000},   // torque integral [0.001/s]
    {0x3001, 5, kU32, kReadWrite, false, 0, 0, 1000000},       // torque derivative [us]
    {0x3001, 6, kU32, kReadWrite, false, 100, 0, 10000},       // ramp of a stop [ms]
    {0x3001, 7, kU32, kReadWrite, false, 50, 0, kI32Max},      // speed that counts as rest [counts/s]
    {0x6071, 0, kI16, kReadWrite, true, 0, -32768, 32767},     // target torque [permille of rated]
    {0x60B1, 0, kI32, kReadWrite, true, 0, kI32Min, kI32Max},  // velocity offset [counts/s]
    {0x60B2, 0, kI16, kReadWrite, true, 0, -32768, 32767},     // torque offset [permille of rated]
};

void add_torque(std::vector<Object>& objects) {
  objects.insert(objects.end(), std::begin(kTorque), std::end(kTorque));
  for (Object& object : objects)
    if (object.index == 0x6502) object.value = kBothModes;
}

void add_pdo(std::vector<Object>& objects, std::uint16_t number, const DriveSettings& settings, bool receive) {
  const auto communication = static_cast<std::uint16_t>((receive ? 0x1400 : 0x1800) + number);
  const auto mapping = static_cast<std::uint16_t>((receive ? 0x1600 : 0x1A00) + number);
  const std::uint32_t usual = (receive ? 0x200U : 0x180U) + 0x100U * number + static_cast<std::uint32_t>(settings.node);
  const std::uint32_t cob = settings.axis == 1 ? usual : 0;  // none is predefined for further axes
  const bool is_on = number == 0 && settings.axis == 1;
  objects.push_back({communication, 0, kU8, kReadOnly, false, 5, 0, 255});
  objects.push_back({communication, 1, kU32, kReadWrite, false, is_on ? cob : (cob | kDisabled), 0, kU32Max});
  objects.push_back({communication, 2, kU8, kReadWrite, false, 1, 0, 255});
  objects.push_back(
      {communication, 5, kU16, kReadWrite, false, 0, 0, 65535});  // event timer; on an RPDO the deadline [ms]
  objects.push_back({mapping, 0, kU8, kReadWrite, false, 0, 0, 8});
  for (std::uint8_t entry = 1; entry <= 8; ++entry)
    objects.push_back({mapping, entry, kU32, kReadWrite, false, 0, 0, kU32Max});
}

// Set up as a drive has to be: from its fastest command it rests within 67 ms.
std::int64_t quick_stop_deceleration(const DriveSettings& settings) {
  constexpr double kLeast = 200000.0, kPerSecond = 15.0;  // increments/s^2; and those per increment/s
  return std::llround(std::max(kLeast, kPerSecond * settings.fastest_counts_per_s) / settings.counts_per_speed_unit());
}

}  // namespace

ObjectDictionary make_objects(const DriveSettings& settings) {
  std::vector<Object> objects(std::begin(kCommon), std::end(kCommon));
  const std::int64_t identity[] = {settings.vendor, settings.product, settings.revision, settings.serial};
  for (std::uint8_t i = 0; i < 4; ++i)
    objects.push_back({0x1018, static_cast<std::uint8_t>(i + 1), kU32, kReadOnly, false, identity[i], 0, kU32Max});
  objects.push_back({0x1014, 0, kU32, kReadOnly, false, 0x80 + settings.node, 0, kU32Max});
  objects.push_back({0x608F, 1, kU32, kReadOnly, false, settings.counts_per_turn, 0, kU32Max});
  const auto motor_turns = static_cast<std::int64_t>(std::llround(1000.0 * settings.gear));
  const std::int64_t divisor = std::gcd(motor_turns, std::int64_t{1000});
  objects.push_back({0x6091, 0, kU8, kReadOnly, false, 2, 0, 255});
  objects.push_back({0x6091, 1, kU32, kReadOnly, false, motor_turns / divisor, 0, kU32Max});
  objects.push_back({0x6091, 2, kU32, kReadOnly, false, 1000 / divisor, 0, kU32Max});
  objects.push_back({0x6085, 0, kU32, kReadWrite, false, quick_stop_deceleration(settings), 1, kU32Max});
  const double rated_torque = settings.rated_torque_mNm * settings.dictionary.rated_torque_per_mNm;
  objects.push_back({0x6076, 0, kU32, kReadOnly, false, std::llround(rated_torque), 0, kU32Max});
  if (settings.is_torque_controlled) add_torque(objects);
  for (std::uint16_t number = 0; number < 4; ++number) {
    add_pdo(objects, number, settings, true);
    add_pdo(objects, number, settings, false);
  }
  change_objects(settings.dictionary, objects);
  ObjectDictionary out(std::move(objects), settings.axis);
  out.set(0x6061, 0, out.get(0x6060));  // the mode of power-on is the one that it is in
  return out;
}

}  // namespace liana::bench
