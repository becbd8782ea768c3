#include "host/api/device/capability.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "host/api/device/numbers.hpp"

namespace liana::device {

namespace {

constexpr double kMaxForce = 1000.0;  // [N] or [N m]

[[noreturn]] void refuse(const std::string& field, const std::string& value, const std::string& allowed) {
  throw std::runtime_error("hello: " + field + " = " + value + ": allowed " + allowed);
}

std::string text(double value) {
  char out[32];
  std::snprintf(out, sizeof out, "%g", value);
  return out;
}

void check_range(const std::string& field, double value, double low, double high) {
  if (tensions_valid(value, kMaxForce * 10.0) && value >= low && value <= high) return;
  refuse(field, text(value), text(low) + " to " + text(high));
}

bool is_of_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
}

bool is_name(const std::string& name) {
  return !name.empty() && name.size() < LIANA_NAME_BYTES && std::all_of(name.begin(), name.end(), is_of_name);
}

// Whoever sent it, it is read in a terminal.
std::string shown(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !is_of_name(c); }, '?');
  return "'" + name + "'";
}

// The words of use_device name no single device.
bool is_word(const std::string& name) {
  constexpr std::array kKinds{Kind::kNone, Kind::kHandController, Kind::kVrControllers, Kind::kPointer};
  return std::any_of(kKinds.begin(), kKinds.end(), [&](Kind kind) { return name == kind_name(kind); });
}

void check(const std::string& field, const liana_hand& hand) {
  const auto check_axes = [&](const char* name, std::uint32_t axes, std::uint32_t all) {
    if ((axes & ~all) != 0) refuse(field + name, std::to_string(axes), "a set of axes within " + std::to_string(all));
  };
  check_axes(".sensed", hand.sensed, LIANA_ALL_AXES | LIANA_TWIST);
  check_axes(".actuated", hand.actuated, LIANA_ALL_AXES);
  if (hand.buttons > 32) refuse(field + ".buttons", std::to_string(hand.buttons), "0 to 32");
  if (hand.reserved != 0) refuse(field + ".reserved", std::to_string(hand.reserved), "0");
  for (std::size_t i = 0; i < 3; ++i) {
    check_range(field + ".low_m", hand.low_m[i], -kRoom_m, kRoom_m);
    check_range(field + ".high_m", hand.high_m[i], hand.low_m[i], kRoom_m);
  }
  check_range(field + ".max_force_N", hand.max_force_N, 0.0, kMaxForce);
  check_range(field + ".max_torque_Nm", hand.max_torque_Nm, 0.0, kMaxForce);
}

}  // namespace

const char* kind_name(Kind kind) {
  static constexpr std::array<const char*, 4> kNames{"none", "hand", "vr", "pointer"};
  return kNames[static_cast<std::size_t>(kind)];
}

void check(const Capability& capability) {
  if (!is_name(capability.name)) refuse("name", shown(capability.name), "1 to 31 letters, digits, _ - or .");
  if (is_word(capability.name)) refuse("name", capability.name, "any other: use_device means a kind of device by it");
  if (capability.kind == Kind::kNone || capability.kind > Kind::kPointer)
    refuse("kind", std::to_string(static_cast<int>(capability.kind)), "1 hand controller, 2 handles, 3 pointer");
  if (capability.hands < 1 || capability.hands > LIANA_MAX_HANDS)
    refuse("hands", std::to_string(capability.hands), "1 or 2");
  check_range("rate_hz", capability.rate_hz, 1.0, 4000.0);
  check_range("watchdog_s", capability.watchdog_s, 0.0, 1.0);
  for (std::size_t i = 0; i < capability.hands; ++i) check("hand[" + std::to_string(i) + "]", capability.hand[i]);
}

}  // namespace liana::device
