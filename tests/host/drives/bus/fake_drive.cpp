#include "tests/host/drives/bus/fake_drive.hpp"

namespace liana::test {
namespace {

std::uint32_t little_endian(const bus::CanFrame& frame, std::size_t from, int bytes) {
  std::uint32_t value = 0;
  for (int i = bytes - 1; i >= 0; --i) value = value << 8 | frame.data[from + static_cast<std::size_t>(i)];
  return value;
}

void put(bus::CanFrame& frame, std::size_t from, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) frame.data[from + i] = static_cast<std::uint8_t>(value >> (8 * i));
}

}  // namespace

canopen::ExpectedDrive expectation(int bus, std::uint8_t node) {
  canopen::ExpectedDrive drive;
  drive.bus = bus;
  drive.node = node;
  drive.vendor = 0x4C49;
  drive.product = 1;
  drive.revision = 1;
  drive.serial = 1000U + node;
  drive.counts_per_turn = 65536;
  drive.rated_torque_mNm = 9000;
  drive.period = {4, -3};
  drive.rpdo_deadline_ms = 12;
  drive.following_window_counts = 3476;
  return drive;
}

FakeDrive::FakeDrive(const canopen::ExpectedDrive& is) : node(is.node) {
  const auto add = [this](std::uint32_t index, std::uint32_t sub, int bytes, std::uint32_t value) {
    objects[key(index, sub)] = {bytes, value};
  };
  add(0x1000, 0, 4, 0x00020192);
  add(0x1016, 1, 4, 0);
  add(0x1017, 0, 2, 0);
  add(0x1018, 1, 4, is.vendor);
  add(0x1018, 2, 4, is.product);
  add(0x1018, 3, 4, is.revision);
  add(0x1018, 4, 4, is.serial.value_or(0));
  for (std::uint32_t pdo = 0; pdo < 4; ++pdo) {
    add(0x1400 + pdo, 1, 4, 0x40000200 + 0x100 * pdo + node);
    add(0x1800 + pdo, 1, 4, 0x40000180 + 0x100 * pdo + node);
    add(0x1400 + pdo, 2, 1, 255);
    add(0x1800 + pdo, 2, 1, 255);
    add(0x1400 + pdo, 5, 2, 0);
    for (std::uint32_t sub = 0; sub <= 8; ++sub) {
      add(0x1600 + pdo, sub, sub == 0 ? 1 : 4, 0);
      add(0x1A00 + pdo, sub, sub == 0 ? 1 : 4, 0);
    }
  }
  add(0x6007, 0, 2, 0);
  add(0x605A, 0, 2, 0);
  add(0x605E, 0, 2, 0);
  add(0x6060, 0, 1, 0);
  add(0x6065, 0, 4, 0);
  add(0x6066, 0, 2, 0);
  add(0x6072, 0, 2, 0);
  add(0x6076, 0, 4, static_cast<std::uint32_t>(is.rated_torque_mNm));
  add(0x608F, 1, 4, is.counts_per_turn);
  add(0x608F, 2, 4, 1);
  add(0x6091, 1, 4, is.gear_motor_turns);
  add(0x6091, 2, 4, is.gear_drum_turns);
  add(0x60C2, 1, 1, 0);
  add(0x60C2, 2, 1, 0);
  add(0x6502, 0, 4, 0x3A1);
}

void FakeDrive::add_axis() {
  const std::map<std::uint32_t, Object> first = objects;
  for (const auto& [object, value] : first) {
    if (object >= key(0x6000, 0)) objects[object + key(0x800, 0)] = value;
    if (object >= key(0x1400, 0) && object < key(0x1C00, 0)) objects[object + key(0x40, 0)] = value;
  }
}

bus::CanFrame FakeDrive::boot_up() const { return {0x700U + node, 1, {0}, 0}; }

std::vector<bus::CanFrame> FakeDrive::receive(const bus::CanFrame& frame) {
  if (dead) return {};
  if (frame.id == 0 && (frame.data[1] == node || frame.data[1] == 0)) {
    if (frame.data[0] == 0x82) {
      state = 0x7F;
      return {boot_up()};
    }
    if (frame.data[0] == 0x01 && !never_operational) state = 0x05;
    return {};
  }
  if (frame.id == 0x600U + node && frame.data[0] != 0x80) return answer_sdo(frame);
  if (frame.id == 0x080 && state == 0x05) return {{0x180U + node, 8, {0x40, 0x02}, 0}};
  return {};
}

std::vector<bus::CanFrame> FakeDrive::heartbeat() const {
  if (dead || objects.at(key(0x1017, 0)).value == 0) return {};
  return {{0x700U + node, heartbeat_bytes, {state}, 0}};
}

std::vector<bus::CanFrame> FakeDrive::answer_sdo(const bus::CanFrame& request) {
  const std::uint32_t object_key = key(little_endian(request, 1, 2), request.data[3]);
  if (object_key == deaf_from) return {};
  if (object_key == key(0x6061, 0) && mode_reads > 0 && --mode_reads == 0)
    objects[object_key].value = objects.at(key(0x6060, 0)).value;
  bus::CanFrame answer{0x580U + node, answer_bytes, {0, request.data[1], request.data[2], request.data[3]}, 0};
  const auto abort = aborts.find(object_key);
  const auto found = objects.find(object_key);
  const bool write = (request.data[0] & 0xE0) == 0x20;
  if (abort != aborts.end() || found == objects.end()) {
    answer.data[0] = 0x80;
    put(answer, 4, abort != aborts.end() ? abort->second : 0x06020000);
  } else if (write && read_only.contains(object_key)) {
    answer.data[0] = 0x80;
    put(answer, 4, 0x06010002);
  } else if (write) {
    if (restarts > 0 && object_key == key(0x6060, 0)) {
      --restarts;
      return {boot_up()};
    }
    writes.push_back(object_key);
    const int bytes = 4 - ((request.data[0] >> 2) & 3);
    answer.data[0] = bytes == found->second.bytes ? 0x60 : 0x80;
    if (bytes != found->second.bytes) put(answer, 4, 0x06070010);
    if (!stubborn.contains(object_key)) found->second.value = little_endian(request, 4, bytes);
  } else {
    answer.data[0] = static_cast<std::uint8_t>(0x43 | ((4 - found->second.bytes) << 2));
    put(answer, 4, found->second.value);
  }
  if (lost_answers > 0 && lost_answers-- > 0) return {};
  return {answer};
}

}  // namespace liana::test
