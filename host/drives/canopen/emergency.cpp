#include "host/drives/canopen/emergency.hpp"

#include <algorithm>

#include "host/drives/canopen/messages.hpp"

namespace liana::canopen {
namespace {

struct CodeName {
  std::uint16_t code;
  std::uint16_t mask;
  const char* text;
};

// First match wins: exact codes before classes.
constexpr std::array kCodeNames = {
    CodeName{0x0000, 0xFFFF, "no error"},
    CodeName{0x8110, 0xFFFF, "CAN overrun"},
    CodeName{0x8120, 0xFFFF, "CAN error passive"},
    CodeName{0x8130, 0xFFFF, "heartbeat of the master lost"},
    CodeName{0x8140, 0xFFFF, "recovered from bus-off"},
    CodeName{0x8210, 0xFFFF, "PDO too short"},
    CodeName{0x8250, 0xFFFF, "RPDO deadline missed"},
    CodeName{0x8611, 0xFFFF, "following error"},
    CodeName{0x1000, 0xF000, "generic error"},
    CodeName{0x2000, 0xF000, "current"},
    CodeName{0x3000, 0xF000, "voltage"},
    CodeName{0x4000, 0xF000, "temperature"},
    CodeName{0x5000, 0xF000, "device hardware"},
    CodeName{0x6000, 0xF000, "device software"},
    CodeName{0x7000, 0xF000, "additional modules"},
    CodeName{0x8000, 0xF000, "monitoring"},
    CodeName{0x9000, 0xF000, "external error"},
    CodeName{0xF000, 0xF000, "device specific"},
};

}  // namespace

const char* emergency_text(std::uint16_t code) noexcept {
  const auto* found = std::find_if(kCodeNames.begin(), kCodeNames.end(),
                                   [code](const CodeName& name) { return (code & name.mask) == name.code; });
  return found == kCodeNames.end() ? "unknown" : found->text;
}

void EmergencyLog::on_frame(int bus, std::uint8_t node, const bus::CanFrame& frame, std::uint64_t tick) noexcept {
  if (frame.length != 8) return;
  if (count_ == kCapacity) {
    first_ = (first_ + 1) % kCapacity;
    --count_;
    ++dropped_;
  }
  Emergency& entry = ring_[(first_ + count_++) % kCapacity];
  entry = {bus, node, static_cast<std::uint16_t>(get_u32(frame.data.data(), 2)), frame.data[2], {}, tick};
  std::copy_n(frame.data.begin() + 3, entry.vendor.size(), entry.vendor.begin());
  last_code_[node & 0x7F] = entry.code;
}

bool EmergencyLog::take(Emergency& emergency) noexcept {
  if (count_ == 0) return false;
  emergency = ring_[first_];
  first_ = (first_ + 1) % kCapacity;
  --count_;
  return true;
}

}  // namespace liana::canopen
