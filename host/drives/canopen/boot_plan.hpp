// The objects one node is asked and told at boot, in order (docs/reference/drives.md).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/drives/canopen/expected_drive.hpp"

namespace liana::canopen {

// When what was found is right.
enum class BootRule : std::uint8_t {
  kEqual,      // in the bits of the mask
  kAtLeast,    // as an unsigned number
  kAnyTarget,  // transmission type of an RPDO: at SYNC (0 to 240) or at once (254, 255)
  kPair,       // it and the object before it: the same ratio
  kRange,      // it and the object before it: signed limits that leave room, or two zeros, which are none
};

// One object: read and compared, or written and read back.
struct BootObject {
  std::uint16_t index = 0;
  std::uint8_t sub = 0;
  std::uint8_t axis = 0;   // whose object it is; 0: the node's
  std::uint8_t bytes = 4;  // 1, 2 or 4
  bool write = false;
  bool read_back = true;
  bool may_be_missing = false;        // a drive without this object is right too
  bool ends_list_if_missing = false;  // then the following objects with the same name are not asked for
  std::uint32_t value = 0;            // expected, or to be written
  std::uint32_t mask = 0xFFFFFFFF;    // bits that are compared
  bool settles = false;               // it may take half a second to become right after the write that it shows
  std::uint32_t keep = 0;             // bits that stay as the drive has them: it is read before it is written
  BootRule rule = BootRule::kEqual;
  std::uint32_t before = 0;    // kPair: expected of the object before it; kRange: least position, `value` the most
  std::size_t needs_from = 0;  // it is not written where one of the objects from here ...
  std::size_t needs_to = 0;    // ... to before here was refused
  std::string name;            // as CiA 301/402 call it
};

// All bits of an object of so many bytes (1 to 4).
constexpr std::uint32_t all_bits(std::uint8_t bytes) noexcept {
  return bytes == 4 ? 0xFFFFFFFF : (1U << (8U * bytes)) - 1U;
}

// Whether an object is one entry of a PDO mapping, and what such an entry names.
constexpr bool is_mapping_entry(std::uint16_t index, std::uint8_t sub) noexcept {
  return sub != 0 && ((index & 0xFE00) == 0x1600 || (index & 0xFE00) == 0x1A00);
}
constexpr config::ObjectId mapped_object(std::uint32_t entry) noexcept {
  return {static_cast<std::uint16_t>(entry >> 16), static_cast<std::uint8_t>(entry >> 8)};
}

class BootPlan {
 public:
  // Of all axes of one node, at least one; they are of one type, and what the node has is that of the first.
  explicit BootPlan(std::span<const ExpectedDrive> axes);
  std::span<const BootObject> objects() const noexcept { return objects_; }
  // Whether `found` is right for object number `at`, when `before` was found in the object before it (nothing: then a
  // pair is not judged).
  bool accepts(std::size_t at, std::uint32_t found, std::optional<std::uint32_t> before) const noexcept;
  // Which sub-index is to blame when accepts() says no: of two that are judged together it may be the first.
  std::uint8_t sub_to_blame(std::size_t at, std::uint32_t found) const noexcept;
  // Object number `at` was read and is right: where any serial number was, it is expected from now on.
  void keep(std::size_t at, std::uint32_t found) noexcept;
  // 0x1018:4 that the drive has to say; 0: any, or it has none.
  std::uint32_t serial() const noexcept { return serial_; }
  // Objects that say which drive this is: one that fails here is not written to.
  std::size_t identity_end() const noexcept { return identity_end_; }

 private:
  BootObject* expect(std::uint16_t index, std::uint8_t sub, std::uint32_t value, const char* name,
                     std::uint32_t mask = 0xFFFFFFFF);
  void expect_factor(std::uint16_t index, const config::Factor& factor, const char* first, const char* second);
  void expect_at_least(std::uint16_t index, double value, const char* name);
  BootObject* write(std::uint16_t index, std::uint8_t sub, std::uint8_t bytes, std::uint32_t value, const char* name);
  BootObject* add(BootObject object);
  void check_identity(const ExpectedDrive& drive);
  void configure(const ExpectedDrive& drive, bool is_first);
  void check_mechanics(const ExpectedDrive& drive);
  void map_pdo(std::uint16_t communication, std::uint32_t cob_id, std::span<const std::uint32_t> entries);
  void write_mapping(std::uint16_t mapping, std::size_t disabled_at, std::span<const std::uint32_t> entries);
  void disable_other_pdos();
  void start_up_writes(bool is_first);
  void set_motion(const ExpectedDrive& drive);
  void check_limits(const ExpectedDrive& drive);
  void set_heartbeats(const ExpectedDrive& drive);
  void check_mode();

  std::uint8_t axis_ = 1;  // that the plan is being made for
  config::DriveType type_;
  std::uint16_t rpdo_deadline_ms_ = 0;
  std::vector<BootObject> objects_;
  std::size_t serial_at_ = 0;
  std::size_t identity_end_ = 0;
  std::uint32_t serial_ = 0;
};

}  // namespace liana::canopen
