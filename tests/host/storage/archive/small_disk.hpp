// A disk of a few megabytes, for what is done in a child process: a file system in memory that nobody else sees.
#pragma once

#include <sched.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <string>

namespace liana::archive {

constexpr int kNoDisk = 77;  // this machine gives none

// Mounts it on this folder, which must exist. False where that is not allowed.
inline bool mount_small_disk(const std::string& folder, const char* size) {
  const auto uid = getuid(), gid = getgid();
  if (unshare(CLONE_NEWUSER | CLONE_NEWNS) == 0) {
    std::ofstream("/proc/self/setgroups") << "deny";
    std::ofstream("/proc/self/uid_map") << "0 " << uid << " 1";
    std::ofstream("/proc/self/gid_map") << "0 " << gid << " 1";
  } else if (unshare(CLONE_NEWNS) != 0) {
    return false;
  }
  mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr);
  return mount("tmpfs", folder.c_str(), "tmpfs", 0, (std::string("size=") + size).c_str()) == 0;
}

// What `act` returns in a child process with such a disk, kNoDisk without one.
inline int on_small_disk(const std::string& folder, const char* size, const std::function<int()>& act) {
  const pid_t child = fork();
  if (child == 0) _exit(mount_small_disk(folder, size) ? act() : kNoDisk);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace liana::archive
