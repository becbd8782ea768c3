// omega6 SOCKET: an omega.6 of Force Dimension as an input device of lianad, on their SDK
// (docs/reference/device-protocol.md). NEVER RUN ON HARDWARE: written against the SDK's documentation; try it with the
// arm disabled, a hand at the switch.
#include <dhdc.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "liana_device.h"

namespace {

constexpr double kMaxForce_N = 12.0, kWatchdog_s = 0.1;
constexpr int kDeadmanButton = 0;  // of the stylus

volatile std::sig_atomic_t g_over = 0;

std::int64_t now_us() {
  const auto since = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(since).count();
}

template <class Packet>
Packet make(liana_packet packet, std::uint32_t sequence = 0) {
  Packet out{};
  out.header = {LIANA_MAGIC, LIANA_VERSION, static_cast<std::uint16_t>(packet), sizeof(Packet), sequence};
  return out;
}

int connect_to(const char* path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path, sizeof address.sun_path - 1);
  const int fd = ::socket(AF_UNIX, SOCK_SEQPACKET, 0);
  if (fd >= 0 && ::connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return fd;
  std::perror(path);
  return -1;
}

liana_hello hello() {
  auto out = make<liana_hello>(LIANA_HELLO);
  std::strcpy(out.name, "omega6");
  out.kind = LIANA_HAND_CONTROLLER;
  out.hands = 1;
  out.t_us = now_us();
  out.rate_hz = 1000.0;
  out.watchdog_s = kWatchdog_s;
  liana_hand& hand = out.hand[0];
  hand.sensed = LIANA_ALL_AXES | LIANA_TWIST;
  hand.actuated = LIANA_X | LIANA_Y | LIANA_Z;
  const double half_m[3] = {0.055, 0.080, 0.080};  // published: 110 mm deep, 160 mm across
  for (int i = 0; i < 3; ++i) hand.low_m[i] = -half_m[i], hand.high_m[i] = half_m[i];
  hand.max_force_N = kMaxForce_N;
  return out;
}

// Unit quaternion of a rotation matrix, by its largest element.
void quaternion_of(const double r[3][3], double q[4]) {
  const double four[4] = {1 + r[0][0] + r[1][1] + r[2][2], 1 + r[0][0] - r[1][1] - r[2][2],
                          1 - r[0][0] + r[1][1] - r[2][2], 1 - r[0][0] - r[1][1] + r[2][2]};
  const double w[4] = {four[0], r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]};
  const double x[4] = {w[1], four[1], r[0][1] + r[1][0], r[0][2] + r[2][0]};
  const double y[4] = {w[2], x[2], four[2], r[1][2] + r[2][1]};
  const double z[4] = {w[3], x[3], y[3], four[3]};
  const double* rows[4] = {w, x, y, z};
  const double* row = rows[std::max_element(four, four + 4) - four];
  const double length = std::sqrt(row[0] * row[0] + row[1] * row[1] + row[2] * row[2] + row[3] * row[3]);
  for (int i = 0; i < 4; ++i) q[i] = row[i] / length;
}

// False when a number cannot be read: the SDK has lost the device.
bool measure(liana_sample& sample) {
  double* p = sample.measured_cp.position_m;
  double* v = sample.measured_cv.linear_m_s;
  double* w = sample.measured_cv.angular_rad_s;
  double rotation[3][3];
  if (dhdGetPosition(p, p + 1, p + 2) < 0 || dhdGetOrientationFrame(rotation) < 0) return false;
  dhdGetLinearVelocity(v, v + 1, v + 2);
  dhdGetAngularVelocityRad(w, w + 1, w + 2);
  quaternion_of(rotation, sample.measured_cp.quaternion_wxyz);
  sample.flags = LIANA_VALID;
  if (dhdGetButton(kDeadmanButton) == DHD_ON) sample.flags |= LIANA_DEADMAN;
  return true;
}

