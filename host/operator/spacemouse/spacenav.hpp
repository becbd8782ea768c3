// The connection to spacenavd, through libspnav. The library has one for the whole process.
#pragma once

#include "host/operator/spacemouse/puck.hpp"

namespace liana::spacemouse {

class Spacenav {
 public:
  // Throws std::runtime_error where spacenavd does not listen (SPNAV_SOCKET, the spnavrc files or /var/run/spnav.sock).
  Spacenav();
  ~Spacenav();
  Spacenav(const Spacenav&) = delete;
  Spacenav& operator=(const Spacenav&) = delete;

  int fd() const;
  // Gives the puck all that has come; false when spacenavd is gone.
  bool read(Puck& puck);
};

}  // namespace liana::spacemouse
