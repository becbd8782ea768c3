#include "host/operator/spacemouse/spacenav.hpp"

#include <spnav.h>
#include <sys/socket.h>

#include <cerrno>
#include <stdexcept>

namespace liana::spacemouse {

Spacenav::Spacenav() {
  if (spnav_open() < 0)
    throw std::runtime_error(
        "spacenavd does not listen at SPNAV_SOCKET or /var/run/spnav.sock: start it (apt-get install spacenavd), and "
        "see that your user may open its socket");
  spnav_client_name("liana-spacemouse");
}

Spacenav::~Spacenav() { spnav_close(); }

int Spacenav::fd() const { return spnav_fd(); }

// The library does not tell an end from silence: the socket does.
bool Spacenav::read(Puck& puck) {
  spnav_event event{};
  while (spnav_poll_event(&event) != 0) {
    if (event.type == SPNAV_EVENT_MOTION)
      puck.push({event.motion.x, event.motion.y, event.motion.z, event.motion.rx, event.motion.ry, event.motion.rz});
    if (event.type == SPNAV_EVENT_DEV && event.dev.op == SPNAV_DEV_RM) puck.lose();
    if (event.type == SPNAV_EVENT_BUTTON) puck.press(event.button.bnum, event.button.press != 0);
  }
  char byte = 0;
  const ssize_t there = ::recv(spnav_fd(), &byte, 1, MSG_PEEK | MSG_DONTWAIT);
  return there > 0 || (there < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR));
}

}  // namespace liana::spacemouse