// Walls at the device's own rate, and what the arm gives; nothing of a state that is old.
void feel(const liana_state& state, const liana_sample& hand, double force_N[3]) {
  std::fill(force_N, force_N + 3, 0.0);
  const bool is_felt = (state.present & LIANA_HAS_FORCE) != 0 && (state.flags & LIANA_ENGAGED) != 0;
  for (int i = 0; i < 3 && is_felt; ++i) force_N[i] = state.servo_cf.force_N[i];
  for (std::uint32_t k = 0; k < std::min<std::uint32_t>(state.planes, LIANA_MAX_PLANES); ++k) {
    const liana_plane& plane = state.plane[k];
    double depth_m = plane.offset_m, speed_m_s = 0.0;
    for (int i = 0; i < 3; ++i) {
      depth_m -= plane.normal[i] * hand.measured_cp.position_m[i];
      speed_m_s -= plane.normal[i] * hand.measured_cv.linear_m_s[i];
    }
    if (depth_m <= 0.0) continue;
    const double push_N = plane.stiffness_N_m * depth_m + plane.damping_N_s_m * std::max(0.0, speed_m_s);
    for (int i = 0; i < 3; ++i) force_N[i] += push_N * plane.normal[i];
  }
  for (int i = 0; i < 3; ++i) force_N[i] = std::clamp(force_N[i], -kMaxForce_N, kMaxForce_N);
}

// Takes what has come; false when lianad has refused us or is gone.
bool take(int fd, liana_state& state, std::int64_t& came_us) {
  union {
    liana_header header;
    liana_refused refused;
    liana_state state;
  } in;
  for (;;) {
    const ssize_t bytes = ::recv(fd, &in, sizeof in, MSG_DONTWAIT);
    if (bytes < 0 && errno == ECONNRESET) continue;
    if (bytes < 0) return errno == EAGAIN || errno == EINTR;
    if (bytes > 0 && in.header.packet == LIANA_REFUSED) std::fprintf(stderr, "omega6: %s\n", in.refused.text);
    if (bytes == 0 || in.header.packet == LIANA_REFUSED) return false;
    if (in.header.packet != LIANA_STATE) continue;
    state = in.state;
    came_us = now_us();
  }
}

// One turn is a millisecond: dhdSetForce waits for the device's next.
int serve(int fd) {
  liana_state state{};
  std::int64_t came_us = 0;
  for (std::uint32_t sequence = 1; g_over == 0; ++sequence) {
    auto sample = make<liana_sample>(LIANA_SAMPLE, sequence);
    if (!take(fd, state, came_us) || !measure(sample)) return 1;
    sample.t_us = now_us();
    sample.echo_sequence = state.header.sequence;
    sample.echo_us = came_us;
    ::send(fd, &sample, sizeof sample, MSG_NOSIGNAL | MSG_DONTWAIT);
    double force_N[3] = {0.0, 0.0, 0.0};
    const double age_s = static_cast<double>(now_us() - came_us) * 1e-6;
    if (came_us > 0 && age_s <= std::min(kWatchdog_s, state.watchdog_s)) feel(state, sample, force_N);
    if (dhdSetForce(force_N[0], force_N[1], force_N[2]) < 0) return 1;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "omega6: give lianad's socket of devices: omega6 SOCKET\n"), 2;
  std::signal(SIGINT, [](int) { g_over = 1; });
  if (dhdOpen() < 0) return std::fprintf(stderr, "omega6: no device: %s\n", dhdErrorGetLastStr()), 1;
  dhdEnableForce(DHD_ON);
  const int fd = connect_to(argv[1]);
  const liana_hello greeting = hello();
  const bool is_heard = fd >= 0 && ::send(fd, &greeting, sizeof greeting, MSG_NOSIGNAL) > 0;
  const int code = is_heard ? serve(fd) : 1;
  dhdSetForce(0.0, 0.0, 0.0);
  dhdClose();
  return code;
}
