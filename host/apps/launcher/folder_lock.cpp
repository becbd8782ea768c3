#include "host/apps/launcher/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace liana::launcher {
namespace {

namespace fs = std::filesystem;

// Without O_CLOEXEC: the programs that a run starts hold its lock too, also after the run itself was killed.
FolderLock open_lock(const std::string& file, int flags) {
  return std::make_shared<const api::UniqueFd>(::open(file.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | flags, 0600));
}

bool take(const FolderLock& lock) { return ::flock(lock->get(), LOCK_EX | LOCK_NB) == 0; }

}  // namespace

FolderLock hold_new_folder(const std::string& folder, const std::string& text) {
  const std::string file = folder + "/" + kLockFile, unheld = file + ".new";
  FolderLock lock = open_lock(unheld, O_CREAT | O_EXCL);
  const auto size = static_cast<ssize_t>(text.size());
  if (lock->get() < 0 || ::write(lock->get(), text.data(), text.size()) != size)
    throw std::runtime_error(unheld + ": cannot be written: " + std::strerror(errno));
  std::error_code error;
  if (take(lock)) {
    fs::rename(unheld, file, error);
    if (!error) return lock;
  }
  fs::remove(unheld, error);
  return nullptr;
}

FolderLock take_unheld_folder(const std::string& folder) {
  FolderLock lock = open_lock(folder + "/" + kLockFile, 0);
  struct stat found {};
  // A file that somebody else removed in between is locked by nobody, and its folder may be another one by now.
  const bool is_taken = lock->get() >= 0 && take(lock) && ::fstat(lock->get(), &found) == 0 && found.st_nlink > 0;
  return is_taken ? lock : nullptr;
}

void remove_held_folder(const std::string& folder) {
  std::error_code gone;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, gone)) {
    std::error_code error;
    if (entry.path().filename() != kLockFile) fs::remove_all(entry.path(), error);
  }
  fs::remove_all(folder, gone);
}

void remove_leftovers(const std::string& prefix) {
  std::error_code gone;  // others tidy up at the same time
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::temp_directory_path(gone), gone)) {
    struct stat found {};
    const bool is_ours = entry.path().filename().string().starts_with(prefix) &&
                         ::lstat(entry.path().c_str(), &found) == 0 && S_ISDIR(found.st_mode) &&
                         found.st_uid == ::geteuid();
    if (!is_ours) continue;
    if (const FolderLock lock = take_unheld_folder(entry.path())) remove_held_folder(entry.path());
  }
}

}  // namespace liana::launcher
