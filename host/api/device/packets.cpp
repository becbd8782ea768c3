#include "host/api/device/packets.hpp"

#include <algorithm>
#include <bit>

#include "host/api/device/numbers.hpp"

static_assert(std::endian::native == std::endian::little, "packets are copied as they lie in memory");

namespace liana::device {

namespace {

constexpr double kMaxSpeed = 1000.0;  // [m/s] or [rad/s]

template <std::size_t N>
void copy(const std::array<double, N>& from, double (&to)[N]) {
  std::copy(from.begin(), from.end(), to);
}

template <std::size_t N>
std::array<double, N> array_of(const double (&from)[N]) {
  std::array<double, N> out;
  std::copy(from, from + N, out.begin());
  return out;
}

template <std::size_t N>
bool are_sound(const double (&values)[N], double most) {
  return std::all_of(values, values + N, [most](double value) { return tensions_valid(value, most); });
}

bool is_time(std::int64_t t_us) { return t_us >= 0 && t_us <= kMaxTime_us; }

// 0: no such packet.
std::size_t bytes_of_packet(std::uint16_t packet) {
  static constexpr std::array<std::size_t, 7> kBytes{0,
                                                     sizeof(liana_hello),
                                                     sizeof(liana_sample),
                                                     sizeof(liana_bye),
                                                     sizeof(liana_welcome),
                                                     sizeof(liana_refused),
                                                     sizeof(liana_state)};
  return packet < kBytes.size() ? kBytes[packet] : 0;
}

}  // namespace

Incoming look_at(std::string_view bytes) {
  Incoming in;
  if (bytes.size() < sizeof in.header) {
    in.problem = "a packet of " + std::to_string(bytes.size()) + " bytes: allowed are those of liana_device.h";
    return in;
  }
  std::memcpy(&in.header, bytes.data(), sizeof in.header);
  const std::size_t wanted = bytes_of_packet(in.header.packet);
  const auto differs = [&in](const char* field, std::uint32_t value, const std::string& allowed) {
    in.problem = std::string("header.") + field + " = " + std::to_string(value) + ": allowed " + allowed;
    return in;
  };
  if (in.header.magic != LIANA_MAGIC) return differs("magic", in.header.magic, std::to_string(LIANA_MAGIC));
  if (in.header.version != LIANA_VERSION)
    return differs("version", in.header.version, std::to_string(LIANA_VERSION) + "; build the driver anew");
  if (wanted == 0) return differs("packet", in.header.packet, "1 to 6");
  if (in.header.bytes != wanted || bytes.size() != wanted)
    return differs("bytes", in.header.bytes, std::to_string(wanted) + ", and as many sent");
  return in;
}

liana_hello hello_of(const Capability& capability, std::int64_t now_us) {
  auto out = make<liana_hello>(LIANA_HELLO);
  capability.name.copy(out.name, sizeof out.name - 1);
  out.kind = static_cast<std::uint32_t>(capability.kind);
  out.hands = capability.hands;
  out.t_us = now_us;
  out.rate_hz = capability.rate_hz;
  out.watchdog_s = capability.watchdog_s;
  std::copy(capability.hand.begin(), capability.hand.end(), out.hand);
  return out;
}

Capability capability_of(const liana_hello& hello) {
  Capability out;
  out.name = text_of(hello.name, sizeof hello.name);
  out.kind = hello.kind > LIANA_POINTER ? Kind::kNone : static_cast<Kind>(hello.kind);
  out.hands = hello.hands;
  out.rate_hz = hello.rate_hz;
  out.watchdog_s = hello.watchdog_s;
  std::copy(std::begin(hello.hand), std::end(hello.hand), out.hand.begin());
  return out;
}

liana_sample packet_of(const Sample& sample, std::uint32_t sequence, const Echo& echo) {
  auto out = make<liana_sample>(LIANA_SAMPLE, sequence);
  out.t_us = sample.t_us;
  out.hand = sample.hand;
  if (sample.valid) out.flags |= LIANA_VALID;
  if (sample.deadman) out.flags |= LIANA_DEADMAN;
  if (sample.stale) out.flags |= LIANA_STALE;
  out.buttons = sample.buttons;
  out.echo_sequence = echo.sequence;
  out.echo_us = echo.came_us;
  out.trigger = sample.trigger;
  out.measured_cp = pose_of(sample.pose);
  copy(sample.twist.linear_m_s, out.measured_cv.linear_m_s);
  copy(sample.twist.angular_rad_s, out.measured_cv.angular_rad_s);
  return out;
}

const char* problem_of(const liana_sample& p, std::uint32_t hands) {
  constexpr std::uint32_t kFlags = LIANA_VALID | LIANA_DEADMAN | LIANA_STALE;
  if (!is_time(p.t_us)) return "t_us: allowed 0 to 2^53";
  if (!is_time(p.echo_us)) return "echo_us: allowed 0 to 2^53";
  if (p.hand >= hands) return "hand: allowed 0, and 1 where hello says two hands";
  if ((p.flags & ~kFlags) != 0) return "flags: allowed 0 to 7";
  if (!tensions_valid(p.trigger, 1.0) || p.trigger < 0.0) return "trigger: allowed 0 to 1, not denormal";
  if (!are_sound(p.measured_cp.position_m, kRoom_m)) return "measured_cp: position allowed within 10 m, not denormal";
  if (!are_sound(p.measured_cp.quaternion_wxyz, 2.0) || !is_valid(pose_of(p.measured_cp)))
    return "measured_cp: quaternion allowed of length 1 within 1e-6, not denormal";
  if (!are_sound(p.measured_cv.linear_m_s, kMaxSpeed) || !are_sound(p.measured_cv.angular_rad_s, kMaxSpeed))
    return "measured_cv: allowed within 1000 m/s and rad/s, not denormal";
  return nullptr;
}

Sample sample_of(const liana_sample& packet) {
  Sample out;
  out.t_us = packet.t_us;
  out.hand = packet.hand;
  out.valid = (packet.flags & LIANA_VALID) != 0;
  out.deadman = (packet.flags & LIANA_DEADMAN) != 0;
  out.stale = (packet.flags & LIANA_STALE) != 0;
  out.buttons = packet.buttons;
  out.trigger = packet.trigger;
  out.pose = pose_of(packet.measured_cp);
  out.twist = {array_of(packet.measured_cv.linear_m_s), array_of(packet.measured_cv.angular_rad_s)};
  return out;
}

liana_refused refused_of(std::string_view why) {
  auto out = make<liana_refused>(LIANA_REFUSED);
  why.copy(out.text, sizeof out.text - 1);
  return out;
}

std::string text_of(const char* field, std::size_t bytes) { return {field, std::find(field, field + bytes, '\0')}; }

liana_pose pose_of(const Pose& pose) {
  liana_pose out;
  copy(pose.position_m, out.position_m);
  copy(pose.quaternion, out.quaternion_wxyz);
  return out;
}

Pose pose_of(const liana_pose& pose) { return {array_of(pose.position_m), array_of(pose.quaternion_wxyz)}; }

}  // namespace liana::device
