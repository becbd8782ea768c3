// The objects one drive is asked and told at boot, in order (docs/drives.md).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "host/canopen/drive_expectation.hpp"

namespace liana::canopen {

// One object: read and compared, or written and read back.
struct BootObject {
  std::uint16_t index = 0;
  std::uint8_t sub = 0;
  std::uint8_t bytes = 0;  // 1, 2 or 4
  bool write = false;
  bool may_be_missing = false;  // a drive without this object is right too
  std::uint32_t value = 0;      // expected, or to be written
  std::uint32_t mask = 0;       // bits that are compared
  const char* name = "";        // as CiA 301/402 call it
};

class BootPlan {
 public:
  explicit BootPlan(const DriveExpectation& drive);
  std::span<const BootObject> objects() const noexcept { return {objects_.data(), count_}; }
  // Object number `at` was read and is right: where any serial number was, it is expected from now on.
  void keep(std::size_t at, std::uint32_t found) noexcept;
  // 0x1018:4 that the drive has to say; 0: any, or it has none.
  std::uint32_t serial() const noexcept { return objects_[serial_at_].value; }

 private:
  void expect(std::uint16_t index, std::uint8_t sub, std::uint32_t value, const char* name,
              std::uint32_t mask = 0xFFFFFFFF);
  void write(std::uint16_t index, std::uint8_t sub, std::uint8_t bytes, std::uint32_t value, const char* name);
  void add(const BootObject& object);
  void check_identity(const DriveExpectation& drive);
  void check_mechanics(const DriveExpectation& drive);
  void map_rpdo1(const DriveExpectation& drive);
  void map_tpdo1(const DriveExpectation& drive);
  void disable_other_pdos(const DriveExpectation& drive);
  void set_motion(const DriveExpectation& drive);
  void set_heartbeats(const DriveExpectation& drive);

  std::array<BootObject, 64> objects_{};
  std::size_t count_ = 0;
  std::size_t serial_at_ = 0;
};

}  // namespace liana::canopen
