#include "host/canopen/boot_plan.hpp"

#include <stdexcept>

#include "host/canopen/cob_id.hpp"

namespace liana::canopen {
namespace {

constexpr std::uint32_t kDisabled = 0x80000000;           // COB-ID bit 31
constexpr std::uint32_t kCobIdMask = 0xBFFFFFFF;          // bit 30 (no remote request) is the drive's own business
constexpr std::uint32_t kDeviceProfileMask = 0x0000FFFF;  // of 1000: the profile number
constexpr std::uint32_t kProfile402 = 402;
constexpr std::uint32_t kModeCsp = 8;
constexpr std::uint32_t kSupportsCsp = 0x80;  // 6502: bit mode - 1
constexpr std::uint32_t kEverySync = 1;
constexpr std::uint32_t kPdoSpacing = 0x100;

std::uint32_t mask_of(std::uint8_t bytes) { return bytes == 4 ? 0xFFFFFFFF : (1U << (8U * bytes)) - 1U; }

bool is_cob_id(std::uint16_t index, std::uint8_t sub) {
  return sub == 1 && ((index & 0xFF00) == 0x1400 || (index & 0xFF00) == 0x1800);
}

}  // namespace

BootPlan::BootPlan(const DriveExpectation& drive) {
  check_identity(drive);
  check_mechanics(drive);
  map_rpdo1(drive);
  map_tpdo1(drive);
  disable_other_pdos(drive);
  set_motion(drive);
  set_heartbeats(drive);
}

void BootPlan::add(const BootObject& object) {
  if (count_ == objects_.size()) throw std::logic_error("boot plan: more objects than its capacity");
  objects_[count_++] = object;
}

void BootPlan::expect(std::uint16_t index, std::uint8_t sub, std::uint32_t value, const char* name,
                      std::uint32_t mask) {
  add({index, sub, 4, false, false, value, mask, name});
}

void BootPlan::write(std::uint16_t index, std::uint8_t sub, std::uint8_t bytes, std::uint32_t value, const char* name) {
  const std::uint32_t mask = is_cob_id(index, sub) ? kCobIdMask : mask_of(bytes);
  add({index, sub, bytes, true, false, value & mask_of(bytes), mask, name});
}

void BootPlan::check_identity(const DriveExpectation& drive) {
  expect(0x1000, 0, kProfile402, "device profile", kDeviceProfileMask);
  expect(0x1018, 1, drive.vendor, "vendor id");
  expect(0x1018, 2, drive.product, "product code");
  expect(0x1018, 3, drive.revision, "revision number");
  expect(0x1018, 4, drive.serial.value_or(0), "serial number", drive.serial ? 0xFFFFFFFF : 0);
  serial_at_ = count_ - 1;
  objects_[serial_at_].may_be_missing = !drive.serial;
}

void BootPlan::keep(std::size_t at, std::uint32_t found) noexcept {
  if (at != serial_at_ || objects_[at].mask != 0) return;
  objects_[at].value = found;
  objects_[at].mask = 0xFFFFFFFF;
  objects_[at].may_be_missing = false;
}

void BootPlan::check_mechanics(const DriveExpectation& drive) {
  expect(0x6502, 0, kSupportsCsp, "supported drive modes, csp", kSupportsCsp);
  expect(0x608F, 1, drive.counts_per_turn, "encoder counts");
  expect(0x608F, 2, 1, "encoder motor revolutions");
  expect(0x6091, 1, drive.gear_motor_turns, "gear, motor revolutions");
  expect(0x6091, 2, drive.gear_drum_turns, "gear, shaft revolutions");
  // A drive that knows no gear has none.
  const bool no_gear = drive.gear_motor_turns == drive.gear_drum_turns;
  objects_[count_ - 1].may_be_missing = no_gear;
  objects_[count_ - 2].may_be_missing = no_gear;
  expect(0x6076, 0, drive.rated_torque_mNm, "rated torque");
}

// The order is CiA 301's: a mapping can only be changed while its PDO is disabled and it has no entries.
void BootPlan::map_rpdo1(const DriveExpectation& drive) {
  const std::uint32_t cob_id = kRpdo1Base + drive.node;
  write(0x1400, 1, 4, kDisabled | cob_id, "RPDO1 COB-ID");
  write(0x1600, 0, 1, 0, "RPDO1 mapping count");
  write(0x1600, 1, 4, 0x60400010, "RPDO1 mapping 1");
  write(0x1600, 2, 4, 0x607A0020, "RPDO1 mapping 2");
  write(0x1600, 0, 1, 2, "RPDO1 mapping count");
  write(0x1400, 2, 1, kEverySync, "RPDO1 transmission type");
  write(0x1400, 5, 2, drive.rpdo_deadline_ms, "RPDO1 deadline");
  write(0x1400, 1, 4, cob_id, "RPDO1 COB-ID");
}

void BootPlan::map_tpdo1(const DriveExpectation& drive) {
  const std::uint32_t cob_id = kTpdo1Base + drive.node;
  write(0x1800, 1, 4, kDisabled | cob_id, "TPDO1 COB-ID");
  write(0x1A00, 0, 1, 0, "TPDO1 mapping count");
  write(0x1A00, 1, 4, 0x60410010, "TPDO1 mapping 1");
  write(0x1A00, 2, 4, 0x60640020, "TPDO1 mapping 2");
  write(0x1A00, 3, 4, 0x60770010, "TPDO1 mapping 3");
  write(0x1A00, 0, 1, 3, "TPDO1 mapping count");
  write(0x1800, 2, 1, kEverySync, "TPDO1 transmission type");
  write(0x1800, 1, 4, cob_id, "TPDO1 COB-ID");
}

void BootPlan::disable_other_pdos(const DriveExpectation& drive) {
  for (std::uint16_t number = 1; number <= 3; ++number) {
    const std::uint32_t offset = number * kPdoSpacing + drive.node;
    write(static_cast<std::uint16_t>(0x1400 + number), 1, 4, kDisabled | (kRpdo1Base + offset),
          "COB-ID of an RPDO that is not used");
    objects_[count_ - 1].may_be_missing = true;
    write(static_cast<std::uint16_t>(0x1800 + number), 1, 4, kDisabled | (kTpdo1Base + offset),
          "COB-ID of a TPDO that is not used");
    objects_[count_ - 1].may_be_missing = true;
  }
}

void BootPlan::set_motion(const DriveExpectation& drive) {
  write(0x6060, 0, 1, kModeCsp, "mode of operation");
  write(0x60C2, 1, 1, drive.period.value, "interpolation period value");
  write(0x60C2, 2, 1, static_cast<std::uint32_t>(drive.period.exponent), "interpolation period exponent");
  write(0x6072, 0, 2, drive.max_torque_permille, "max torque");
  write(0x6065, 0, 4, drive.following_window_counts, "following error window");
  write(0x6066, 0, 2, drive.following_time_ms, "following error time");
  write(0x605A, 0, 2, 2, "quick stop option");
  write(0x605E, 0, 2, 2, "fault reaction option");
  write(0x6007, 0, 2, 3, "abort connection option");
}

void BootPlan::set_heartbeats(const DriveExpectation& drive) {
  write(0x1017, 0, 2, drive.heartbeat_ms, "producer heartbeat time");
  write(0x1016, 1, 4, (std::uint32_t{kMasterNode} << 16) | drive.master_timeout_ms, "consumer heartbeat time");
}

}  // namespace liana::canopen
