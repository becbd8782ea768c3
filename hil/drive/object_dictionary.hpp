// The object dictionary of a simulated drive: typed, ranged entries and the SDO abort codes for what is refused.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace liana::bench {

enum class ObjectType : std::uint8_t { kU8, kI8, kU16, kI16, kU32, kI32, kText };
enum class Access : std::uint8_t { kReadOnly, kReadWrite, kWriteOnly };

// SDO abort codes (CiA 301).
namespace abort_code {
constexpr std::uint32_t kNone = 0;
constexpr std::uint32_t kToggle = 0x05030000;
constexpr std::uint32_t kCommand = 0x05040001;
constexpr std::uint32_t kMemory = 0x05040005;
constexpr std::uint32_t kUnsupportedAccess = 0x06010000;
constexpr std::uint32_t kWriteOnly = 0x06010001;
constexpr std::uint32_t kReadOnly = 0x06010002;
constexpr std::uint32_t kNoObject = 0x06020000;
constexpr std::uint32_t kNotMappable = 0x06040041;
constexpr std::uint32_t kPdoLength = 0x06040042;
constexpr std::uint32_t kTooLong = 0x06070012;
constexpr std::uint32_t kTooShort = 0x06070013;
constexpr std::uint32_t kNoSub = 0x06090011;
constexpr std::uint32_t kValue = 0x06090030;
constexpr std::uint32_t kTooHigh = 0x06090031;
constexpr std::uint32_t kTooLow = 0x06090032;
constexpr std::uint32_t kDeviceState = 0x08000022;
}  // namespace abort_code

struct Object {
  std::uint16_t index = 0;
  std::uint8_t sub = 0;
  ObjectType type = ObjectType::kU32;
  Access access = Access::kReadOnly;
  bool mappable = false;
  std::int64_t value = 0;
  std::int64_t low = 0;
  std::int64_t high = 0;
  const char* text = "";   // for kText
  bool is_hidden = false;  // the drive's own affair: nobody else finds it
};

// Bytes on the wire; 0 for text.
std::size_t size_of(ObjectType type);
// Little-endian bytes to the signed or unsigned value of the type.
std::int64_t decode(ObjectType type, const std::uint8_t* bytes);

// The axis whose object this is: of CiA 402 (6000 to 67FF are axis 1's, 6800 to 6FFF axis 2's), or a PDO (numbers 1 to
// 64, 65 to 128); 0: the node's.
int axis_of_object(std::uint16_t index);

// Of one axis of a node, whose objects it names as axis 1 does; others name them as the node does.
class ObjectDictionary {
 public:
  explicit ObjectDictionary(std::vector<Object> objects, int axis = 1);

  // nullptr when there is no such entry. Pointers stay valid.
  Object* find(std::uint16_t index, std::uint8_t sub);
  const Object* find(std::uint16_t index, std::uint8_t sub) const;
  // Value of an entry that exists (the drive's own use).
  std::int64_t get(std::uint16_t index, std::uint8_t sub = 0) const { return find(index, sub)->value; }
  void set(std::uint16_t index, std::uint8_t sub, std::int64_t value) { find(index, sub)->value = value; }

  // The same for others than the drive: not what is hidden, and by the node's name of it.
  const Object* find_public(std::uint16_t index, std::uint8_t sub) const;
  Object* find_public(std::uint16_t index, std::uint8_t sub);
  // All entries, by index, then sub-index.
  const std::vector<Object>& all() const { return objects_; }

  // What an SDO read or write of `size` bytes would be refused with, kNone if allowed.
  std::uint32_t check_read(std::uint16_t index, std::uint8_t sub) const;
  std::uint32_t check_write(std::uint16_t index, std::uint8_t sub, const std::uint8_t* bytes, std::size_t size) const;

 private:
  std::uint16_t own_index(std::uint16_t index) const;
  std::uint32_t missing(std::uint16_t index) const;
  int axis_;
  std::vector<Object> objects_;      // by index, then sub
  std::vector<std::uint32_t> keys_;  // of the objects, both in one
};

}  // namespace liana::bench
