#include "host/drives/canopen/boot_mismatch.hpp"

#include <cstdio>

#include "host/drives/canopen/cob_id.hpp"
#include "host/drives/canopen/sdo_client.hpp"

namespace liana::canopen {
namespace {

std::string hex(const char* format, std::uint32_t value) {
  char text[24];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string number(std::uint32_t value) { return std::to_string(value) + hex(" (0x%X)", value); }

// What an entry of a mapping names, e.g. ", which maps 6077 with 16 bits".
std::string mapped_text(const BootMismatch& m) {
  if (!is_mapping_entry(m.index, m.sub)) return "";
  const config::ObjectId mapped = mapped_object(m.expected);
  return ", which maps " + config::object_name(mapped) + " with " + std::to_string(m.expected & 0xFF) + " bits";
}

std::string object_text(const BootMismatch& m) {
  return "object " + hex("0x%04X", m.index) + ":" + std::to_string(m.sub) + " (" + m.object_name + mapped_text(m) +
         "): ";
}

// What is said otherwise where there is no robot table.
struct Words {
  const char* needs;
  const char* other_drive;
  const char* too_fast;
  const char* other_set_up;
  const char* which_drive;
};

constexpr Words kRobotWords{
    "the arm needs", "another drive is connected under this node id, or the robot table is wrong",
    "set it with the maker's tool, or slow the arm down in the robot table",
    "the drive is set up for another motor or drum, or the robot table or its drive type is wrong",
    "is it the drive of the robot table?"};
constexpr Words kDeskWords{"this way needs", "this drive is not of the type that --type names: name its own",
                           "set it with the maker's tool, or ask for less (--speed, --by)",
                           "set it with the maker's tool, or correct the drive type (docs/reference/drives.md)",
                           "is it of the type that --type names?"};

std::string advice(const BootMismatch& m, const Words& words) {
  if (m.index == 0x1000 || m.index == 0x1018) return words.other_drive;
  if (m.index == kModeDisplay)
    return "the drive takes the mode and stays in another; set it up for this mode with the maker's tool";
  if (m.written) return "the drive does not keep what it is told; it may be the wrong type or have other firmware";
  return m.rule == BootRule::kAtLeast || m.rule == BootRule::kRange ? words.too_fast : words.other_set_up;
}

std::string range(std::uint32_t low, std::uint32_t high) {
  return std::to_string(static_cast<std::int32_t>(low)) + " to " + std::to_string(static_cast<std::int32_t>(high));
}

std::string difference(const BootMismatch& m, const Words& words) {
  switch (m.rule) {
    case BootRule::kAtLeast:
      return words.needs + std::string(" at least ") + number(m.expected) + ", found " + number(m.found);
    case BootRule::kRange:
      return words.needs + (" " + range(m.expected_before, m.expected)) + ", found " + range(m.found_before, m.found);
    case BootRule::kPair:
      return "expected " + number(m.expected_before) + " to " + number(m.expected) + ", found " +
             number(m.found_before) + " to " + number(m.found);
    case BootRule::kAnyTarget:
    case BootRule::kEqual:
      break;
  }
  const std::string in_bits = m.mask == 0xFFFFFFFF ? "" : " in the bits" + hex(" 0x%X", m.mask);
  return "expected " + number(m.expected) + in_bits + ", found " + number(m.found);
}

// What came in the place of a message, and is none for its length.
std::string odd(const BootMismatch& m, const char* what, int right_bytes) {
  if (!m.odd_length) return "";
  return std::string("; ") + what + " came with " + std::to_string(*m.odd_length) + " bytes in place of " +
         std::to_string(right_bytes) + ", which is none (CiA 301)";
}

// What was refused, and what is there instead.
std::string refusal(const BootMismatch& m) {
  const std::string code = " refused with abort code " + hex("0x%08X", m.abort_code) + ", " + abort_text(m.abort_code);
  if (!m.written) return "reading" + code;
  return "writing " + number(m.expected) + code + (m.has_found ? ", and found " + number(m.found) : "");
}

std::string text_of(const BootMismatch& m, const Words& words) {
  switch (m.failure) {
    case BootFailure::kNone:
      return "ok";
    case BootFailure::kNoBootUp:
      return std::string(
                 "no boot-up message after reset communication: the drive is missing, without power, or has another "
                 "node "
                 "id or bit rate") +
             odd(m, "a boot-up message", 1);
    case BootFailure::kNoAnswer:
      return object_text(m) + (m.odd_length ? "no answer" + odd(m, "an SDO answer", 8) +
                                                  ": update the drive's firmware, or ask its maker"
                                            : "no answer: the drive fell silent; check its power and the cable");
    case BootFailure::kAborted:
      return object_text(m) + refusal(m) + ": " + words.which_drive +
             " If it is, say in its drive type what it has (docs/reference/drives.md)";
    case BootFailure::kValue:
      return object_text(m) + difference(m, words) + ": " + advice(m, words);
    case BootFailure::kRestarts:
      return "it keeps restarting while it is configured: check its supply";
    case BootFailure::kNotOperational:
      return "does not become operational after NMT start; " +
             (m.has_found ? "state of its last heartbeat" + hex(" 0x%02X", m.found) : "no heartbeat came") +
             odd(m, "a heartbeat", 1) + ": its error register (0x1001) says more";
  }
  return "";
}

}  // namespace

std::string describe(std::span<const BootMismatch> mismatches, std::uint32_t more, const std::string& who,
                     BootReference reference) {
  const Words& words = reference == BootReference::kDesk ? kDeskWords : kRobotWords;
  std::string text;
  for (const BootMismatch& mismatch : mismatches) text += (text.empty() ? who + ": " : "; ") + text_of(mismatch, words);
  return more == 0 ? text : text + "; and " + std::to_string(more) + " more";
}

}  // namespace liana::canopen
