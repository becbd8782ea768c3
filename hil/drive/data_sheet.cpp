#include "hil/drive/data_sheet.hpp"

#include <cstdio>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "hil/drive/object_names.hpp"
#include "hil/drive/pdo.hpp"

namespace liana::bench {

namespace {

constexpr char kFileName[] = "liana_bench_drive.eds";

std::string hex(std::uint64_t value, int digits = 1) {
  char text[24];
  std::snprintf(text, sizeof text, "0x%0*llX", digits, static_cast<unsigned long long>(value));
  return text;
}

std::string section(const char* name) { return "\n[" + std::string(name) + "]\n"; }

std::string line(const std::string& key, const std::string& value) { return key + "=" + value + "\n"; }

// Numbers of the data types in an EDS (CiA 301, 7.4.7).
int data_type(ObjectType type) {
  switch (type) {
    case ObjectType::kI8:
      return 0x02;
    case ObjectType::kI16:
      return 0x03;
    case ObjectType::kI32:
      return 0x04;
    case ObjectType::kU8:
      return 0x05;
    case ObjectType::kU16:
      return 0x06;
    case ObjectType::kU32:
      return 0x07;
    case ObjectType::kText:
      break;
  }
  return 0x09;
}

bool is_signed(ObjectType type) {
  return type == ObjectType::kI8 || type == ObjectType::kI16 || type == ObjectType::kI32;
}

// What the type itself can say; limits are given only where they are narrower.
std::pair<std::int64_t, std::int64_t> span_of(ObjectType type) {
  const std::int64_t values = std::int64_t{1} << (8 * size_of(type));
  return is_signed(type) ? std::pair(-values / 2, values / 2 - 1) : std::pair(std::int64_t{0}, values - 1);
}

// "rww": may be written, and be mapped into what the drive receives.
const char* access_type(const Object& object) {
  switch (object.access) {
    case Access::kReadOnly:
      return "ro";
    case Access::kWriteOnly:
      return "wo";
    case Access::kReadWrite:
      break;
  }
  return object.mappable ? "rww" : "rw";
}

bool depends_on_node(const Object& object) {
  const bool is_communication = is_pdo_object(object.index) && (object.index & 0x0200) == 0;
  return object.index == 0x1014 || (is_communication && object.sub == 1);
}

std::string default_value(const Object& object) {
  if (object.type == ObjectType::kText) return object.text;
  if (depends_on_node(object)) return "$NODEID+" + hex(static_cast<std::uint64_t>(object.value));
  const bool is_code = object.type == ObjectType::kU32 && object.index < 0x2000;
  return is_code ? hex(static_cast<std::uint64_t>(object.value)) : std::to_string(object.value);
}

std::string described(const Object& object, const std::string& name) {
  std::string out = line("ParameterName", name) + line("ObjectType", hex(static_cast<int>(ObjectCode::kVariable))) +
                    line("DataType", hex(static_cast<std::uint64_t>(data_type(object.type)), 4)) +
                    line("AccessType", access_type(object));
  const bool is_serial = object.index == 0x1018 && object.sub == 4;
  if (!is_serial) out += line("DefaultValue", default_value(object));
  out += line("PDOMapping", object.mappable ? "1" : "0");
  if (object.type == ObjectType::kText || object.access == Access::kReadOnly) return out;
  const auto [low, high] = span_of(object.type);
  if (object.low != low) out += line("LowLimit", std::to_string(object.low));
  if (object.high != high) out += line("HighLimit", std::to_string(object.high));
  return out;
}

// All entries of one index, which have one section each where there are several.
std::string described_index(const std::vector<const Object*>& entries) {
  const std::uint16_t index = entries.front()->index;
  const std::string key = hex(index, 4).substr(2);
  if (entries.size() == 1 && entries.front()->sub == 0)
    return section(key.c_str()) + described(*entries.front(), name_of_index(index));
  const ObjectCode code = code_of(index) == ObjectCode::kVariable ? ObjectCode::kRecord : code_of(index);
  std::string out = section(key.c_str()) + line("ParameterName", name_of_index(index)) +
                    line("ObjectType", hex(static_cast<std::uint64_t>(code))) +
                    line("SubNumber", std::to_string(entries.size()));
  for (const Object* entry : entries) {
    out += section((key + "sub" + hex(entry->sub).substr(2)).c_str());
    out += described(*entry, name_of_entry(index, entry->sub));
  }
  return out;
}

using Indices = std::vector<std::vector<const Object*>>;

Indices by_index(const ObjectDictionary& objects) {
  Indices out;
  for (const Object& object : objects.all()) {
    if (object.is_hidden) continue;
    if (out.empty() || out.back().front()->index != object.index) out.emplace_back();
    out.back().push_back(&object);
  }
  return out;
}

// One of the three lists that CiA 306 wants, and the objects of it.
std::string list(const char* name, const Indices& indices, const std::function<bool(std::uint16_t)>& belongs) {
  std::string numbers, objects;
  int count = 0;
  for (const auto& entries : indices) {
    const std::uint16_t index = entries.front()->index;
    if (!belongs(index)) continue;
    numbers += line(std::to_string(++count), hex(index, 4));
    objects += described_index(entries);
  }
  return section(name) + line("SupportedObjects", std::to_string(count)) + numbers + objects;
}

bool is_mandatory(std::uint16_t index) { return index == 0x1000 || index == 0x1001 || index == 0x1018; }
bool is_manufacturers(std::uint16_t index) { return index >= 0x2000 && index < 0x6000; }

std::string file_info() {
  return "[FileInfo]\n" + line("FileName", kFileName) + line("FileVersion", "1") + line("FileRevision", "1") +
         line("EDSVersion", "4.0") + line("Description", "Servo drive of the Liana bench (CiA 402, csp)") +
         line("CreationTime", "09:00AM") + line("CreationDate", "11-23-2026") + line("CreatedBy", "liana-bench --eds") +
         line("ModificationTime", "09:00AM") + line("ModificationDate", "11-23-2026") +
         line("ModifiedBy", "liana-bench --eds");
}

std::string device_info(const DriveSettings& settings) {
  std::string out = section("DeviceInfo") + line("VendorName", "Liana") + line("VendorNumber", hex(settings.vendor)) +
                    line("ProductName", "Liana bench drive") + line("ProductNumber", hex(settings.product)) +
                    line("RevisionNumber", hex(settings.revision)) + line("OrderCode", "liana-bench");
  for (const char* rate : {"10", "20", "50", "125", "250", "500", "800", "1000"})
    out += line("BaudRate_" + std::string(rate), "1");
  return out + line("SimpleBootUpMaster", "0") + line("SimpleBootUpSlave", "1") + line("Granularity", "8") +
         line("DynamicChannelsSupported", "0") + line("GroupMessaging", "0") +
         line("NrOfRXPDO", std::to_string(kPdoCount)) + line("NrOfTXPDO", std::to_string(kPdoCount)) +
         line("LSS_Supported", "0");
}

std::string comments() {
  return section("Comments") + line("Lines", "3") +
         line("Line1", "Made by liana-bench --eds from the dictionary that the bench's drives have.") +
         line("Line2", "By the robot table differ: 1018 (product), 608F, 6076, 6085, 6091.") +
         line("Line3", "Drives of another type (lua/drives) have other objects.");
}

std::string dummies() {
  std::string out = section("DummyUsage");
  for (int type = 1; type <= 7; ++type) out += line("Dummy000" + std::to_string(type), "0");
  return out;
}

}  // namespace

std::string data_sheet(const DriveSettings& settings) {
  DriveSettings of_any_node = settings;
  of_any_node.node = 0;  // COB-IDs are what is added to the node id
  const ObjectDictionary objects = make_objects(of_any_node);
  const Indices indices = by_index(objects);
  return file_info() + device_info(settings) + dummies() + comments() +
         list("MandatoryObjects", indices, is_mandatory) +
         list("OptionalObjects", indices,
              [](std::uint16_t index) { return !is_mandatory(index) && !is_manufacturers(index); }) +
         list("ManufacturerObjects", indices, is_manufacturers);
}

}  // namespace liana::bench
