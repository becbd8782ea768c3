#include "host/canopen/boot_mismatch.hpp"

#include <cstdio>

#include "host/canopen/sdo_client.hpp"

namespace liana::canopen {
namespace {

std::string hex(const char* format, std::uint32_t value) {
  char text[24];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string number(std::uint32_t value) { return std::to_string(value) + hex(" (0x%X)", value); }

std::string object_text(const BootMismatch& m) {
  return "object " + hex("0x%04X", m.index) + ":" + std::to_string(m.sub) + " (" + m.object_name + "): ";
}

std::string advice(const BootMismatch& m) {
  if (m.index == 0x1000 || m.index == 0x1018)
    return "another drive is connected under this node id, or the robot table is wrong";
  if (m.written) return "the drive does not keep what it is told; it may be the wrong type or have other firmware";
  return "the drive is set up for another motor or drum, or the robot table is wrong";
}

}  // namespace

std::string describe(const BootMismatch& m, const std::string& bus_name) {
  const std::string who = "node " + std::to_string(m.node) + " on " + bus_name + ": ";
  switch (m.failure) {
    case BootFailure::kNone:
      return who + "ok";
    case BootFailure::kNoBootUp:
      return who +
             "no boot-up message after reset communication: the drive is missing, without power, or has another node "
             "id or bit rate";
    case BootFailure::kNoAnswer:
      return who + object_text(m) + "no answer: the drive fell silent; check its power and the cable";
    case BootFailure::kAborted:
      return who + object_text(m) + (m.written ? "writing " + number(m.expected) : "reading") +
             " refused with abort code " + hex("0x%08X", m.abort_code) + ", " + abort_text(m.abort_code) +
             ": is it the drive of the robot table?";
    case BootFailure::kValue:
      return who + object_text(m) + "expected " + number(m.expected) + ", found " + number(m.found) + ": " + advice(m);
    case BootFailure::kRestarts:
      return who + "it keeps restarting while it is configured: check its supply";
    case BootFailure::kNotOperational:
      return who + "does not become operational after NMT start; last state heard " + hex("0x%02X", m.found) +
             ": its error register (0x1001) says more";
  }
  return who;
}

}  // namespace liana::canopen
