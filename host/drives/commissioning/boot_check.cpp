#include "host/drives/commissioning/boot_check.hpp"

#include <array>
#include <cstdio>
#include <optional>
#include <span>

#include "firmware_like/drive/pdo.hpp"
#include "host/drives/canopen/cob_id.hpp"
#include "host/drives/canopen/messages.hpp"
#include "host/model/config/drive_type.hpp"

namespace liana::commissioning {
namespace {

using canopen::BootNode;
using canopen::BootObject;
using canopen::BootOutcome;

constexpr std::uint32_t kWriteOnly = 0x06010001;
constexpr std::uint16_t kFirstOfMaker = 0x2000;  // below it a reset of communication brings the value of power-on back
constexpr double kReport_s = 0.2;

std::string text_of(const BootObject& object) {
  return config::object_name({object.index, object.sub}) + " (" + object.name + ")";
}

std::string bits_text(std::size_t bytes) { return std::to_string(8 * bytes) + " bits"; }

std::string abort_code_text(std::uint32_t code) {
  char text[24];
  std::snprintf(text, sizeof text, "0x%08X, ", code);
  return text + std::string(canopen::abort_text(code));
}

// Why one object cannot be mapped with so many bits; empty: nothing that reading shows.
std::string mapping_refusal(const Answer& answer, std::size_t bytes) {
  if (answer.status == canopen::SdoStatus::kTimeout) return "does not answer";
  if (answer.status == canopen::SdoStatus::kAborted)
    return answer.abort_code == kWriteOnly ? "" : "is refused with abort code " + abort_code_text(answer.abort_code);
  if (!answer.has_size || answer.bytes.size() == bytes) return "";
  return "has " + bits_text(answer.bytes.size());
}

// What the process data map has to be there, in the size that they map.
void check_mapped(Desk& desk, const canopen::ExpectedDrive& drive, const BootNode& node,
                  std::vector<std::string>& more) {
  for (const BootObject& entry : node.plan().objects()) {
    if (!canopen::is_mapping_entry(entry.index, entry.sub)) continue;
    const config::ObjectId mapped = canopen::mapped_object(entry.value);
    const std::size_t bytes = (entry.value & 0xFF) / 8;
    const std::string why = mapping_refusal(desk.read({drive.bus, drive.node}, mapped.index, mapped.sub), bytes);
    if (why.empty()) continue;
    more.push_back("object " + config::object_name(mapped) + " " + why + ", and " + text_of(entry) +
                   " would map it with " + bits_text(bytes) +
                   ": the boot would be refused there; if the drive has no such object, name another tension source in "
                   "its type (docs/reference/drives.md)");
  }
}

// What is written has to have the size that is written.
void check_sizes(const BootNode& node, std::vector<std::string>& more) {
  const std::span<const BootObject> objects = node.plan().objects();
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const std::size_t found = node.outcomes()[i].said_bytes;
    if (!objects[i].write || found == 0 || found == objects[i].bytes) continue;
    more.push_back("object " + text_of(objects[i]) + " has " + bits_text(found) + ", and a boot writes " +
                   bits_text(objects[i].bytes) + ": the write would be refused");
  }
}

const BootOutcome* outcome_of(const BootNode& node, std::uint16_t index) {
  for (std::size_t i = 0; i < node.plan().objects().size(); ++i)
    if (node.plan().objects()[i].index == index) return &node.outcomes()[i];
  return nullptr;
}

// Where 6060 has its value already, 6061 has to show it.
void check_mode(const canopen::ExpectedDrive& drive, const BootNode& node, std::vector<std::string>& more) {
  const BootOutcome* told = outcome_of(node, canopen::on_axis(canopen::kModeOfOperation, drive.axis));
  const BootOutcome* shown = outcome_of(node, canopen::on_axis(canopen::kModeDisplay, drive.axis));
  const std::uint32_t mode = drive.type.is_cst ? 10 : 8;
  if (told == nullptr || shown == nullptr || !told->found || !shown->found) return;
  if (*told->found != mode || *shown->found == mode) return;
  more.push_back("object 6061 (mode of operation display) shows mode " + std::to_string(*shown->found) +
                 ", and 6060 has mode " + std::to_string(mode) + ": the drive takes the mode and stays in another");
}

bool is_watched(const canopen::ExpectedDrive& drive, const BootNode& node) {
  return node.has({canopen::on_axis(canopen::kModeDisplay, drive.axis), 0});
}

// The report that the first SYNCs bring; nothing: none came.
std::optional<std::uint8_t> report_length(Desk& desk, const canopen::ExpectedDrive& drive) {
  std::optional<std::uint8_t> length;
  const auto take = [&](const bus::ReceivedFrame& received) {
    if (received.bus == drive.bus && received.frame.id == drive.report_id()) length = received.frame.length;
  };
  for (std::uint64_t left = desk.ticks(kReport_s); left > 0 && !length; --left) {
    desk.refuse_when_interrupted();
    desk.exchange(Desk::Tick::kCyclic, take, [] {});
  }
  return length;
}

void check_report(Desk& desk, const canopen::ExpectedDrive& drive, const BootNode& node,
                  std::vector<std::string>& more) {
  std::size_t bits = 0;
  for (const BootObject& entry : node.plan().objects())
    if (entry.index == canopen::on_axis(0x1A00, drive.axis) && entry.sub != 0) bits += entry.value & 0xFF;
  const std::optional<std::uint8_t> length = report_length(desk, drive);
  if (length && std::size_t{*length} * 8 == bits) return;
  more.push_back(length ? "its report (TPDO1) has " + std::to_string(*length) + " bytes, and " +
                              std::to_string(bits / 8) + " are mapped"
                        : "it sends no report (TPDO1) after SYNC");
}

// Back to what the look found: last written, first restored.
void restore(Desk& desk, const canopen::ExpectedDrive& drive, const BootNode& looked,
             std::vector<std::string>& not_restored) {
  const std::span<const BootObject> objects = looked.plan().objects();
  const Place at{drive.bus, drive.node};
  for (std::size_t i = objects.size(); i-- > 0;) {
    const BootObject& object = objects[i];
    const std::optional<std::uint32_t>& before = looked.outcomes()[i].found;
    const bool is_mode = object.index == canopen::on_axis(canopen::kModeOfOperation, drive.axis);
    const bool is_no_mode = is_mode && before == 0U;  // nobody can ask for it
    if (!object.write || object.index < kFirstOfMaker || !before || is_no_mode) continue;
    if (const Answer now = desk.read(at, object.index, object.sub); now.is_done() && now.value() == *before) continue;
    std::array<std::uint8_t, 4> bytes{};
    canopen::put_u32(bytes.data(), 4, *before);
    if (!desk.write(at, object.index, object.sub, {bytes.data(), object.bytes}).is_done())
      not_restored.push_back(text_of(object) + ", which was " + std::to_string(*before));
  }
}

}  // namespace

BootCheck check_by_reading(Desk& desk, const canopen::ExpectedDrive& drive) {
  BootCheck check;
  check.node = desk.look_at_boot(drive);
  check.is_watched = is_watched(drive, *check.node);
  check_mapped(desk, drive, *check.node, check.more);
  check_sizes(*check.node, check.more);
  check_mode(drive, *check.node, check.more);
  return check;
}

BootCheck check_by_trial(Desk& desk, const canopen::ExpectedDrive& drive) {
  const std::unique_ptr<BootNode> before = desk.look_at_boot(drive);
  BootCheck check;
  check.node = desk.boot(drive);
  check.is_watched = is_watched(drive, *check.node);
  if (check.would_boot()) check_report(desk, drive, *check.node, check.more);
  const std::unique_ptr<BootNode> after = desk.look_at_boot(drive);  // which resets communication
  restore(desk, drive, *before, check.not_restored);
  return check;
}

}  // namespace liana::commissioning
