#include "hil/drive/object_names.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>

#include "hil/drive/pdo.hpp"

namespace liana::bench {

namespace {

using enum ObjectCode;

struct Named {
  std::uint16_t index;
  ObjectCode code;
  const char* name;
  std::array<const char*, 8> entries{};  // by sub-index; nothing: as all lists begin, or none
};

constexpr const char* kHighest = "Highest sub-index supported";

constexpr Named kNamed[] = {
    {0x1000, kVariable, "Device type"},
    {0x1001, kVariable, "Error register"},
    {0x1003, kArray, "Pre-defined error field", {"Number of errors", "Standard error field 1"}},
    {0x1005, kVariable, "COB-ID SYNC message"},
    {0x1008, kVariable, "Manufacturer device name"},
    {0x1014, kVariable, "COB-ID EMCY"},
    {0x1016, kArray, "Consumer heartbeat time", {kHighest, "Consumer heartbeat time 1"}},
    {0x1017, kVariable, "Producer heartbeat time"},
    {0x1018, kRecord, "Identity object", {kHighest, "Vendor-ID", "Product code", "Revision number", "Serial number"}},
    {0x1029, kArray, "Error behaviour object", {kHighest, "Communication error"}},
    {0x6007, kVariable, "Abort connection option code"},
    {0x3001,
     kRecord,
     "Torque loop",
     {kHighest, "Joint damping", "Drift integral", "Torque gain", "Torque integral", "Torque derivative",
      "Ramp of a stop", "Speed of rest"}},
    {0x603F, kVariable, "Error code"},
    {0x6040, kVariable, "Controlword"},
    {0x6041, kVariable, "Statusword"},
    {0x605A, kVariable, "Quick stop option code"},
    {0x605E, kVariable, "Fault reaction option code"},
    {0x6060, kVariable, "Modes of operation"},
    {0x6061, kVariable, "Modes of operation display"},
    {0x6062, kVariable, "Position demand value"},
    {0x6064, kVariable, "Position actual value"},
    {0x6065, kVariable, "Following error window"},
    {0x6066, kVariable, "Following error time out"},
    {0x606C, kVariable, "Velocity actual value"},
    {0x6071, kVariable, "Target torque"},
    {0x6072, kVariable, "Max torque"},
    {0x6076, kVariable, "Motor rated torque"},
    {0x6077, kVariable, "Torque actual value"},
    {0x6078, kVariable, "Current actual value"},
    {0x607A, kVariable, "Target position"},
    {0x607D, kArray, "Software position limit", {kHighest, "Min position limit", "Max position limit"}},
    {0x607E, kVariable, "Polarity"},
    {0x607F, kVariable, "Max profile velocity"},
    {0x6080, kVariable, "Max motor speed"},
    {0x6085, kVariable, "Quick stop deceleration"},
    {0x608F, kArray, "Position encoder resolution", {kHighest, "Encoder increments", "Motor revolutions"}},
    {0x6091, kArray, "Gear ratio", {kHighest, "Motor revolutions", "Shaft revolutions"}},
    {0x6092, kArray, "Feed constant", {kHighest, "Feed", "Shaft revolutions"}},
    {0x60A8, kVariable, "SI unit position"},
    {0x60A9, kVariable, "SI unit velocity"},
    {0x60B1, kVariable, "Velocity offset"},
    {0x60B2, kVariable, "Torque offset"},
    {0x60C2, kRecord, "Interpolation time period", {kHighest, "Time period value", "Time index"}},
    {0x60C5, kVariable, "Max acceleration"},
    {0x60F4, kVariable, "Following error actual value"},
    {0x6502, kVariable, "Supported drive modes"},
};

const Named* find(std::uint16_t index) {
  const Named* const found =
      std::find_if(std::begin(kNamed), std::end(kNamed), [index](const Named& each) { return each.index == index; });
  return found == std::end(kNamed) ? nullptr : found;
}

bool is_receive(std::uint16_t index) { return (index & 0x0800) == 0; }
bool is_mapping(std::uint16_t index) { return (index & 0x0200) != 0; }

std::string pdo_entry(std::uint16_t index, std::uint8_t sub) {
  if (is_mapping(index)) return sub == 0 ? "Number of mapped objects" : "Mapped object " + std::to_string(sub);
  switch (sub) {
    case 0:
      return kHighest;
    case 1:
      return is_receive(index) ? "COB-ID used by RPDO" : "COB-ID used by TPDO";
    case 2:
      return "Transmission type";
    default:
      return "Event timer";
  }
}

}  // namespace

ObjectCode code_of(std::uint16_t index) {
  if (is_pdo_object(index)) return kRecord;
  const Named* const named = find(index);
  return named == nullptr ? kVariable : named->code;
}

std::string name_of_index(std::uint16_t index) {
  if (is_pdo_object(index))
    return (is_receive(index) ? "RPDO" : "TPDO") + std::to_string((index & 0xFF) + 1) +
           (is_mapping(index) ? " mapping parameter" : " communication parameter");
  if (const Named* const named = find(index)) return named->name;
  char text[16];
  std::snprintf(text, sizeof text, "Object %04X", index);
  return text;
}

std::string name_of_entry(std::uint16_t index, std::uint8_t sub) {
  if (is_pdo_object(index)) return pdo_entry(index, sub);
  const Named* const named = find(index);
  const bool has_name = named != nullptr && sub < named->entries.size() && named->entries[sub] != nullptr;
  return has_name ? named->entries[sub] : "Entry " + std::to_string(sub);
}

}  // namespace liana::bench
