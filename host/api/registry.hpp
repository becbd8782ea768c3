// The running systems of one user: every lianad leaves a link to its API socket in a folder of that user.
#pragma once

#include <string>
#include <vector>

namespace liana::api {

// $XDG_RUNTIME_DIR/liana-UID; without that variable the same under /run/user/UID or, where there is none, /tmp.
std::string registry_folder();

// Entry of one lianad while it lives.
class Registration {
 public:
  // Makes the folder (only its user may enter) and the link; throws std::runtime_error when it cannot or the folder is
  // somebody else's.
  explicit Registration(const std::string& api_socket);
  ~Registration();
  Registration(const Registration&) = delete;
  Registration& operator=(const Registration&) = delete;

 private:
  std::string link_;
};

// API sockets of all running systems of this user, in the order of their paths; entries of the dead are removed. Throws
// std::runtime_error when the folder is somebody else's.
std::vector<std::string> running_systems();

}  // namespace liana::api
