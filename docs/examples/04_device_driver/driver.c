/* device_driver SOCKET [SECONDS]: a device of lianad in plain C (docs/reference/device-protocol.md): a hand
 * that goes up and down by
 * itself, as a sine of 5 mm, with the deadman held but for the first tenth of every second. */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <math.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <time.h>
#include <unistd.h>

#include "liana_device.h"

enum { kPeriod_ms = 5 };

static int64_t now_us(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (int64_t)t.tv_sec * 1000000 + t.tv_nsec / 1000;
}

static struct liana_header header(uint16_t packet, uint32_t bytes, uint32_t sequence) {
  struct liana_header h = {LIANA_MAGIC, LIANA_VERSION, packet, bytes, sequence};
  return h;
}

static int connect_to(const char* path) {
  struct sockaddr_un address = {0};
  int fd = socket(AF_UNIX, SOCK_SEQPACKET, 0);
  address.sun_family = AF_UNIX;
  strncpy(address.sun_path, path, sizeof address.sun_path - 1);
  if (fd >= 0 && connect(fd, (const struct sockaddr*)&address, sizeof address) == 0) return fd;
  fprintf(stderr, "device_driver: %s: %s; give lianad's socket of devices\n", path, strerror(errno));
  exit(1);
}

static void say_hello(int fd) {
  struct liana_hello hello = {0};
  hello.header = header(LIANA_HELLO, sizeof hello, 0);
  strcpy(hello.name, "sine");
  hello.kind = LIANA_HAND_CONTROLLER;
  hello.hands = 1;
  hello.t_us = now_us();
  hello.rate_hz = 1000.0 / kPeriod_ms;
  hello.watchdog_s = 0.1;
  hello.hand[0].sensed = LIANA_ALL_AXES;
  for (int i = 0; i < 3; ++i) {
    hello.hand[0].low_m[i] = -0.01;
    hello.hand[0].high_m[i] = 0.01;
  }
  send(fd, &hello, sizeof hello, MSG_NOSIGNAL);
}

/* The newest state, if one has come; ends the program when lianad has refused or left us. */
static void take(int fd, struct liana_state* state, int64_t* came_us) {
  union { /* one packet, whatever it is */
    struct liana_header header;
    struct liana_welcome welcome;
    struct liana_refused refused;
    struct liana_state state;
  } in;
  for (;;) {
    ssize_t bytes = recv(fd, &in, sizeof in, MSG_DONTWAIT);
    if (bytes < 0 && errno == ECONNRESET) continue; /* said once; what it said before is still there */
    if (bytes < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (bytes <= 0 || in.header.packet == LIANA_REFUSED) {
      fprintf(stderr, "device_driver: %s\n", bytes <= 0 ? "lianad is gone" : in.refused.text);
      exit(1);
    }
    if (in.header.packet == LIANA_WELCOME) printf("welcome, a state every %g s\n", in.welcome.interval_s);
    if (in.header.packet != LIANA_STATE) continue;
    *state = in.state;
    *came_us = now_us();
  }
}

int main(int argc, char** argv) {
  struct liana_state state = {0};
  int64_t came_us = 0;
  double seconds = argc > 2 ? atof(argv[2]) : 60.0;
  if (argc < 2) return fprintf(stderr, "device_driver: give lianad's socket of devices\n"), 2;
  int fd = connect_to(argv[1]);
  say_hello(fd);
  int64_t start_us = now_us();
  for (uint32_t sequence = 1; now_us() - start_us < seconds * 1e6; ++sequence) {
    struct pollfd readable = {fd, POLLIN, 0};
    struct liana_sample sample = {0};
    poll(&readable, 1, kPeriod_ms); /* a sample every 5 ms, or with every state */
    take(fd, &state, &came_us);
    double t_s = (double)(now_us() - start_us) * 1e-6;
    sample.header = header(LIANA_SAMPLE, sizeof sample, sequence);
    sample.t_us = now_us();
    sample.flags = LIANA_VALID | (fmod(t_s, 1.0) < 0.1 ? 0 : LIANA_DEADMAN);
    sample.echo_sequence = state.header.sequence;
    sample.echo_us = came_us;
    sample.measured_cp.position_m[2] = 0.005 * sin(6.283185307179586 * t_s);
    sample.measured_cp.quaternion_wxyz[0] = 1.0;
    send(fd, &sample, sizeof sample, MSG_NOSIGNAL);
    if (state.flags & LIANA_ENGAGED && sequence % 100 == 0)
      printf("tip %.4f m, %s\n", state.measured_cp.position_m[2], came_us + 100000 > now_us() ? "fresh" : "old");
  }
  close(fd); /* the same to the arm as LIANA_BYE */
  return 0;
}
