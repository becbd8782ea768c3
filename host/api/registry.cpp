#include "host/api/registry.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "host/api/socket.hpp"

namespace liana::api {
namespace {

namespace fs = std::filesystem;

std::string runtime_folder() {
  const char* given = std::getenv("XDG_RUNTIME_DIR");
  if (given != nullptr && *given != '\0') return given;
  const std::string usual = "/run/user/" + std::to_string(::getuid());
  return fs::exists(usual) ? usual : "/tmp";
}

// In /tmp anybody may have made a folder of this name: links in it could lead anywhere.
void require_own(const std::string& folder) {
  struct stat found {};
  if (::lstat(folder.c_str(), &found) != 0) throw std::runtime_error(folder + ": " + std::strerror(errno));
  const std::string remedy = "; remove it, set XDG_RUNTIME_DIR, or name sockets with --api";
  if (!S_ISDIR(found.st_mode) || found.st_uid != ::getuid())
    throw std::runtime_error(folder + ": is not a folder of this user" + remedy);
  if ((found.st_mode & (S_IWGRP | S_IWOTH)) != 0)
    throw std::runtime_error(folder + ": others than this user may write there" + remedy);
}

}  // namespace

std::string registry_folder() { return runtime_folder() + "/liana-" + std::to_string(::getuid()); }

Registration::Registration(const std::string& api_socket)
    : link_(registry_folder() + "/" + std::to_string(::getpid())) {
  const std::string folder = registry_folder();
  if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST)
    throw std::runtime_error(folder + ": " + std::strerror(errno));
  require_own(folder);
  fs::remove(link_);  // of a dead process that had our number
  fs::create_symlink(fs::absolute(api_socket), link_);
}

Registration::~Registration() {
  std::error_code error;
  fs::remove(link_, error);
}

std::vector<std::string> running_systems() {
  const std::string folder = registry_folder();
  if (!fs::exists(folder)) return {};
  require_own(folder);
  std::vector<std::string> sockets;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    std::error_code error;
    const std::string socket = fs::read_symlink(entry.path(), error).string();
    if (error) continue;
    if (is_listening(socket)) {
      sockets.push_back(socket);
    } else {
      fs::remove(entry.path(), error);
    }
  }
  std::sort(sockets.begin(), sockets.end());
  return sockets;
}

}  // namespace liana::api
