// The running systems: every lianad leaves a link to its API socket in a folder of its user.
#pragma once

#include <functional>
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

// A place where a system may be and nobody could look.
struct Unseen {
  std::string place, why;
  bool is_ours = false;  // of this user: a system of its own may be there
};

// Looks for systems of every user, wherever one can be (docs/reference/command-line.md): `found` gets each API socket
// once, as soon as it is seen, those of this user first. What cannot be looked at is returned, and hinders nothing
// else. Throws nothing but what `found` throws.
std::vector<Unseen> look_everywhere(const std::function<void(const std::string& api_socket)>& found);

// The places that look_everywhere() knows, for people.
std::string places_to_look();

}  // namespace liana::api
